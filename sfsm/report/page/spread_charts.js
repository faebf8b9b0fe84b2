// How the times of the frames in view are spread: histogram, percentiles, and measured against predicted.

const spreadHeight = 300;
const markedShares = [0.5, 0.95, 0.99];

function spreadWidth() {
  return view.printWidth ? view.printWidth / 2 - 15 : null;
}

// An axis that holds nearly all the times: logarithmic where they differ much.
function spreadRange(spreads) {
  const all = spreads.filter(({ sorted }) => sorted.length > 0);
  if (all.length === 0) return { low: 0, high: 1, isLog: false };
  const low = Math.min(...all.map(({ sorted }) => ranked(sorted, 0.005)));
  const high = Math.max(...all.map(({ sorted }) => ranked(sorted, 0.995)));
  const isLog = low > 0 && high > 6 * low;
  if (isLog) return { low: low / 1.15, high: high * 1.15, isLog };
  const margin = 0.06 * (high - low) || 0.1 * Math.abs(high) || 1;
  return { low: low >= 0 ? Math.max(0, low - margin) : low - margin, high: high + margin, isLog };
}

// Shares of frames in each bin; times beyond the axis are in the bins at its ends.
function binned(sorted, x, bins) {
  const shares = new Array(bins).fill(0);
  const perPixel = bins / (x.end - x.begin);
  for (const time of sorted) {
    shares[Math.min(bins - 1, Math.max(0, Math.floor((x.at(time) - x.begin) * perPixel)))] += 100 / sorted.length;
  }
  return shares;
}

function drawHistogram(spreads, range) {
  const { svg, width } = openPicture("histogram", spreadHeight, spreadWidth());
  const rows = 14 + 13 * spreads.length, bottom = spreadHeight - 24;
  const x = makeAxis(range.low, range.high, 40, width - 12, range.isLog);
  const bins = Math.max(12, Math.round((x.end - x.begin) / 6));
  const all = spreads.map(({ sorted }) => binned(sorted, x, bins));
  const y = makeAxis(0, 1.05 * Math.max(...all.flat(), 0) || 1, bottom, rows + 8);
  drawYAxis(svg, x, y, 4);
  drawXTicks(svg, x, bottom, ticksOf(x, Math.round(width / 75)));
  spreads.forEach(({ run, sorted }, i) => {
    const group = addRun(svg, run);
    const step = (x.end - x.begin) / bins;
    const steps = all[i].map((share, k) => `V${px(y.at(share))}H${px(x.begin + (k + 1) * step)}`).join("");
    add(group, "path", { class: "bars", d: `M${x.begin} ${bottom}${steps}V${bottom}Z` });
    if (sorted.length > 0) drawPercentileRow(group, x, sorted, 20 + 13 * i, i === 0);
  });
}

// Ticks at the marked percentiles; the first row tells which.
function drawPercentileRow(group, x, sorted, y, isFirst) {
  const places = markedShares.map((share) => x.at(ranked(sorted, share)));
  add(group, "path", { class: "mark", d: `M${px(places[0])} ${y}H${px(places.at(-1))}` });
  let last = -Infinity;
  markedShares.forEach((share, k) => {
    add(group, "path", { class: "mark", d: `M${px(places[k])} ${y - 4}v8` });
    if (!isFirst || places[k] - last < 34) return;
    last = places[k];
    add(group, "text", { x: px(places[k]), y: y - 8, "text-anchor": "middle" }, `${brief(100 * share)} %`);
  });
}

// Nines along x: as far from 90 % to 99 % as from 99 % to 99.9 %.
function drawPercentiles(spreads) {
  const { svg, width } = openPicture("percentiles", spreadHeight, spreadWidth());
  const bottom = spreadHeight - 24;
  const most = Math.max(0, ...spreads.map(({ sorted }) => sorted.length));
  const nines = Math.min(5, Math.max(1, Math.log10(most)));
  const x = makeAxis(0, nines, 46, width - 18);
  const ends = spreads.filter(({ sorted }) => sorted.length > 0).map(({ sorted }) => [sorted[0], ranked(sorted, 1 - 10 ** -nines)]);
  const low = Math.min(...ends.flat()), high = Math.max(...ends.flat());
  const isLog = low > 0 && high > 6 * low;
  const y = ends.length === 0 ? makeAxis(0, 1, bottom, 10)
      : isLog ? makeAxis(low / 1.1, high * 1.1, bottom, 10, true)
      : makeAxis(Math.min(0, low), 1.05 * high || 1, bottom, 10);
  drawYAxis(svg, x, y, 6);
  const ticks = [0.5, 0.9, 0.99, 0.999, 0.9999].filter((share) => -Math.log10(1 - share) <= nines);
  for (const share of ticks) drawXTicks(svg, x, bottom, [-Math.log10(1 - share)], () => `${brief(100 * share)} %`);
  for (const { run, sorted } of spreads) {
    if (sorted.length === 0) continue;
    let path = "";
    for (let pixel = x.begin; pixel <= x.end; ++pixel) {
      const share = 1 - 10 ** -x.invert(pixel);
      path += (path ? "L" : "M") + pixel + " " + px(y.at(ranked(sorted, share)));
    }
    add(addRun(svg, run), "path", { class: "curve percentile", d: path });
  }
}

// How many frames are in each cell of measured against predicted, and their errors in shares of what was predicted.
function pairUp(run, begin, end, axis, cell) {
  const across = Math.ceil((axis.end - axis.begin) / cell);
  const counts = new Uint32Array((across + 1) * (across + 1));
  const errors = [];
  for (let i = begin; i < Math.min(end, run.frames); ++i) {
    const time = run.time[i], predicted = run.predicted[i];
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

const predicts = runs.map((run) => run.predicted.some(Number.isFinite));

function drawScatter(spreads, begin, end) {
  const { svg, width } = openPicture("scatter", spreadHeight, spreadWidth());
  const cell = 3, bottom = spreadHeight - 24, side = Math.min(bottom - 10, width - 56);
  const told = spreads.filter(({ run }) => predicts[run.index]);
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

function drawSpread() {
  const begin = Math.max(0, Math.ceil(view.from)), end = Math.min(frameCount, Math.floor(view.to) + 1);
  const spreads = shownRuns().map((run) => ({ run, sorted: sortedTimes(run, begin, end) }));
  const range = spreadRange(spreads);
  drawHistogram(spreads, range);
  drawPercentiles(spreads);
  if (predicts.includes(true)) drawScatter(spreads, begin, end);
  const isAll = begin === 0 && end === frameCount;
  document.getElementById("spread-range").textContent = isAll ? "of all frames" : `of frames ${grouped(begin)} to ${grouped(end - 1)}`;
}
