// What was recorded: frame times over time, what the display and the animation did, who was busy, how it is spread.

const causes = ["start of the recorder", "shader compilation", "GPU", "CPU", "waiting", "not told"];
const shortCauses = ["start", "shaders", "GPU", "CPU", "waiting", ""];

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

function startRecordings() {
  const frameCount = Math.max(...recordings.map((run) => run.frames));
  const seconds = Math.max(...recordings.map((run) => run.starts[run.frames]));
  const shown = () => recordings.filter((run) => run.shown);
  const charts = {};
  let unit = "seconds";
  const placesOf = (run) => (unit === "frames" ? byNumber : run.bySeconds);
  for (const run of recordings) run.bySeconds = bySeconds(run.starts);

  const redraw = makeRedraw(() => draw(), () => drawSpread());
  const view = makeView({ from: 0, to: seconds }, 0, redraw);

  // Seconds as minutes where there are many.
  const clock = (at) => (seconds < 120 ? brief(Number(at.toFixed(6))) : clockText(at));
  const drawLabels = (svg, x, bottom) => (unit === "frames" ? drawFrameLabels(svg, x, bottom)
      : drawXTicks(svg, x, bottom, clockTicks(x, Math.max(3, Math.round((x.end - x.begin) / 110))), clock));

  // A stretch of frame time [ms] drawn as a line of each recording.
  function drawTimes() {
    const plot = view.printWidth ? 250 : window.innerWidth < 700 ? 230 : 360;
    const marks = shown().some((run) => run.stutters.length > 0) ? 14 * shown().length + 4 : 0;
    const chart = charts["recorded-times"] = openChart("recorded-times", plot + marks + 22, plot + marks, view, drawLabels);
    const { x } = chart;
    const curves = shown().map((run) => ({ run, places: placesOf(run), times: thin(run.time, placesOf(run), x) }));
    const target = data.target_ms === null ? [] : [{ low: data.target_ms, high: data.target_ms }];
    const sample = () => sortedSample(curves.map(({ run, places }) => sampleInView(run.time, places, x)));
    const y = chart.y = timesAxis(view.scale, curves.flatMap(({ times }) => times), target, sample, plot, 14);
    drawYAxis(chart.ground, x, y, 6);
    for (const { low } of target) add(chart.layer, "path", { class: "target", d: `M${x.begin} ${px(y.at(low))}H${x.end}` });
    curves.forEach(({ run, places, times }, i) => {
      const group = addRun(chart.layer, run);
      drawExtent(group, chart, run, run.time, places, times);
      drawCarets(group, chart, y, times, places);
      if (marks > 0) drawStutters(chart, run, places, plot + 14 + 14 * i);
    });
  }

  // Of many frames an area as pale as glass and the means as a line, or one recording would hide another.
  function drawExtent(group, chart, run, series, places, buckets) {
    const { x, y } = chart;
    const areThin = isThinned(places, run.frames, x);
    const isAlone = shown().length === 1;
    add(group, "path", { class: `curve ${areThin ? isAlone ? "extent alone" : "extent" : "measured"}`, d: curvePath(buckets, places, x, y, false) });
    if (areThin) add(group, "path", { class: "curve measured", d: curvePath(meanBuckets(series, buckets), places, x, y, false) });
  }

  // A mark below each stutter, of those that share a place one; with its cause where there is room for the word.
  function drawStutters(chart, run, places, bottom) {
    const marks = [];
    run.stutters.forEach((frame, i) => {
      const place = (along(chart.x, places.begins(frame)) + along(chart.x, places.begins(frame + 1))) / 2;
      const isInView = place > chart.x.begin - 5 && place < chart.x.end + 5;
      if (isInView && place - (marks.at(-1)?.place ?? -Infinity) >= 4) marks.push({ place, cause: shortCauses[run.causes[i]] });
    });
    if (marks.length === 0) return;
    const group = addRun(chart.layer, run);
    add(group, "path", { class: "stutter-mark", d: marks.map(({ place }) => `M${px(place - 4)} ${bottom}l4 -9l4 9z`).join("") });
    marks.forEach(({ place, cause }, i) => {
      const room = (marks[i + 1]?.place ?? chart.x.end) - place - 14;
      if (cause && room > 7 * cause.length) add(group, "text", { x: px(place + 7), y: bottom }, cause);
    });
  }

  function drawSeries(id, key, isSigned) {
    if (byId(id).hidden) return;
    const plot = 130;
    const chart = charts[id] = openChart(id, plot + 22, plot, view, drawLabels);
    const { x } = chart;
    const told = shown().filter((run) => run[key]);
    // From shown frame to shown frame: those that were never shown are no gap in what is seen.
    const known = (buckets) => buckets.filter(({ low, high }) => low <= high);
    const curves = told.map((run) => ({ run, places: placesOf(run), values: known(thin(run[key], placesOf(run), x)) }));
    const buckets = curves.flatMap(({ values }) => values);
    const y = chart.y = isSigned ? signedAxis(buckets, plot)
        : timesAxis("fitted", buckets, [], () => sortedSample(told.map((run) => sampleInView(run[key], placesOf(run), x))), plot, 8);
    drawYAxis(chart.ground, x, y, 4);
    for (const { run, places, values } of curves) {
      const group = addRun(chart.layer, run);
      drawExtent(group, chart, run, run[key], places, values);
      if (!isSigned) drawCarets(group, chart, y, values, places);
    }
  }

  // As far down as up, so that 0 is in the middle.
  function signedAxis(buckets, plot) {
    const far = buckets.reduce((most, { low, high }) => (low <= high ? Math.max(most, -low, high) : most), 0) || 1;
    return makeAxis(-1.05 * far, 1.05 * far, plot, 8);
  }

  // What was always busy as an area, what was so at times lighter above it, and the frame time as a line over both.
  function drawBusy(run) {
    const id = `recorded-busy-${run.index}`;
    if (!byId(id)) return;
    byId(id).hidden = !run.shown;
    if (!run.shown) return;
    const plot = 150, places = placesOf(run);
    const chart = charts[id] = openChart(id, plot + 22, plot, view, drawLabels);
    const { x } = chart;
    const times = thin(run.time, places, x);
    // The greater first, or it would hide the other.
    const sum = (buckets) => buckets.reduce((all, { low, high }) => (low <= high ? all + low : all), 0);
    const parts = ["gpu", "cpu"].filter((key) => run[key]).map((key) => ({ key, values: thin(run[key], places, x) }))
        .sort((a, b) => sum(b.values) - sum(a.values));
    const sample = () => sortedSample([sampleInView(run.time, places, x)]);
    const y = chart.y = timesAxis("fitted", [...times, ...parts.flatMap(({ values }) => values)], [], sample, plot, 8);
    chart.y = makeAxis(0, y.high, plot, 8);
    drawYAxis(chart.ground, x, chart.y, 4);
    for (const { key, values } of parts) {
      add(chart.layer, "path", { class: `busy busy-${key} at-times`, d: areaPath(values, places, x, chart.y, "high") });
      add(chart.layer, "path", { class: `busy busy-${key}`, d: areaPath(values, places, x, chart.y, "low") });
    }
    add(addRun(chart.layer, run), "path", { class: "curve measured", d: curvePath(meanBuckets(run.time, times), places, x, chart.y, false) });
  }

  function draw() {
    drawTimes();
    drawSeries("recorded-display", "display", false);
    drawSeries("recorded-animation", "animation", true);
    recordings.forEach(drawBusy);
    reader.drawCross();
    const frames = shown().length === 1 && unit === "seconds" ? `, frames ${grouped(frameAt(shown()[0], view.from))} to ${grouped(frameAt(shown()[0], view.to))}` : "";
    byId("recorded-range").textContent = unit === "frames"
        ? `frames ${grouped(Math.max(0, Math.ceil(view.from)))} to ${grouped(Math.min(frameCount - 1, Math.floor(view.to)))} of ${grouped(frameCount)}`
        : `${clock(Number(view.from.toFixed(3)))} to ${clock(Number(view.to.toFixed(3)))}${seconds < 120 ? " s" : ""}${frames}`;
  }

  const frameAt = (run, at) => frameAtPlace(placesOf(run), at, run.frames);

  const timed = (run, frame) => textAt(run.time, frame, frameText);
  const columns = [
    ["frame", "frame", (run) => grouped(run.read)],
    ["time", "ms", (run) => timed(run, run.read)],
    ["rate", "fps", (run) => frameText(Number((1000 / valueAt(run.time, run.read)).toPrecision(4)))],
    ["display", "display ms", (run) => textAt(run.display, run.read, frameText), () => recordings.some((run) => run.display)],
    ["animation", "animation error ms", (run) => textAt(run.animation, run.read, frameText), () => recordings.some((run) => run.animation)],
    ["cpu", "CPU ms", (run) => textAt(run.cpu, run.read, frameText), () => recordings.some((run) => run.cpu)],
    ["gpu", "GPU ms", (run) => textAt(run.gpu, run.read, frameText), () => recordings.some((run) => run.gpu)],
    ["stutter", "stutter", (run) => causes[run.causes[run.stutters.indexOf(run.read)]] ?? "\u2013", () => recordings.some((run) => run.stutters.length > 0)],
  ].filter(([, , , isTold]) => !isTold || isTold());

  const readAt = () => shown().filter((run) => view.place <= placesOf(run).begins(run.frames));
  const caption = () => (unit === "frames" ? `Frame ${grouped(Math.round(view.place))}` : `At ${clock(Number(view.place.toFixed(3)))}${seconds < 120 ? " s" : ""}`);

  const reader = {
    readOut(at, chart) {
      view.place = at === null ? null : Math.min(Math.max(at, view.all.from), view.all.to);
      byId("readout").hidden = view.place === null;
      if (view.place !== null) for (const run of recordings) run.read = frameAt(run, view.place);
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
      const last = view.place === null ? frameAt(run, (view.from + view.to) / 2) : run.read + by;
      const frame = Math.min(Math.max(last, 0), run.frames - 1), places = placesOf(run);
      const at = (places.begins(frame) + places.begins(frame + 1)) / 2, span = view.to - view.from;
      reader.readOut(at, chart);
      if (at < view.from || at > view.to) view.set(at - span / 2, at + span / 2);
      speak(caption(), readAt(), columns);
    },
    drawCross() {
      const keys = { "recorded-times": "time", "recorded-display": "display", "recorded-animation": "animation" };
      for (const [id, chart] of Object.entries(charts)) {
        const dots = view.place === null || !keys[id] ? [] : readAt().filter((run) => run[keys[id]])
            .map((run) => ({ run, value: valueAt(run[keys[id]], run.read) }));
        drawCross(chart, view, view.place, dots);
      }
    },
  };

  function drawSpread() {
    const ranges = shown().map((run) => ({ run, begin: frameAt(run, view.from), end: frameAt(run, view.to) + 1 }));
    const spreads = ranges.map(({ run, begin, end }) => ({ run, sorted: sortedValues(run.time, begin, end) }));
    drawHistogram("recorded-histogram", spreads, spreadRange(spreads), panelWidth(view));
    drawPercentiles("recorded-percentiles", spreads, panelWidth(view));
    drawPercentiles("recorded-steps", ranges.map(({ run, begin, end }) => ({ run, sorted: sortedSteps(run.time.low, begin, end) })), panelWidth(view));
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
  function usualSeconds() {
    const samples = recordings.map((run) => sampleInView(run.time, byNumber, { low: 0, high: run.frames }));
    return ranked(sortedSample(samples), 0.5) / 1000 || seconds / frameCount;
  }

  // The same frames in the other unit.
  function chooseUnit(chosen) {
    const longest = recordings.reduce((a, b) => (b.starts[b.frames] > a.starts[a.frames] ? b : a));
    const [from, to] = view.isAll() ? [] : [frameAt(longest, view.from), frameAt(longest, view.to - 2e-9)];
    unit = chosen;
    view.place = null;
    byId("readout").hidden = true;
    view.all = unit === "frames" ? { from: -0.5, to: frameCount - 0.5 } : { from: 0, to: seconds };
    view.least = 8 * (unit === "frames" ? 1 : usualSeconds());
    const places = placesOf(longest);
    view.set(from === undefined ? view.all.from : places.begins(from), to === undefined ? view.all.to : places.begins(to + 1));
  }

  // A second around a stutter of the list.
  function showStutter(run, frame) {
    const places = placesOf(run);
    const middle = (places.begins(frame) + places.begins(frame + 1)) / 2, half = unit === "frames" ? 30 : 0.5;
    if (!run.shown) document.querySelector(`#recorded-legend [data-run="${run.index}"]`).click();
    view.set(middle - half - (places.begins(frame + 1) - places.begins(frame)) / 2, middle + half + (places.begins(frame + 1) - places.begins(frame)) / 2);
    byId("recorded").scrollIntoView({ block: "start" });
  }

  for (const [id, key] of [["recorded-display", "display"], ["recorded-animation", "animation"]]) {
    byId(id).hidden = !recordings.some((run) => run[key]);
  }
  document.querySelector("#recorded .key-target").hidden = data.target_ms === null;
  document.querySelector("#recorded .key-stutter").hidden = !recordings.some((run) => run.stutters.length > 0);
  makeLegend("recorded-legend", recordings, redraw);
  byId("recorded-legend").hidden = recordings.length === 1;
  for (const id of ["recorded-times", "recorded-display", "recorded-animation", ...recordings.map((run) => `recorded-busy-${run.index}`)]) {
    if (byId(id) && !byId(id).hidden) listenToChart(id, () => charts[id], view, reader);
  }
  for (const button of document.querySelectorAll("button[data-frame]")) {
    button.addEventListener("click", () => showStutter(recordings[button.dataset.recording], Number(button.dataset.frame)));
  }
  listenToZoom("recorded-", view);
  makeChoice("recorded-scale", "scale", "fitted", (scale) => {
    view.scale = scale;
    redraw();
  });
  byId("recorded-unit").hidden = seconds === 0;
  makeChoice("recorded-unit", "unit", seconds > 0 ? "seconds" : "frames", chooseUnit);
  return { view, draw, drawSpread, redraw, section: "recorded" };
}
