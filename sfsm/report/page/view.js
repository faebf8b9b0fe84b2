// What part of an axis a group of charts shows, and how the reader changes it: with buttons, wheel, mouse, fingers, keys.

// Shows `all.from` to `all.to`, never less than `least`. Calls onChange() when it shows something else.
function makeView(all, least, onChange) {
  const view = {
    all, least, from: all.from, to: all.to,
    scale: "fitted",
    place: null,  // what is read out
    printWidth: null,
    // Keeps inside of all.
    set(from, to) {
      const length = view.all.to - view.all.from;
      const span = Math.min(Math.max(to - from, Math.min(view.least, length)), length);
      const middle = (from + to) / 2;
      view.from = Math.min(Math.max(middle - span / 2, view.all.from), view.all.to - span);
      view.to = view.from + span;
      onChange();
    },
    zoom(factor, around = (view.from + view.to) / 2) {
      view.set(around - (around - view.from) * factor, around + (view.to - around) * factor);
    },
    pan(share) {
      const by = share * (view.to - view.from);
      view.set(view.from + by, view.to + by);
    },
    showAll: () => view.set(view.all.from, view.all.to),
    isAll: () => view.to - view.from >= view.all.to - view.all.from,
  };
  return view;
}

// Calls draw() for the next picture, and rest() when nothing has changed for a while: a million times take a while to sort.
function makeRedraw(draw, rest) {
  let isDue = false, timer = 0;
  return () => {
    if (!isDue) {
      requestAnimationFrame(() => {
        isDue = false;
        draw();
      });
    }
    isDue = true;
    clearTimeout(timer);
    timer = setTimeout(rest, 100);
  };
}

// The layers of a chart over the view: what is drawn again on every change of the view, and what follows the pointer.
function openChart(id, height, bottom, view, drawLabels) {
  const { svg, width } = openPicture(id, height, view.printWidth);
  const x = makeAxis(view.from, view.to, 52, width - 8);
  const clip = add(svg, "clipPath", { id: id + "-clip" });
  add(clip, "rect", { x: x.begin, y: -8, width: x.end - x.begin, height: height + 8 });
  const ground = add(svg, "g");
  const layer = add(svg, "g", { "clip-path": `url(#${id}-clip)` });
  drawLabels(svg, x, bottom);
  svg.dataset.from = view.from;
  svg.dataset.to = view.to;
  return { svg, ground, layer, x, bottom, cross: add(svg, "g", { class: "cross-layer" }) };
}

const drawFrameLabels = (svg, x, bottom) =>
  drawXTicks(svg, x, bottom, linearTicks(x, Math.max(3, Math.round((x.end - x.begin) / 110))).filter(Number.isInteger), grouped);

// In the chart's own units.
function pixelUnder(event, { svg }) {
  const box = svg.getBoundingClientRect();
  return (event.clientX - box.left) * svg.viewBox.baseVal.width / box.width;
}

function placeUnder(event, chart, view) {
  return makeAxis(view.from, view.to, chart.x.begin, chart.x.end).invert(pixelUnder(event, chart));
}

function onWheel(event, chart, view) {
  const isSideways = event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY);
  const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 33 : 1;
  const delta = (isSideways ? event.deltaX || event.deltaY : event.deltaY) * unit;
  // All is shown: the page may scroll on.
  if (view.isAll() && (isSideways || delta > 0)) return;
  event.preventDefault();
  if (isSideways) view.pan(delta / 1000);
  else view.zoom(Math.exp(Math.min(Math.max(delta, -300), 300) / 400), placeUnder(event, chart, view));
}

// `reader`: readOut(place or null, chart) and step(by, chart), which goes to the next frame or the one before.
const keys = {
  "ArrowLeft": (view, reader, chart, isShifted) => (isShifted ? reader.step(-1, chart) : view.pan(-0.15)),
  "ArrowRight": (view, reader, chart, isShifted) => (isShifted ? reader.step(1, chart) : view.pan(0.15)),
  "Home": (view) => view.set(view.all.from, view.all.from + view.to - view.from),
  "End": (view) => view.set(view.all.to - (view.to - view.from), view.all.to),
  "+": (view) => view.zoom(0.6),
  "=": (view) => view.zoom(0.6),
  "-": (view) => view.zoom(1 / 0.6),
  "0": (view) => view.showAll(),
  "Escape": (view, reader, chart) => reader.readOut(null, chart),
};

function onKey(event, view, reader, chart) {
  if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in keys)) return;
  event.preventDefault();
  keys[event.key](view, reader, chart, event.shiftKey);
}

// Moves the view so that what was under the pointers at the start is there again.
function follow(start, now, { x }, view) {
  const perPixel = (start.to - start.from) / (x.end - x.begin);
  const [first, second] = [...now.keys()];
  const place = (id) => start.from + (start.places.get(id) - x.begin) * perPixel;
  let scale = perPixel;
  if (second !== undefined) {
    const apart = now.get(second) - now.get(first);
    scale = (place(second) - place(first)) / (Math.abs(apart) < 10 ? 10 * Math.sign(apart || 1) : apart);
  }
  const from = place(first) - (now.get(first) - x.begin) * scale;
  view.set(from, from + scale * (x.end - x.begin));
}

function drawBrush(chart, one, other) {
  chart.svg.querySelector(".brush")?.remove();
  const left = Math.max(chart.x.begin, Math.min(one, other)), right = Math.min(chart.x.end, Math.max(one, other));
  const height = chart.bottom - chart.y.end + 6;
  add(chart.svg, "rect", { class: "brush", x: left, y: chart.y.end - 6, width: Math.max(0, right - left), height });
}

// A mouse picks a range, or moves the view with Shift; so do fingers, and two of them zoom. `chart()`: as drawn last.
function makeDrag(chart, view, reader) {
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
        if (start.mode === "move") follow(start, now, chart(), view);
        else drawBrush(chart(), start.places.get(event.pointerId), now.get(event.pointerId));
      }
      if (now.size < 2) reader.readOut(placeUnder(event, chart(), view), chart());
    },
    up(event) {
      if (!now.has(event.pointerId)) return;
      const from = start.places.get(event.pointerId), to = now.get(event.pointerId);
      const isPick = start.mode === "pick" && event.type === "pointerup" && Math.abs(to - from) > 4;
      now.delete(event.pointerId);
      chart().svg.querySelector(".brush")?.remove();
      if (isPick) view.set(...[from, to].sort((a, b) => a - b).map(chart().x.invert));
      grasp("move");
    },
  };
}

function listenToChart(id, chart, view, reader) {
  const svg = byId(id).querySelector(":scope > svg");
  const drag = makeDrag(chart, view, reader);
  svg.addEventListener("wheel", (event) => onWheel(event, chart(), view), { passive: false });
  svg.addEventListener("keydown", (event) => onKey(event, view, reader, chart()));
  svg.addEventListener("dblclick", view.showAll);
  svg.addEventListener("pointerdown", (event) => {
    drag.down(event);
    reader.readOut(placeUnder(event, chart(), view), chart());
  });
  svg.addEventListener("pointermove", drag.move);
  svg.addEventListener("pointerup", drag.up);
  svg.addEventListener("pointercancel", drag.up);
  svg.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && reader.readOut(null, chart()));
  svg.addEventListener("blur", () => reader.readOut(null, chart()));
}

// What is read out: a table beside the place, on the side that has more room, and a sentence for those who hear the page.

const frameText = (value, digits = 3) =>
  (Number.isNaN(value) ? "\u2013" : Number.isFinite(value) ? shortFixed(value, digits) : value > 0 ? "\u221e" : "-\u221e");

function shortFixed(value, digits) {
  const size = Math.abs(value);
  return size >= 1e6 ? brief(value) : value.toFixed(Math.min(digits, size < 10 ? 3 : size < 1000 ? 2 : 1));
}

function addChip(parent, run) {
  const chip = addHtml(parent, "i", "", { class: "chip" });
  chip.style.setProperty("--run", runColour(run));
}

// `columns` are [key, title, tell(run)]. A row a run, or where that is too wide a column a run.
function fillReadout(caption, runs, columns) {
  const table = document.createElement("table");
  addHtml(table, "caption", caption);
  if (window.innerWidth < 700) fillByRun(table, runs, columns);
  else fillByColumn(table, runs, columns);
  byId("readout").replaceChildren(table);
}

function addRunHead(row, run) {
  const name = addHtml(row, "th");
  addChip(name, run);
  name.append(run.name);
}

function fillByColumn(table, runs, columns) {
  const head = addHtml(addHtml(table, "thead"), "tr");
  addHtml(head, "th");
  for (const [, title] of columns) addHtml(head, "th", title);
  const body = addHtml(table, "tbody");
  for (const run of runs) {
    const row = addHtml(body, "tr", "", { "data-run": run.index });
    addRunHead(row, run);
    for (const [key, , tell] of columns) addHtml(row, "td", tell(run), { "data-key": key });
  }
}

function fillByRun(table, runs, columns) {
  const head = addHtml(addHtml(table, "thead"), "tr");
  addHtml(head, "th");
  for (const run of runs) addRunHead(head, run);
  const body = addHtml(table, "tbody");
  for (const [key, title, tell] of columns) {
    const row = addHtml(body, "tr");
    addHtml(row, "th", title);
    for (const run of runs) addHtml(row, "td", tell(run), { "data-key": key, "data-run": run.index });
  }
}

function placeReadout(chart, at) {
  const readout = byId("readout");
  const box = chart.svg.getBoundingClientRect();
  const place = box.left + chart.x.at(at) * box.width / chart.svg.viewBox.baseVal.width;
  const { width, height } = readout.getBoundingClientRect();
  const left = place + 16 + width < window.innerWidth ? place + 16 : place - 16 - width;
  readout.style.left = `${Math.max(4, left)}px`;
  readout.style.top = `${Math.max(4, Math.min(box.top + 6, window.innerHeight - height - 4))}px`;
}

function speak(caption, runs, columns) {
  const sentences = runs.map((run) => `${run.name}: ${columns.map(([, title, tell]) => `${title} ${tell(run)}`).join(", ")}`);
  byId("spoken").textContent = `${caption}. ${sentences.join(". ")}`;
}

// The line through all charts at what is read out, and a dot on each curve: `dots` are {run, value}.
function drawCross({ cross, x, y, bottom }, view, at, dots) {
  cross.replaceChildren();
  if (at === null || at < view.from || at > view.to) return;
  const place = px(x.at(at));
  add(cross, "path", { class: "cross", d: `M${place} ${y.end - 6}V${bottom}` });
  for (const { run, value } of dots) {
    if (!Number.isNaN(value)) add(addRun(cross, run), "circle", { class: "dot", cx: place, cy: px(y.at(value)), r: 4 });
  }
}

// What stands around the charts.

function makeLegend(id, runs, redraw) {
  for (const run of runs) {
    const button = addHtml(byId(id), "button", "", { type: "button", "aria-pressed": run.shown, "data-run": run.index });
    addChip(button, run);
    button.append(run.name);
    button.addEventListener("click", () => {
      run.shown = !run.shown;
      button.setAttribute("aria-pressed", run.shown);
      redraw();
    });
    button.addEventListener("pointerenter", () => standOut(button.closest(".part"), run));
    button.addEventListener("pointerleave", () => standOut(button.closest(".part"), null));
  }
}

// Among what the part of the page shows.
function standOut(part, run) {
  if (run === null || !run.shown) delete part.dataset.lit;
  else part.dataset.lit = run.index;
  for (const group of part.querySelectorAll(".run")) group.classList.toggle("lit", Number(group.dataset.run) === run?.index);
}

// Buttons of which one holds: its data-`key` is given to choose().
function makeChoice(id, key, chosen, choose) {
  const press = (value) => {
    for (const button of byId(id).children) button.setAttribute("aria-pressed", button.dataset[key] === value);
    choose(value);
  };
  for (const button of byId(id).children) button.addEventListener("click", () => press(button.dataset[key]));
  press(chosen);
}

function listenToZoom(prefix, view) {
  byId(prefix + "zoom-in").addEventListener("click", () => view.zoom(0.6));
  byId(prefix + "zoom-out").addEventListener("click", () => view.zoom(1 / 0.6));
  byId(prefix + "zoom-reset").addEventListener("click", view.showAll);
}
