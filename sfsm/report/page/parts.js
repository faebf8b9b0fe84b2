// What pages are made of: elements, numbers as text, axes and their labels.

const byId = (id) => document.getElementById(id);

function addHtml(parent, name, text = "", attributes = {}) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.textContent = text;
  parent.append(element);
  return element;
}

const svgNamespace = document.querySelector("svg").namespaceURI;

function add(parent, name, attributes = {}, text = "") {
  const element = document.createElementNS(svgNamespace, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.textContent = text;
  parent.append(element);
  return element;
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

// Seconds as "1:04.25" or "2:01:04.25".
function clockText(seconds) {
  const thousandths = Math.round(seconds * 1000), two = (value) => (value < 10 ? "0" : "") + value;
  const hours = Math.floor(thousandths / 3.6e6), minutes = Math.floor(thousandths / 6e4) % 60;
  const rest = two(brief((thousandths % 6e4) / 1000));
  return hours > 0 ? `${hours}:${two(minutes)}:${rest}` : `${minutes}:${rest}`;
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

// Seconds whose labels are round as a clock has them.
function clockTicks(axis, most) {
  const rough = (axis.high - axis.low) / most;
  const step = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600].find((value) => value >= rough);
  if (rough < 1) return linearTicks(axis, most);
  const values = [], by = step ?? 3600 * Math.ceil(rough / 3600);
  for (let i = Math.ceil(axis.low / by); i * by <= axis.high; ++i) values.push(i * by);
  return values;
}

const ticksOf = (axis, most) => (axis.isLog ? logTicks(axis, most) : linearTicks(axis, most));

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

function nextTheme() {
  const order = ["system", "light", "dark"];
  const root = document.documentElement;
  const theme = order[(order.indexOf(root.dataset.theme ?? "system") + 1) % order.length];
  root.dataset.theme = theme;
  root.style.colorScheme = theme === "system" ? "" : theme;
  byId("theme").textContent = `Theme: ${theme}`;
}
