// Curves thinned to what can be seen. The static picture's twin of this is plot.cpp.

// A group of what belongs to a run: its colour, and what the legend makes stand out.
function addRun(parent, run) {
  const group = add(parent, "g", { class: "run", "data-run": run.index });
  group.style.setProperty("--run", runColour(run));
  return group;
}

function runColour(run) {
  return `var(--run-${run.index % 8})`;
}

// Least and most of values [begin, end); low > high: nothing is known of any.
function bucketOf(values, begin, end) {
  let low = Infinity, high = -Infinity;
  for (let i = begin; i < end; ++i) {
    const value = values[i];
    if (value <= low) low = value;
    if (value >= high) high = value;
  }
  return { begin, end, low, high };
}

// Whether so many frames are in view that several share a bucket.
const isThinned = (x) => x.high - x.low > 2 * (x.end - x.begin);

// Frames in view, one bucket each as long as no more than two share a column of the picture, else one a column: no
// spike is lost. One more on either side, so that curves run out of the picture.
function thin(values, x) {
  const first = Math.max(0, Math.floor(x.low)), last = Math.min(values.length, Math.ceil(x.high) + 1);
  const buckets = [];
  if (!isThinned(x)) {
    for (let i = first; i < last; ++i) buckets.push(bucketOf(values, i, i + 1));
    return buckets;
  }
  // Columns stand still among the frames while the view moves, or curves would flicker.
  const width = (x.high - x.low) / (x.end - x.begin);
  for (let column = Math.floor(first / width); column * width < last; ++column) {
    const begin = Math.max(0, Math.ceil(column * width)), end = Math.min(values.length, Math.ceil((column + 1) * width));
    if (begin < end) buckets.push(bucketOf(values, begin, end));
  }
  return buckets;
}

// From bucket to bucket, each from the end that is nearer to where the last one ended. `steps`: values hold for whole
// frames. One that stands alone becomes a short dash, or nobody would see it.
function curvePath(buckets, x, y, steps) {
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
    path += (isDrawing ? "L" : "M") + px(frameAt(x, steps ? begin - 0.5 : (begin + end - 1) / 2)) + " " + px(near);
    if (near !== far || !isDrawing) path += "V" + px(far);
    if (steps) path += "H" + px(frameAt(x, end - 0.5));
    else if (isAlone) path += "h-3h6";
    isDrawing = true;
    last = far;
  }
  return path;
}

// Unlike x.at, also beyond the picture, where a clip path cuts.
function frameAt(x, frame) {
  return x.begin + (frame - x.low) * (x.end - x.begin) / (x.high - x.low);
}

// The column means of what is known: what a dashed line can show of many frames.
function meanBuckets(values, buckets) {
  return buckets.map(({ begin, end }) => {
    let sum = 0, count = 0;
    for (let i = begin; i < end; ++i) {
      if (!Number.isFinite(values[i])) continue;
      sum += values[i];
      ++count;
    }
    return count > 0 ? { begin, end, low: sum / count, high: sum / count } : { begin, end, low: 1, high: 0 };
  });
}

// At most 4096 of the finite values in view, sorted.
function sampleInView(values, view) {
  const begin = Math.max(0, Math.ceil(view.from)), end = Math.min(values.length, Math.floor(view.to) + 1);
  const stride = Math.max(1, Math.ceil((end - begin) / 4096));
  const sample = [];
  for (let i = begin; i < end; i += stride) if (Number.isFinite(values[i])) sample.push(values[i]);
  return sample;
}
