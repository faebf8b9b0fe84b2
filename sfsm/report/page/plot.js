// Curves thinned to what can be seen. The static picture's twin of this is plot.cpp.

// Where frames lie along an axis: frame i from begins(i) to begins(i + 1); first(at) is the first that begins at `at`
// or later. Either by their number, each in the middle of its place ...
const byNumber = {
  begins: (i) => i - 0.5,
  first: (at) => Math.ceil(at + 0.5),
};

// ... or by when they began.
function bySeconds(starts) {
  const first = (at) => {
    let low = 0, high = starts.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (starts[middle] < at) low = middle + 1;
      else high = middle;
    }
    return low;
  };
  return { begins: (i) => starts[Math.min(i, starts.length - 1)], first };
}

// The frame that holds this place.
const frameAtPlace = (places, at, frames) => Math.min(Math.max(places.first(at + 1e-9) - 1, 0), frames - 1);

// A group of what belongs to a run: its colour, and what the legend makes stand out.
function addRun(parent, run) {
  const group = add(parent, "g", { class: "run", "data-run": run.index });
  group.style.setProperty("--run", runColour(run));
  return group;
}

function runColour(run) {
  return `var(--run-${run.index % 8})`;
}

// Least and most of the frames [begin, end); low > high: nothing is known of any.
function bucketOf(series, begin, end) {
  let low = Infinity, high = -Infinity;
  const to = Math.ceil(end / series.width);
  for (let i = Math.floor(begin / series.width); i < to; ++i) {
    if (series.low[i] <= low) low = series.low[i];
    if (series.high[i] >= high) high = series.high[i];
  }
  return { begin, end, low, high };
}

// The frames in view, and one more on either side, so that curves run out of the picture.
function framesInView(places, frames, x) {
  return { begin: Math.max(0, places.first(x.low) - 2), end: Math.min(frames, places.first(x.high) + 2) };
}

// Whether so many frames are in view that several share a bucket.
function isThinned(places, frames, x) {
  const { begin, end } = framesInView(places, frames, x);
  return end - begin > 2 * (along(x, places.begins(end)) - along(x, places.begins(begin)));
}

// Frames in view, one bucket each as long as no more than two share a column of the picture, else one a column: no
// spike is lost.
function thin(series, places, x) {
  const { begin, end } = framesInView(places, series.frames, x);
  const buckets = [];
  if (!isThinned(places, series.frames, x)) {
    for (let i = begin; i < end; ++i) buckets.push(bucketOf(series, i, i + 1));
    return buckets;
  }
  // Columns stand still among the frames while the view moves, or curves would flicker.
  const width = (x.high - x.low) / (x.end - x.begin);
  let from = begin;
  for (let column = Math.floor(places.begins(begin) / width) + 1; from < end; ++column) {
    const to = Math.min(end, places.first(column * width));
    if (to > from) buckets.push(bucketOf(series, from, to));
    from = Math.max(from, to);
  }
  return buckets;
}

// From bucket to bucket, each from the end that is nearer to where the last one ended. `steps`: values hold for whole
// frames. One that stands alone becomes a short dash, or nobody would see it.
function curvePath(buckets, places, x, y, steps) {
  let path = "", isDrawing = false, last = 0;
  for (let i = 0; i < buckets.length; ++i) {
    const { begin, end, low, high } = buckets[i], next = buckets[i + 1];
    if (low > high) {
      isDrawing = false;
      continue;
    }
    const isAlone = !isDrawing && !(next && next.low <= next.high);
    let near = y.at(low), far = y.at(high);
    if (isDrawing && Math.abs(far - last) < Math.abs(near - last)) [near, far] = [far, near];
    const left = along(x, places.begins(begin)), right = along(x, places.begins(end));
    path += (isDrawing ? "L" : "M") + px(steps ? left : (left + right) / 2) + " " + px(near);
    if (near !== far || !isDrawing) path += "V" + px(far);
    if (steps) path += "H" + px(right);
    else if (isAlone) path += "h-3h6";
    isDrawing = true;
    last = far;
  }
  return path;
}

// From the axis' low end up to each bucket's `end`.
function areaPath(buckets, places, x, y, end) {
  let path = "";
  for (const bucket of buckets) {
    if (bucket.low > bucket.high) continue;
    const left = px(along(x, places.begins(bucket.begin))), right = px(along(x, places.begins(bucket.end)));
    path += `M${left} ${px(y.begin)}V${px(y.at(bucket[end]))}H${right}V${px(y.begin)}Z`;
  }
  return path;
}

// Unlike x.at, also beyond the picture, where a clip path cuts.
function along(x, place) {
  return x.begin + (place - x.low) * (x.end - x.begin) / (x.high - x.low);
}

// The column means of what is known: what a line can show of many frames.
function meanBuckets(series, buckets) {
  return buckets.map(({ begin, end }) => {
    let sum = 0, count = 0;
    const to = Math.ceil(end / series.width);
    for (let i = Math.floor(begin / series.width); i < to; ++i) {
      const middle = (series.low[i] + series.high[i]) / 2;
      if (!Number.isFinite(middle)) continue;
      sum += middle;
      ++count;
    }
    return count > 0 ? { begin, end, low: sum / count, high: sum / count } : { begin, end, low: 1, high: 0 };
  });
}

function highestOf(buckets) {
  return buckets.reduce((most, { high }) => (Number.isFinite(high) ? Math.max(most, high) : most), 0);
}

function lowestOf(buckets) {
  return buckets.reduce((least, { low }) => Math.min(least, low), Infinity);
}

// The top that shows most times well, whatever a few of them are: 1.25 times what 95 % of the sorted sample do not
// exceed, but not over 4 times its median nor under 1.5 times the highest target; the highest time where that is less.
function fittedTop(sample, highest, highestTarget) {
  const least = 1.5 * highestTarget;
  if (sample.length === 0) return least > 0 ? least : 1;
  const robust = Math.min(1.25 * ranked(sample, 0.95), 4 * ranked(sample, 0.5));
  const top = Math.min(1.05 * highest, Math.max(least, robust));
  return Math.max(top, 1.1 * highestTarget) || 1;
}

// From 0, unless that would leave much of the picture empty.
function fittedAxis(top, lowest, begin, end) {
  const low = lowest - 0.08 * (top - lowest);
  return makeAxis(low > 0.35 * top ? low : 0, top, begin, end);
}

// An axis for these buckets of times, with room for the targets; `sample()`: sorted times in view.
function timesAxis(scale, buckets, targets, sample, begin, end) {
  const highest = highestOf(buckets), highestTarget = highestOf(targets);
  const full = Math.max(1.05 * highest, 1.1 * highestTarget) || 1;
  if (scale === "fitted") {
    const lowest = Math.min(lowestOf(buckets), 0.95 * lowestOf(targets));
    return fittedAxis(fittedTop(sample(), highest, highestTarget), lowest, begin, end);
  }
  if (scale === "full") return makeAxis(0, full, begin, end);
  const lows = buckets.filter(({ low, high }) => low > 0 && low <= high);
  const low = lows.reduce((least, bucket) => Math.min(least, bucket.low), full / 10);
  return makeAxis(Math.max(low / 1.2, full / 1e6), full, begin, end, true);
}

// At most 4096 of the known values of the frames in view.
function sampleInView(series, places, x) {
  const { begin, end } = framesInView(places, series.frames, x);
  const from = Math.floor(begin / series.width), to = Math.ceil(end / series.width);
  const stride = Math.max(1, Math.ceil((to - from) / 4096));
  const sample = [];
  for (let i = from; i < to; i += stride) if (Number.isFinite(series.high[i])) sample.push(series.high[i]);
  return sample;
}

const sortedSample = (samples) => samples.flat().sort((a, b) => a - b);

// Small triangles at the top where a curve goes on beyond it.
function drawCarets(group, chart, y, buckets, places) {
  let path = "", last = -Infinity;
  for (const { begin, end, low, high } of buckets) {
    if (low > high || high <= y.high) continue;
    const place = (along(chart.x, places.begins(begin)) + along(chart.x, places.begins(end))) / 2;
    if (place - last < 5) continue;
    path += `M${px(place - 3.5)} ${y.end}h7l-3.5 -6z`;
    last = place;
  }
  if (path) add(group, "path", { class: "caret", d: path });
}
