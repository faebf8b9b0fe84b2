// What was recorded: frame times over time, what the display and the animation did, who was busy, how it is spread.

// Where there is little room for a cause's name.
const shortCause = (name) => ({ "start of the recorder": "start", "shader compilation": "shaders", "not told": "" })[name] ?? name;

const mostAtFirst = 8;  // as many as there are colours

function decodeRecording({ name, frames, seconds, series, stutters }, index) {
  const read = (key) => decodeSeries(frames, series[key]);
  const time = read("frame_ms");
  return {
    index, name, frames, time, shown: index < mostAtFirst,
    display: read("display_ms"), animation: read("animation_error_ms"), cpu: read("cpu_ms"), gpu: read("gpu_ms"),
    starts: startsOf(time, seconds),
    stutters: new Uint32Array(bytesOf(stutters.frames).buffer), causes: bytesOf(stutters.causes),
  };
}

// When each frame began [s], and when the last one ended; as the sum of times that are rounded drifts, it is stretched.
function startsOf({ frames, low }, seconds) {
  const starts = new Float64Array(frames + 1);
  for (let i = 0; i < frames; ++i) starts[i + 1] = starts[i] + (Number.isNaN(low[i]) ? 0 : low[i] / 1000);
  const stretch = starts[frames] > 0 ? seconds / starts[frames] : 1;
  for (let i = 0; i <= frames; ++i) starts[i] *= stretch;
  return starts;
}

const recordings = data.recordings.map(decodeRecording);

// What the charts, the read-out and the controls share.
function makeRecordingPart() {
  const seconds = Math.max(...recordings.map((run) => run.starts[run.frames]));
  for (const run of recordings) run.bySeconds = bySeconds(run.starts);
  const part = {
    seconds,
    frameCount: Math.max(...recordings.map((run) => run.frames)),
    unit: "seconds",
    charts: {},  // by id, as drawn last
    shown: () => recordings.filter((run) => run.shown),
    placesOf: (run) => (part.unit === "frames" ? byNumber : run.bySeconds),
    frameAt: (run, at) => frameAtPlace(part.placesOf(run), at, run.frames),
    // Seconds as minutes where there are many.
    clock: (at) => (seconds < 120 ? brief(Number(at.toFixed(3))) : clockText(at)),
    clockWithUnit: (at) => part.clock(at) + (seconds < 120 ? " s" : ""),
    drawLabels: (svg, x, bottom) => (part.unit === "frames" ? drawFrameLabels(svg, x, bottom)
        : drawXTicks(svg, x, bottom, clockTicks(x, Math.max(3, Math.round((x.end - x.begin) / 110))), part.tickText)),
    tickText: (at) => (seconds < 120 ? brief(Number(at.toFixed(6))) : clockText(at)),
  };
  part.redraw = makeRedraw(() => drawRecordings(part), () => drawRecordedSpread(part));
  part.view = makeView({ from: 0, to: seconds }, 0, part.redraw);
  part.reader = makeRecordingReader(part);
  return part;
}

function drawRecordings(part) {
  drawRecordedTimes(part);
  drawSeries(part, "recorded-display", "display", false);
  drawSeries(part, "recorded-animation", "animation", true);
  for (const run of recordings) drawBusy(part, run);
  part.reader.drawCross();
  byId("recorded-range").textContent = rangeText(part);
}

// What of the recordings is in view.
function rangeText({ view, unit, frameCount, shown, frameAt, clock, clockWithUnit }) {
  if (unit === "frames") {
    const first = Math.max(0, Math.ceil(view.from)), last = Math.min(frameCount - 1, Math.floor(view.to));
    return `frames ${grouped(first)} to ${grouped(last)} of ${grouped(frameCount)}`;
  }
  const [run, ...others] = shown();
  const frames = run && others.length === 0 ? `, frames ${grouped(frameAt(run, view.from))} to ${grouped(frameAt(run, view.to))}` : "";
  return `${clock(view.from)} to ${clockWithUnit(view.to)}${frames}`;
}

const areTold = (key) => () => recordings.some((run) => run[key]);
const seriesText = (key) => (run) => textAt(run[key], run.read, frameText);

// [key, title, tell(run), is there anything to tell]
const recordedColumns = [
  ["frame", "frame", (run) => grouped(run.read), () => true],
  ["time", "ms", seriesText("time"), () => true],
  ["rate", "fps", (run) => frameText(Number((1000 / valueAt(run.time, run.read)).toPrecision(4))), () => true],
  ["display", "display ms", seriesText("display"), areTold("display")],
  ["animation", "animation error ms", seriesText("animation"), areTold("animation")],
  ["cpu", "CPU ms", seriesText("cpu"), areTold("cpu")],
  ["gpu", "GPU ms", seriesText("gpu"), areTold("gpu")],
  ["stutter", "stutter", (run) => data.causes[run.causes[run.stutters.indexOf(run.read)]] ?? "\u2013",
    () => recordings.some((run) => run.stutters.length > 0)],
];

function makeRecordingReader(part) {
  const { view, shown, placesOf, frameAt } = part;
  const columns = recordedColumns.filter(([, , , isTold]) => isTold());
  const readAt = () => shown().filter((run) => view.place <= placesOf(run).begins(run.frames));
  const caption = () => (part.unit === "frames" ? `Frame ${grouped(Math.round(view.place))}` : `At ${part.clockWithUnit(view.place)}`);
  const reader = {
    // `exact`: the frame of the first recording shown, if it is known; a frame without a time has no place of its own.
    readOut(at, chart, exact) {
      view.place = at === null ? null : Math.min(Math.max(at, view.all.from), view.all.to);
      byId("readout").hidden = view.place === null;
      if (view.place !== null) for (const run of recordings) run.read = frameAt(run, view.place);
      if (exact !== undefined) shown()[0].read = exact;
      reader.drawCross();
      if (view.place === null) return;
      fillReadout(caption(), readAt(), columns);
      byId("readout").dataset.frame = shown()[0]?.read ?? "";
      placeReadout(chart, view.place);
    },
    // To the middle of the next frame of the first recording shown.
    step(by, chart) {
      const run = shown()[0];
      if (!run) return;
      const next = view.place === null ? frameAt(run, (view.from + view.to) / 2) : run.read + by;
      const frame = Math.min(Math.max(next, 0), run.frames - 1), places = placesOf(run);
      const at = (places.begins(frame) + places.begins(frame + 1)) / 2, span = view.to - view.from;
      reader.readOut(at, chart, frame);
      if (at < view.from || at > view.to) view.set(at - span / 2, at + span / 2);
      speak(caption(), readAt(), columns);
    },
    drawCross() {
      const keys = { "recorded-times": "time", "recorded-display": "display", "recorded-animation": "animation" };
      for (const [id, chart] of Object.entries(part.charts)) {
        const dots = view.place === null || !keys[id] ? [] : readAt().filter((run) => run[keys[id]])
            .map((run) => ({ run, value: valueAt(run[keys[id]], run.read) }));
        drawCross(chart, view, view.place, dots);
      }
    },
  };
  return reader;
}

function drawRecordedSpread(part) {
  const { view, frameAt } = part;
  const ranges = part.shown().filter((run) => view.from < part.placesOf(run).begins(run.frames))
      .map((run) => ({ run, begin: frameAt(run, view.from), end: frameAt(run, view.to) + 1 }));
  const spreads = ranges.map(({ run, begin, end }) => ({ run, sorted: sortedValues(run.time, begin, end) }));
  const steps = ranges.map(({ run, begin, end }) => ({ run, sorted: sortedSteps(run.time.low, begin, end) }));
  drawHistogram("recorded-histogram", spreads, spreadRange(spreads), panelWidth(view));
  drawPercentiles("recorded-percentiles", spreads, panelWidth(view));
  drawPercentiles("recorded-steps", steps, panelWidth(view));
  byId("recorded-spread-range").textContent = view.isAll() ? "of all frames" : "of the frames in view";
}

// How much each time differs from the one before.
function sortedSteps(times, begin, end) {
  const steps = new Float64Array(Math.max(0, end - begin - 1));
  let count = 0;
  for (let i = begin + 1; i < end; ++i) {
    const step = Math.abs(times[i] - times[i - 1]);
    if (!Number.isNaN(step)) steps[count++] = step;
  }
  return steps.subarray(0, count).sort();
}

// What most frames take, however long some are.
function usualSeconds({ seconds, frameCount }) {
  const samples = recordings.map((run) => sampleInView(run.time, byNumber, { low: 0, high: run.frames }));
  return ranked(sortedSample(samples), 0.5) / 1000 || seconds / frameCount;
}

// The same frames in the other unit.
function chooseUnit(part, unit) {
  const { view, frameAt, frameCount, seconds } = part;
  const longest = recordings.reduce((a, b) => (b.starts[b.frames] > a.starts[a.frames] ? b : a));
  const [from, to] = view.isAll() ? [] : [frameAt(longest, view.from), frameAt(longest, view.to - 2e-9)];
  part.unit = unit;
  view.place = null;
  byId("readout").hidden = true;
  view.all = unit === "frames" ? { from: -0.5, to: frameCount - 0.5 } : { from: 0, to: seconds };
  view.least = 8 * (unit === "frames" ? 1 : usualSeconds(part));
  const places = part.placesOf(longest);
  view.set(from === undefined ? view.all.from : places.begins(from), to === undefined ? view.all.to : places.begins(to + 1));
}

// A second around a stutter of the list.
function showStutter(part, run, frame) {
  const places = part.placesOf(run), begin = places.begins(frame), end = places.begins(frame + 1);
  const around = part.unit === "frames" ? 30 : 0.5;
  if (!run.shown) document.querySelector(`#recorded-legend [data-run="${run.index}"]`).click();
  part.view.set(begin - around, end + around);
  byId("recorded").scrollIntoView({ block: "start" });
}

function startRecordings() {
  const part = makeRecordingPart();
  const { view, redraw, charts } = part;
  for (const [id, key] of [["recorded-display", "display"], ["recorded-animation", "animation"]]) byId(id).hidden = !areTold(key)();
  document.querySelector("#recorded .key-target").hidden = data.target_ms === null;
  document.querySelector("#recorded .key-stutter").hidden = !recordings.some((run) => run.stutters.length > 0);
  makeLegend("recorded-legend", recordings, redraw);
  byId("recorded-legend").hidden = recordings.length === 1;
  for (const id of ["recorded-times", "recorded-display", "recorded-animation", ...recordings.map((run) => `recorded-busy-${run.index}`)]) {
    if (byId(id) && !byId(id).hidden) listenToChart(id, () => charts[id], view, part.reader);
  }
  for (const button of document.querySelectorAll("button[data-frame]")) {
    button.addEventListener("click", () => showStutter(part, recordings[button.dataset.recording], Number(button.dataset.frame)));
  }
  listenToZoom("recorded-", view);
  makeChoice("recorded-scale", "scale", "fitted", (scale) => {
    view.scale = scale;
    redraw();
  });
  byId("recorded-unit").hidden = part.seconds === 0;
  makeChoice("recorded-unit", "unit", part.seconds > 0 ? "seconds" : "frames", (unit) => chooseUnit(part, unit));
  return { view, redraw, draw: () => drawRecordings(part), drawSpread: () => drawRecordedSpread(part), section: "recorded" };
}
