// What the reader does: choose runs, zoom, move, read out.

const leastFrames = 8;  // in view

// Drawing waits for the next picture, the spread until the view has come to rest: a million times take a while to sort.
let drawingIsDue = false, spreadTimer = 0;
function redraw() {
  if (!drawingIsDue) requestAnimationFrame(drawDue);
  drawingIsDue = true;
  clearTimeout(spreadTimer);
  spreadTimer = setTimeout(drawSpread, 100);
}

function drawDue() {
  drawingIsDue = false;
  drawTimeCharts();
  const first = Math.max(0, Math.ceil(view.from)), last = Math.min(frameCount - 1, Math.floor(view.to));
  byId("range").textContent = `frames ${grouped(first)} to ${grouped(last)} of ${grouped(frameCount)}`;
}

// Keeps the view inside the run.
function setView(from, to) {
  const span = Math.min(Math.max(to - from, Math.min(leastFrames, frameCount)), frameCount);
  const middle = (from + to) / 2;
  view.from = Math.min(Math.max(middle - span / 2, -0.5), frameCount - 0.5 - span);
  view.to = view.from + span;
  redraw();
}

function zoom(factor, around = (view.from + view.to) / 2) {
  setView(around - (around - view.from) * factor, around + (view.to - around) * factor);
}

function pan(share) {
  const by = share * (view.to - view.from);
  setView(view.from + by, view.to + by);
}

const showAll = () => setView(-0.5, frameCount - 0.5);
const isAllShown = () => view.to - view.from >= frameCount;

// Reading out.

const frameText = (value) => (Number.isNaN(value) ? "\u2013" : Number.isFinite(value) ? shortFixed(value) : value > 0 ? "\u221e" : "-\u221e");

function shortFixed(value) {
  const size = Math.abs(value);
  return size >= 1e6 ? brief(value) : value.toFixed(size < 10 ? 3 : size < 1000 ? 2 : 1);
}

const columns = [
  ["time", "ms", (run, i) => frameText(run.time[i])],
  ["target", "target", (run, i) => frameText(run.target[i])],
  ["predicted", "predicted", (run, i) => frameText(run.predicted[i])],
  ["state", "state", (run, i) => stateNames[run.state[i]] ?? "\u2013"],
  ["distance", "D m", (run, i) => frameText(run.distance[i])],
  ["splat", "S px", (run, i) => frameText(run.splat[i])],
];
const hasRates = runs.some((run) => run.rate);
if (hasRates) columns.push(["rate", "rate px/piece", (run, i) => (run.rate?.[i] > 0 ? brief(Number(run.rate[i].toPrecision(4))) : "\u2013")]);

function addChip(parent, run) {
  const chip = addHtml(parent, "i", "", { class: "chip" });
  chip.style.setProperty("--run", runColour(run));
}

function fillReadout() {
  const table = document.createElement("table");
  addHtml(table, "caption", `Frame ${grouped(view.frame)}`);
  const head = addHtml(addHtml(table, "thead"), "tr");
  addHtml(head, "th");
  for (const [, title] of columns) addHtml(head, "th", title);
  const body = addHtml(table, "tbody");
  for (const run of shownRuns().filter((shown) => view.frame < shown.frames)) {
    const row = addHtml(body, "tr", "", { "data-run": run.index });
    const name = addHtml(row, "th");
    addChip(name, run);
    name.append(run.name);
    for (const [key, , tell] of columns) addHtml(row, "td", tell(run, view.frame), { "data-key": key });
  }
  byId("readout").replaceChildren(table);
  byId("readout").dataset.frame = view.frame;
}

// Beside the frame, on the side that has more room.
function placeReadout(chart) {
  const readout = byId("readout");
  const box = chart.svg.getBoundingClientRect();
  const place = box.left + chart.x.at(view.frame) * box.width / chart.svg.viewBox.baseVal.width;
  const { width, height } = readout.getBoundingClientRect();
  const left = place + 16 + width < window.innerWidth ? place + 16 : place - 16 - width;
  readout.style.left = `${Math.max(4, left)}px`;
  readout.style.top = `${Math.max(4, Math.min(box.top + 6, window.innerHeight - height - 4))}px`;
}

function readOut(frame, chart) {
  view.frame = frame === null ? null : Math.min(Math.max(Math.round(frame), 0), frameCount - 1);
  byId("readout").hidden = view.frame === null;
  drawCross();
  if (view.frame === null) return;
  fillReadout();
  placeReadout(chart);
}

// For those who hear the page: one sentence a run.
function speak() {
  const sentences = shownRuns().filter((run) => view.frame < run.frames)
    .map((run) => `${run.name}: ${columns.map(([, title, tell]) => `${title} ${tell(run, view.frame)}`).join(", ")}`);
  byId("spoken").textContent = `Frame ${view.frame}. ${sentences.join(". ")}`;
}

function stepFrame(by, chart) {
  const middle = Math.round((view.from + view.to) / 2);
  readOut(view.frame === null ? middle : view.frame + by, chart);
  const span = view.to - view.from;
  if (view.frame < view.from || view.frame > view.to) setView(view.frame - span / 2, view.frame + span / 2);
  speak();
}

// Pointers and keys on a chart over frames.

// In the chart's own units.
function pixelUnder(event, { svg }) {
  const box = svg.getBoundingClientRect();
  return (event.clientX - box.left) * svg.viewBox.baseVal.width / box.width;
}

function frameUnder(event, chart) {
  return makeAxis(view.from, view.to, chart.x.begin, chart.x.end).invert(pixelUnder(event, chart));
}

function onWheel(event, chart) {
  const isSideways = event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY);
  const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 33 : 1;
  const delta = (isSideways ? event.deltaX || event.deltaY : event.deltaY) * unit;
  // All is shown: the page may scroll on.
  if (isAllShown() && (isSideways || delta > 0)) return;
  event.preventDefault();
  if (isSideways) pan(delta / 1000);
  else zoom(Math.exp(Math.min(Math.max(delta, -300), 300) / 400), frameUnder(event, chart));
}

const keys = {
  "ArrowLeft": (chart, isShifted) => (isShifted ? stepFrame(-1, chart) : pan(-0.15)),
  "ArrowRight": (chart, isShifted) => (isShifted ? stepFrame(1, chart) : pan(0.15)),
  "Home": () => setView(-0.5, view.to - view.from - 0.5),
  "End": () => setView(frameCount - 0.5 - (view.to - view.from), frameCount - 0.5),
  "+": () => zoom(0.6),
  "=": () => zoom(0.6),
  "-": () => zoom(1 / 0.6),
  "0": showAll,
  "Escape": (chart) => readOut(null, chart),
};

function onKey(event, chart) {
  if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in keys)) return;
  event.preventDefault();
  keys[event.key](chart, event.shiftKey);
}

// Moves the view so that the frames that were under the pointers at the start are there again.
function follow(start, now, { x }) {
  const perPixel = (start.to - start.from) / (x.end - x.begin);
  const [first, second] = [...now.keys()];
  const frame = (id) => start.from + (start.places.get(id) - x.begin) * perPixel;
  let scale = perPixel;
  if (second !== undefined) {
    const apart = now.get(second) - now.get(first);
    scale = (frame(second) - frame(first)) / (Math.abs(apart) < 10 ? 10 * Math.sign(apart || 1) : apart);
  }
  const from = frame(first) - (now.get(first) - x.begin) * scale;
  setView(from, from + scale * (x.end - x.begin));
}

function drawBrush(chart, one, other) {
  chart.svg.querySelector(".brush")?.remove();
  const left = Math.max(chart.x.begin, Math.min(one, other)), right = Math.min(chart.x.end, Math.max(one, other));
  const height = chart.bottom - chart.y.end + 6;
  add(chart.svg, "rect", { class: "brush", x: left, y: chart.y.end - 6, width: Math.max(0, right - left), height });
}

// A mouse picks a range, or moves the view with Shift; so do fingers, and two of them zoom. `chart()`: as drawn last.
function makeDrag(chart) {
  const now = new Map();  // where each pointer is [px]
  let start = null;       // where they were when the last one came or went, and the view then
  const grasp = (mode) => {
    start = now.size > 0 ? { mode, places: new Map(now), from: view.from, to: view.to } : null;
  };
  const modeOf = (event) => (event.pointerType === "mouse" && !event.shiftKey ? "pick" : "move");
  return {
    down(event) {
      if (event.button !== 0 || now.size === 2) return;
      event.currentTarget.setPointerCapture(event.pointerId);
      now.set(event.pointerId, pixelUnder(event, chart()));
      grasp(modeOf(event));
    },
    move(event) {
      if (now.has(event.pointerId)) {
        now.set(event.pointerId, pixelUnder(event, chart()));
        if (start.mode === "move") follow(start, now, chart());
        else drawBrush(chart(), start.places.get(event.pointerId), now.get(event.pointerId));
      }
      if (now.size < 2) readOut(frameUnder(event, chart()), chart());
    },
    up(event) {
      if (!now.has(event.pointerId)) return;
      const from = start.places.get(event.pointerId), to = now.get(event.pointerId);
      const isPick = start.mode === "pick" && event.type === "pointerup" && Math.abs(to - from) > 4;
      now.delete(event.pointerId);
      chart().svg.querySelector(".brush")?.remove();
      if (isPick) setView(...[from, to].sort((a, b) => a - b).map(chart().x.invert));
      grasp("move");
    },
  };
}

function listenToChart(id) {
  const svg = byId(id).querySelector(":scope > svg");
  const chart = () => charts[id];
  const drag = makeDrag(chart);
  svg.addEventListener("wheel", (event) => onWheel(event, chart()), { passive: false });
  svg.addEventListener("keydown", (event) => onKey(event, chart()));
  svg.addEventListener("dblclick", showAll);
  svg.addEventListener("pointerdown", (event) => {
    drag.down(event);
    readOut(frameUnder(event, chart()), chart());
  });
  svg.addEventListener("pointermove", drag.move);
  svg.addEventListener("pointerup", drag.up);
  svg.addEventListener("pointercancel", drag.up);
  svg.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && readOut(null, chart()));
  svg.addEventListener("blur", () => readOut(null, chart()));
}

// What stands around the charts.

function makeLegend() {
  for (const run of runs) {
    const button = addHtml(byId("legend"), "button", "", { type: "button", "aria-pressed": "true", "data-run": run.index });
    addChip(button, run);
    button.append(run.name);
    button.addEventListener("click", () => {
      run.shown = !run.shown;
      button.setAttribute("aria-pressed", run.shown);
      redraw();
    });
    button.addEventListener("pointerenter", () => standOut(run));
    button.addEventListener("pointerleave", () => standOut(null));
  }
}

function standOut(run) {
  const main = document.querySelector("main");
  if (run === null || !run.shown) delete main.dataset.lit;
  else main.dataset.lit = run.index;
  for (const group of main.querySelectorAll(".run")) group.classList.toggle("lit", Number(group.dataset.run) === run?.index);
}

function chooseScale(scale) {
  view.scale = scale;
  for (const button of byId("scale").children) button.setAttribute("aria-pressed", button.dataset.scale === scale);
  redraw();
}

// Pictures are drawn as wide as they are seen; on paper all have the width of a page.
function setPrinting(isPrinting) {
  view.printWidth = isPrinting ? 820 : null;
  drawTimeCharts();
  drawSpread();
}

function begin() {
  byId("theme").addEventListener("click", nextTheme);
  if (frameCount === 0) return;  // nothing to draw
  byId("times").hidden = byId("spread").hidden = false;
  for (const part of [byId("scatter"), document.querySelector(".key-predicted")]) part.hidden = !predicts.includes(true);
  byId("rate-words").hidden = !hasRates;
  makeLegend();
  for (const id of ["frame-chart", "distance-chart", "splat-chart"]) listenToChart(id);
  for (const button of byId("scale").children) button.addEventListener("click", () => chooseScale(button.dataset.scale));
  byId("zoom-in").addEventListener("click", () => zoom(0.6));
  byId("zoom-out").addEventListener("click", () => zoom(1 / 0.6));
  byId("zoom-reset").addEventListener("click", showAll);
  window.addEventListener("beforeprint", () => setPrinting(true));
  window.addEventListener("afterprint", () => setPrinting(false));
  drawDue();
  drawSpread();
  new ResizeObserver(redraw).observe(byId("times"));
  chooseScale(view.scale);
}

begin();
