// What control laws decided, and what became of it: charts over frames, and how the times are spread.

const stateNames = ["original", "slowed", "points"];

function decodeRun({ name, frames, series }, index) {
  const read = (key) => decodeSeries(frames, series[key]);
  return {
    index, name, frames, shown: true,
    target: read("target_ms"), time: read("frame_ms"), predicted: read("predicted_ms"),
    distance: read("motion_distance"), splat: read("splat_size"),
    rate: read("rate"),  // null: D and S decided all along
    ...decodeStates(frames, series.state),
  };
}

// shares(begin, end): of the frames [begin, end) in each state; stateText(frame).
function decodeStates(frames, { width, low, slowed, points }) {
  const exact = low && unpackRepeated(Uint8Array, low);
  const each = exact ? [1, 2].map((state) => Array.from(exact, (value) => (value === state ? 1 : 0)))
      : [slowed, points].map((shares) => Array.from(bytesOf(shares), (share) => share / 255));
  // How many frames before each stretch are in state 1, and in state 2.
  const before = each.map((shares) => {
    const sums = new Float64Array(shares.length + 1);
    shares.forEach((share, i) => sums[i + 1] = sums[i] + share);
    return sums;
  });
  const shares = (begin, end) => {
    const from = Math.floor(begin / width), to = Math.max(from + 1, Math.ceil(end / width));
    const [slowedShare, pointsShare] = before.map((sums) => (sums[to] - sums[from]) / (to - from));
    return [1 - slowedShare - pointsShare, slowedShare, pointsShare].map((share) => Math.round(share * 1e6) / 1e6);
  };
  const stateText = (frame) => {
    const all = shares(frame, frame + 1);
    return all.flatMap((share, state) => (share > 0 ? [stateNames[state]] : [])).join(", ") || "\u2013";
  };
  return { shares, stateText: (frame) => (frame < frames ? stateText(frame) : "\u2013") };
}

function startLaws() {
  const runs = data.runs.map(decodeRun);
  const frameCount = Math.max(...runs.map((run) => run.frames));
  const shown = () => runs.filter((run) => run.shown);
  // All runs aim at the same targets, as a rule; where not, each has a band of its own.
  const targetRuns = runs.filter((run, i) => i === 0 || !sameSeries(run.target, runs[0].target));
  const predicts = runs.filter((run) => isTold(run.predicted));
  const exact = runs.filter((run) => isExact(run.time));  // of others the spread can't be told from what was kept
  const charts = {};
  const details = [["distance-chart", "distance"], ["splat-chart", "splat"]];

  const redraw = makeRedraw(() => draw(), () => drawSpread());
  const view = makeView({ from: -0.5, to: frameCount - 0.5 }, 8, redraw);

  function draw() {
    charts["frame-chart"] = drawFrameChart(shown(), targetRuns.filter((run, i) => i === 0 || run.shown), view);
    for (const [id, key] of details) if (!byId(id).hidden) charts[id] = drawDetailChart(id, key, shown(), view);
    reader.drawCross();
    const first = Math.max(0, Math.ceil(view.from)), last = Math.min(frameCount - 1, Math.floor(view.to));
    byId("range").textContent = `frames ${grouped(first)} to ${grouped(last)} of ${grouped(frameCount)}`;
  }

  const rateText = (value) => (value > 0 ? brief(Number(value.toPrecision(4))) : "\u2013");
  const columns = [
    ["time", "ms", (run) => textAt(run.time, view.place, frameText)],
    ["target", "target", (run) => textAt(run.target, view.place, frameText)],
    ["predicted", "predicted", (run) => textAt(run.predicted, view.place, frameText)],
    ["state", "state", (run) => run.stateText(view.place)],
    ["distance", "D m", (run) => textAt(run.distance, view.place, frameText)],
    ["splat", "S px", (run) => textAt(run.splat, view.place, frameText)],
    ["rate", "rate px/piece", (run) => textAt(run.rate, view.place, rateText)],
  ].filter(([key]) => key !== "rate" || runs.some((run) => run.rate))
      .filter(([key]) => !["distance", "splat"].includes(key) || runs.some((run) => isTold(run[key]) && run[key].high.some((value) => value > 0)));

  const readRuns = () => shown().filter((run) => view.place < run.frames);
  const caption = () => `Frame ${grouped(view.place)}`;

  const reader = {
    readOut(at, chart) {
      view.place = at === null ? null : Math.min(Math.max(Math.round(at), 0), frameCount - 1);
      byId("readout").hidden = view.place === null;
      reader.drawCross();
      if (view.place === null) return;
      fillReadout(caption(), readRuns(), columns);
      byId("readout").dataset.frame = view.place;
      placeReadout(chart, view.place);
    },
    step(by, chart) {
      reader.readOut(view.place === null ? Math.round((view.from + view.to) / 2) : view.place + by, chart);
      const span = view.to - view.from;
      if (view.place < view.from || view.place > view.to) view.set(view.place - span / 2, view.place + span / 2);
      speak(caption(), readRuns(), columns);
    },
    drawCross() {
      for (const [id, key] of [["frame-chart", "time"], ...details]) {
        if (!charts[id]) continue;
        const dots = view.place === null ? [] : readRuns().map((run) => ({ run, value: valueAt(run[key], view.place) }));
        drawCross(charts[id], view, view.place, dots);
      }
    },
  };

  function drawSpread() {
    if (byId("spread").hidden) return;
    const begin = Math.max(0, Math.ceil(view.from)), end = Math.min(frameCount, Math.floor(view.to) + 1);
    const spreads = exact.filter((run) => run.shown).map((run) => ({ run, sorted: sortedValues(run.time, begin, end) }));
    drawHistogram("histogram", spreads, spreadRange(spreads), panelWidth(view));
    drawPercentiles("percentiles", spreads, panelWidth(view));
    if (!byId("scatter").hidden) drawScatter(spreads.filter(({ run }) => predicts.includes(run)), begin, end, panelWidth(view));
    byId("spread-range").textContent = view.isAll() ? "of all frames" : `of frames ${grouped(begin)} to ${grouped(end - 1)}`;
  }

  document.querySelector(".key-predicted").hidden = predicts.length === 0;
  byId("scatter").hidden = !predicts.some(({ predicted }) => isExact(predicted));
  byId("spread").hidden = exact.length === 0;
  for (const [id, key] of details) byId(id).hidden = !runs.some((run) => run[key].high.some((value) => value > 0));
  byId("rate-words").hidden = !runs.some((run) => run.rate);
  makeLegend("legend", runs, redraw);
  for (const id of ["frame-chart", ...details.map(([id]) => id)]) if (!byId(id).hidden) listenToChart(id, () => charts[id], view, reader);
  listenToZoom("", view);
  makeChoice("scale", "scale", "fitted", (scale) => {
    view.scale = scale;
    redraw();
  });
  return { view, draw, drawSpread, redraw, section: "times" };
}
