// The charts over frames: times against target with the states below, D, and S.

const stripHeight = 12, stripGap = 3;

// Frames from..to, what is read out of them, and how the times are scaled.
const frameCount = Math.max(...runs.map((run) => run.frames));
const view = { from: -0.5, to: frameCount - 0.5, scale: "fitted", frame: null, printWidth: null };
// All runs aim at the same targets, as a rule; where not, each has a band of its own.
const targetRuns = runs.filter((run, i) => i === 0 || !sameValues(run.target, runs[0].target));
const charts = {};

function frameAxis(width) {
  return makeAxis(view.from, view.to, 52, width - 8);
}

// The top that shows most times well, whatever a few of them are: 1.25 times what 95 % do not exceed, but not over 4
// times their median nor under 1.5 times the highest target; the highest time where that is less.
function fittedTop(highest, highestTarget) {
  const sample = shownRuns().flatMap((run) => sampleInView(run.time, view)).sort((a, b) => a - b);
  const least = 1.5 * highestTarget;
  if (sample.length === 0) return least > 0 ? least : 1;
  const robust = Math.min(1.25 * ranked(sample, 0.95), 4 * ranked(sample, 0.5));
  const top = Math.min(1.05 * highest, Math.max(least, robust));
  return Math.max(top, 1.1 * highestTarget) || 1;
}

function highestOf(buckets) {
  return buckets.reduce((most, { high }) => (Number.isFinite(high) ? Math.max(most, high) : most), 0);
}

function lowestOf(buckets) {
  return buckets.reduce((least, { low }) => Math.min(least, low), Infinity);
}

// From 0, unless that would leave much of the picture empty.
function fittedAxis(top, lowest, begin, end) {
  const low = lowest - 0.08 * (top - lowest);
  return makeAxis(low > 0.35 * top ? low : 0, top, begin, end);
}

function timeAxis(curves, targets, begin, end) {
  const highest = Math.max(0, ...curves.map(({ times }) => highestOf(times)));
  const highestTarget = Math.max(0, ...targets.map(highestOf));
  const full = Math.max(1.05 * highest, 1.1 * highestTarget) || 1;
  if (view.scale === "fitted") {
    const lowest = Math.min(...curves.map(({ times }) => lowestOf(times)), ...targets.map((target) => 0.95 * lowestOf(target)));
    return fittedAxis(fittedTop(highest, highestTarget), lowest, begin, end);
  }
  if (view.scale === "full") return makeAxis(0, full, begin, end);
  const lows = curves.flatMap(({ times }) => times).filter(({ low, high }) => low > 0 && low <= high);
  const low = lows.reduce((least, bucket) => Math.min(least, bucket.low), full / 10);
  return makeAxis(Math.max(low / 1.2, full / 1e6), full, begin, end, true);
}

// The layers of a chart over frames: what is drawn again on every change of the view, and what follows the pointer.
function openChart(id, height, bottom) {
  const { svg, width } = openPicture(id, height, view.printWidth);
  const x = frameAxis(width);
  const clip = add(svg, "clipPath", { id: id + "-clip" });
  add(clip, "rect", { x: x.begin, y: -8, width: x.end - x.begin, height: height + 8 });
  const ground = add(svg, "g");
  const layer = add(svg, "g", { "clip-path": `url(#${id}-clip)` });
  drawXTicks(svg, x, bottom, linearTicks(x, Math.max(3, Math.round(width / 110))).filter(Number.isInteger), grouped);
  svg.dataset.from = view.from;
  svg.dataset.to = view.to;
  const chart = { svg, ground, layer, x, bottom, cross: add(svg, "g", { class: "cross-layer" }) };
  charts[id] = chart;
  return chart;
}

// Returns the group of the line, which may have to lie above what is drawn later.
function drawTarget(chart, y, run, buckets) {
  const group = addRun(chart.layer, run);
  const all = buckets.filter(({ low, high }) => Number.isFinite(low) && Number.isFinite(high));
  let band = "";
  for (let i = 0; i < all.length;) {
    const first = all[i];
    let end = first.end;
    for (++i; i < all.length && all[i].begin === end && all[i].low === first.low && all[i].high === first.high; ++i) {
      end = all[i].end;
    }
    const left = px(frameAt(chart.x, first.begin - 0.5)), right = px(frameAt(chart.x, end - 0.5));
    band += `M${left} ${px(y.at(1.05 * first.high))}H${right}V${px(y.at(0.95 * first.low))}H${left}Z`;
  }
  add(group, "path", { class: "band", d: band });
  const above = addRun(chart.layer, run);
  const line = add(above, "path", { class: "target", d: curvePath(all, chart.x, y, true) });
  if (targetRuns.length > 1) line.style.stroke = "var(--run)";
  return above;
}

// Small triangles at the top where a curve goes on beyond it.
function drawCarets(group, chart, y, buckets) {
  let path = "", last = -Infinity;
  for (const { begin, end, low, high } of buckets) {
    const place = frameAt(chart.x, (begin + end - 1) / 2);
    if (low > high || high <= y.high || place - last < 5) continue;
    path += `M${px(place - 3.5)} ${y.end}h7l-3.5 -6z`;
    last = place;
  }
  if (path) add(group, "path", { class: "caret", d: path });
}

// A column that holds several states is shared between them.
function drawStates(chart, run, top) {
  const { x } = chart;
  const paths = ["", "", ""];
  const columns = thin(run.state, x);
  for (let i = 0; i < columns.length;) {
    const { begin } = columns[i];
    const pure = columns[i].low === columns[i].high;
    let end = columns[i].end;
    for (++i; pure && i < columns.length && columns[i].low === run.state[begin] && columns[i].high === run.state[begin]; ++i) {
      end = columns[i].end;
    }
    const [slowed, points] = run.before.map((before) => (before[end] - before[begin]) / (end - begin));
    const left = px(frameAt(x, begin - 0.5)), right = px(frameAt(x, end - 0.5));
    let y = top;
    [1 - slowed - points, slowed, points].forEach((share, state) => {
      if (share > 0) paths[state] += `M${left} ${px(y)}H${right}V${px(y + share * stripHeight)}H${left}Z`;
      y += share * stripHeight;
    });
  }
  const group = addRun(chart.layer, run);
  group.classList.add("strip");
  paths.forEach((path, state) => path && add(group, "path", { class: `state-${state}`, d: path }));
  add(addRun(chart.ground, run), "rect", { class: "chip-bar", x: x.begin - 10, y: top, width: 5, height: stripHeight });
}

function drawFrameChart() {
  const shown = shownRuns();
  const plot = view.printWidth ? 250 : window.innerWidth < 700 ? 230 : 360;
  const strips = Math.max(1, shown.length) * (stripHeight + stripGap);
  const chart = openChart("frame-chart", plot + 8 + strips + 22, plot + 8 + strips);
  const { x } = chart;
  const curves = shown.map((run) => ({ run, times: thin(run.time, x) }));
  const targets = targetRuns.filter((run, i) => i === 0 || run.shown).map((run) => ({ run, buckets: thin(run.target, x) }));
  const y = chart.y = timeAxis(curves, targets.map(({ buckets }) => buckets), plot, 14);
  const lines = targets.map(({ run, buckets }) => drawTarget(chart, y, run, buckets));
  drawYAxis(chart.ground, x, y, 6);
  curves.forEach(({ run, times }, i) => {
    const group = addRun(chart.layer, run);
    add(group, "path", { class: "curve measured", d: curvePath(times, x, y, false) });
    const predicted = isThinned(x) ? meanBuckets(run.predicted, times) : thin(run.predicted, x);
    add(group, "path", { class: "curve predicted", d: curvePath(predicted, x, y, false) });
    drawCarets(group, chart, y, times);
    drawStates(chart, run, plot + 8 + i * (stripHeight + stripGap));
  });
  // Thinned curves are areas: they would hide the target.
  if (isThinned(x)) lines.forEach((line) => {
    line.classList.add("above");
    chart.layer.append(line);
  });
}

function drawDetailChart(id, key) {
  const plot = 104;
  const chart = openChart(id, plot + 22, plot);
  const { x } = chart;
  const curves = shownRuns().map((run) => ({ run, values: thin(run[key], x) }));
  const highest = Math.max(0, ...curves.map(({ values }) => highestOf(values)));
  const y = chart.y = makeAxis(0, 1.08 * highest || 1, plot, 8);
  drawYAxis(chart.ground, x, y, 3);
  for (const { run, values } of curves) {
    const group = addRun(chart.layer, run);
    add(group, "path", { class: "curve detail", d: curvePath(values, x, y, true) });
    drawCarets(group, chart, y, values);
  }
}

// The line through all charts at the frame that is read out, and a dot on each curve.
function drawCross() {
  const keys = { "frame-chart": "time", "distance-chart": "distance", "splat-chart": "splat" };
  for (const [id, key] of Object.entries(keys)) {
    const { cross, x, y, bottom } = charts[id];
    cross.replaceChildren();
    if (view.frame === null || view.frame < view.from || view.frame > view.to) continue;
    const place = px(x.at(view.frame));
    add(cross, "path", { class: "cross", d: `M${place} ${y.end - 6}V${bottom}` });
    for (const run of shownRuns()) {
      const value = run[key][view.frame];
      if (value === undefined || Number.isNaN(value)) continue;
      add(addRun(cross, run), "circle", { class: "dot", cx: place, cy: px(y.at(value)), r: 4 });
    }
  }
}

function drawTimeCharts() {
  drawFrameChart();
  drawDetailChart("distance-chart", "distance");
  drawDetailChart("splat-chart", "splat");
  drawCross();
}
