// What laws decided, over frames: times against target with the states below, D, and S; and measured against predicted.

const stripHeight = 12, stripGap = 3;

// Returns the group of the line, which may have to lie above what is drawn later.
function drawTarget(chart, y, run, buckets, isAlone) {
  const group = addRun(chart.layer, run);
  const all = buckets.filter(({ low, high }) => Number.isFinite(low) && Number.isFinite(high));
  let band = "";
  for (let i = 0; i < all.length;) {
    const first = all[i];
    let end = first.end;
    for (++i; i < all.length && all[i].begin === end && all[i].low === first.low && all[i].high === first.high; ++i) {
      end = all[i].end;
    }
    const left = px(along(chart.x, first.begin - 0.5)), right = px(along(chart.x, end - 0.5));
    band += `M${left} ${px(y.at(1.05 * first.high))}H${right}V${px(y.at(0.95 * first.low))}H${left}Z`;
  }
  add(group, "path", { class: "band", d: band });
  const above = addRun(chart.layer, run);
  const line = add(above, "path", { class: "target", d: curvePath(all, byNumber, chart.x, y, true) });
  if (!isAlone) line.style.stroke = "var(--run)";
  return above;
}

// A column that holds several states is shared between them.
function drawStates(chart, run, top) {
  const { x } = chart;
  const paths = ["", "", ""];
  const columns = thin(run.time, byNumber, x).map(({ begin, end }) => ({ begin, end, shares: run.shares(begin, end) }));
  for (let i = 0; i < columns.length;) {
    const { begin, shares } = columns[i];
    const isPure = shares.includes(1);
    let end = columns[i].end;
    for (++i; isPure && i < columns.length && columns[i].shares.every((share, state) => share === shares[state]); ++i) {
      end = columns[i].end;
    }
    const left = px(along(x, begin - 0.5)), right = px(along(x, end - 0.5));
    let y = top;
    shares.forEach((share, state) => {
      if (share > 0) paths[state] += `M${left} ${px(y)}H${right}V${px(y + share * stripHeight)}H${left}Z`;
      y += share * stripHeight;
    });
  }
  const group = addRun(chart.layer, run);
  group.classList.add("strip");
  paths.forEach((path, state) => path && add(group, "path", { class: `state-${state}`, d: path }));
  add(addRun(chart.ground, run), "rect", { class: "chip-bar", x: x.begin - 10, y: top, width: 5, height: stripHeight });
}

// Of many frames an area as pale as glass and the means as a line: what lies below stays in sight.
function drawRunTimes(group, chart, y, run, times) {
  if (!isThinned(byNumber, run.frames, chart.x)) {
    add(group, "path", { class: "curve measured", d: curvePath(times, byNumber, chart.x, y, false) });
    add(group, "path", { class: "curve predicted", d: curvePath(thin(run.predicted, byNumber, chart.x), byNumber, chart.x, y, false) });
    return;
  }
  add(group, "path", { class: "curve extent", d: curvePath(times, byNumber, chart.x, y, false) });
  add(group, "path", { class: "curve measured", d: curvePath(meanBuckets(run.time, times), byNumber, chart.x, y, false) });
  add(group, "path", { class: "curve predicted", d: curvePath(meanBuckets(run.predicted, times), byNumber, chart.x, y, false) });
}

// Later runs below the first, which is what was recorded or the run that is asked about.
function drawFrameChart(shown, targetRuns, view) {
  const plot = view.printWidth ? 250 : window.innerWidth < 700 ? 230 : 360;
  const strips = Math.max(1, shown.length) * (stripHeight + stripGap);
  const chart = openChart("frame-chart", plot + 8 + strips + 22, plot + 8 + strips, view, drawFrameLabels);
  const { x } = chart;
  const curves = shown.map((run) => ({ run, times: thin(run.time, byNumber, x) }));
  const targets = targetRuns.map((run) => ({ run, buckets: thin(run.target, byNumber, x) }));
  const sample = () => sortedSample(shown.map((run) => sampleInView(run.time, byNumber, x)));
  const y = chart.y = timesAxis(view.scale, curves.flatMap(({ times }) => times), targets.flatMap(({ buckets }) => buckets), sample, plot, 14);
  const lines = targets.map(({ run, buckets }) => drawTarget(chart, y, run, buckets, targets.length === 1));
  drawYAxis(chart.ground, x, y, 6);
  curves.forEach(({ run }, i) => drawStates(chart, run, plot + 8 + i * (stripHeight + stripGap)));
  for (const { run, times } of [...curves].reverse()) {
    const group = addRun(chart.layer, run);
    drawRunTimes(group, chart, y, run, times);
    drawCarets(group, chart, y, times, byNumber);
  }
  if (shown.some((run) => isThinned(byNumber, run.frames, x))) {
    for (const line of lines) {
      line.classList.add("above");
      chart.layer.append(line);
    }
  }
  return chart;
}

function drawDetailChart(id, key, shown, view) {
  const plot = 104;
  const chart = openChart(id, plot + 22, plot, view, drawFrameLabels);
  const { x } = chart;
  const curves = shown.map((run) => ({ run, values: thin(run[key], byNumber, x) }));
  const highest = Math.max(0, ...curves.map(({ values }) => highestOf(values)));
  const y = chart.y = makeAxis(0, 1.08 * highest || 1, plot, 8);
  drawYAxis(chart.ground, x, y, 3);
  for (const { run, values } of [...curves].reverse()) {
    const group = addRun(chart.layer, run);
    add(group, "path", { class: "curve detail", d: curvePath(values, byNumber, x, y, true) });
    drawCarets(group, chart, y, values, byNumber);
  }
  return chart;
}

// How many frames are in each cell of measured against predicted, and their errors in shares of what was predicted.
function pairUp(run, begin, end, axis, cell) {
  const across = Math.ceil((axis.end - axis.begin) / cell);
  const counts = new Uint32Array((across + 1) * (across + 1));
  const errors = [];
  for (let i = begin; i < Math.min(end, run.frames); i += run.time.width) {
    const time = valueAt(run.time, i), predicted = valueAt(run.predicted, i);
    if (!Number.isFinite(time) || !Number.isFinite(predicted) || predicted <= 0) continue;
    errors.push(Math.abs(time / predicted - 1));
    const column = Math.floor((axis.at(predicted) - axis.begin) / cell), row = Math.floor((axis.at(time) - axis.begin) / cell);
    ++counts[row * (across + 1) + column];
  }
  return { across, counts, errors: Float32Array.from(errors).sort() };
}

// Four depths of colour, by the logarithm of how many frames share the cell.
function drawCells(group, { across, counts }, x, y, cell) {
  const most = Math.log(1 + counts.reduce((a, b) => Math.max(a, b), 0));
  const paths = ["", "", "", ""];
  counts.forEach((count, i) => {
    if (count === 0) return;
    const depth = Math.min(3, Math.floor(4 * Math.log(1 + count) / most));
    const left = x.begin + (i % (across + 1)) * cell, low = y.begin - Math.floor(i / (across + 1)) * cell;
    paths[depth] += `M${px(left)} ${px(low - cell)}h${cell}v${cell}h-${cell}z`;
  });
  paths.forEach((path, depth) => path && add(group, "path", { class: "cells", d: path, "fill-opacity": 0.35 + 0.2 * depth }));
}

function drawScatter(told, begin, end, printWidth) {
  const { svg, width } = openPicture("scatter", spreadHeight, printWidth);
  const cell = 3, bottom = spreadHeight - 24, side = Math.min(bottom - 10, width - 56);
  const range = spreadRange(told);
  const x = makeAxis(range.low, range.high, 46, 46 + side, range.isLog);
  const y = makeAxis(range.low, range.high, bottom, bottom - side, range.isLog);
  drawYAxis(svg, x, y, 6);
  drawXTicks(svg, x, bottom, ticksOf(x, 5));
  add(svg, "path", { class: "diagonal", d: `M${x.begin} ${y.begin}L${x.end} ${y.end}` });
  told.forEach(({ run }, i) => {
    const pairs = pairUp(run, begin, end, x, cell);
    const group = addRun(svg, run);
    drawCells(group, pairs, x, y, cell);
    if (pairs.errors.length === 0) return;
    const near = brief(Number((100 * ranked(pairs.errors, 0.5)).toPrecision(2)));
    add(group, "rect", { class: "chip-bar", x: x.begin + 8, y: y.end + 6 + 18 * i, width: 5, height: 10 });
    add(group, "text", { class: "told", x: x.begin + 19, y: y.end + 15 + 18 * i }, `half within \u00b1${near} %`);
  });
}
