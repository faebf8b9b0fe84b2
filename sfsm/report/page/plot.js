// Where numbers lie in a picture: axes, curves thinned to what can be seen, and the SVG they are drawn into. The static
// picture's twin of this is plot.cpp.

const svgNamespace = document.querySelector("svg").namespaceURI;

function add(parent, name, attributes = {}, text = "") {
  const element = document.createElementNS(svgNamespace, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.textContent = text;
  parent.append(element);
  return element;
}

// A group of what belongs to a run: its colour, and what the legend makes stand out.
function addRun(parent, run) {
  const group = add(parent, "g", { class: "run", "data-run": run.index });
  group.style.setProperty("--run", runColour(run));
  return group;
}

function runColour(run) {
  return `var(--run-${run.index % 8})`;
}

const px = (value) => String(Math.round(value * 100) / 100);

// A number as short as it can be told: 6 figures.
function brief(value) {
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e6 || size < 1e-4)) return String(Number(value.toPrecision(3))).replace("e+", "e");
  return String(Number(value.toPrecision(6)));
}

const grouped = (count) => count.toLocaleString("en");

// Numbers low..high along begin..end [px]. What lies beyond is put at the nearer end.
function makeAxis(low, high, begin, end, isLog = false) {
  const scale = isLog ? Math.log10 : (value) => value;
  const from = scale(low), perUnit = (end - begin) / (scale(high) - scale(low));
  const at = (value) => begin + (scale(Math.min(Math.max(value, low), high)) - from) * perUnit;
  const invert = (pixel) => {
    const value = from + (pixel - begin) / perUnit;
    return isLog ? 10 ** value : value;
  };
  return { low, high, begin, end, isLog, at, invert };
}

function linearTicks(axis, most) {
  const rough = (axis.high - axis.low) / most;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((value) => value >= rough) ?? 10 * power;
  const values = [];
  for (let i = Math.ceil(axis.low / step); i * step <= axis.high && values.length <= most; ++i) values.push(i * step + 0);  // no -0
  return values;
}

// 1, 2 and 5 of each decade; over many decades only some powers of ten.
function logTicks(axis, most) {
  const first = Math.floor(Math.log10(axis.low)), last = Math.ceil(Math.log10(axis.high));
  const factors = (last - first) * 3 <= 2 * most ? [1, 2, 5] : [1];
  const stride = Math.max(1, Math.ceil((last - first) / most));
  const values = [];
  for (let power = first; power <= last; power += stride) {
    for (const factor of factors) values.push(factor * 10 ** power);
  }
  return values.filter((value) => value >= axis.low && value <= axis.high);
}

const ticksOf = (axis, most) => (axis.isLog ? logTicks(axis, most) : linearTicks(axis, most));

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

// Empties the figure's svg for a picture as wide as its place.
function openPicture(id, height, printWidth) {
  const figure = document.getElementById(id);
  const svg = figure.querySelector(":scope > svg");
  const width = printWidth ?? Math.max(figure.clientWidth, 200);
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.replaceChildren();
  return { svg, width, height };
}

// Grid lines with their labels.
function drawYAxis(svg, x, y, most) {
  for (const tick of ticksOf(y, most)) {
    const place = px(y.at(tick));
    add(svg, "path", { class: "grid", d: `M${x.begin} ${place}H${x.end}` });
    add(svg, "text", { x: x.begin - 7, y: Number(place) + 4, "text-anchor": "end" }, brief(tick));
  }
}

function drawXTicks(svg, x, bottom, ticks, label = brief) {
  for (const tick of ticks) {
    add(svg, "path", { class: "axis", d: `M${px(x.at(tick))} ${bottom}v4` });
    add(svg, "text", { x: px(x.at(tick)), y: bottom + 16, "text-anchor": "middle" }, label(tick));
  }
}
