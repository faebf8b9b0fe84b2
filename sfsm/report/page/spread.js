// How numbers are spread: histogram and percentiles of sorted values, a colour a run.

const spreadHeight = 300;
const markedShares = [0.5, 0.95, 0.99];

const panelWidth = (view) => (view.printWidth ? view.printWidth / 3 - 20 : null);

// An axis that holds nearly all the values: logarithmic where they differ much.
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

function drawHistogram(id, spreads, range, printWidth) {
  const { svg, width } = openPicture(id, spreadHeight, printWidth);
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
  const places = markedShares.map((share) => x.at(percentileOf(sorted, share)));
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
function drawPercentiles(id, spreads, printWidth) {
  const { svg, width } = openPicture(id, spreadHeight, printWidth);
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
      path += (path ? "L" : "M") + pixel + " " + px(y.at(percentileOf(sorted, share)));
    }
    add(addRun(svg, run), "path", { class: "curve percentile", d: path });
  }
}
