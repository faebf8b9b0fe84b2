// What the reader does: choose crowd, view and error, and look at settings.

const view = { scene: 0, error: 0, places: [], shown: null, pinned: null, printWidth: null };
const scene = () => front.scenes[view.scene];
const chart = () => byId("chart").querySelector(":scope > svg");

// The front's setting for a frame: what is shown until the reader points at another.
function firstChoice() {
  const rows = scene().fronts[view.error].map((index) => scene().rows[index]);
  return rows.filter((row) => row.ms <= front.frameMs).pop() ?? rows[0] ?? scene().rows[0];
}

function drawLarge() {
  const width = view.printWidth ?? Math.max(byId("chart").clientWidth, 240);
  view.places = drawChart(chart(), scene(), view.error, rangeOf([scene()], view.error), largeLook(width, view.printWidth !== null));
  drawRing();
}

// Around the setting that is shown, with its quartiles.
function drawRing() {
  chart().querySelector(".ring")?.remove();
  const place = view.places.find(({ row }) => row === view.shown);
  if (place === undefined) return;
  const ring = add(chart(), "g", { class: "ring" });
  const y = px(place.y);
  if (place.low < place.high) add(ring, "path", { d: `M${px(place.low)} ${y}H${px(place.high)}m0 -5v10M${px(place.low)} ${y}m0 -5v10` });
  add(ring, "circle", { cx: px(place.x), cy: y, r: 10 });
}

function show(row) {
  view.shown = row;
  byId("panel").hidden = row === undefined;
  if (row !== undefined) fillPanel(byId("panel"), scene(), row);
  drawRing();
}

function pin(row) {
  view.pinned = row;
  show(row);
}

function drawSmall() {
  for (const crowd of document.querySelectorAll(".crowd")) {
    const views = [...crowd.querySelectorAll(".view")];
    const range = rangeOf(views.map((button) => front.scenes[button.dataset.scene]), view.error);
    for (const button of views) {
      drawChart(button.querySelector("svg"), front.scenes[button.dataset.scene], view.error, range, smallLook);
    }
  }
}

function fillSentence(id, [before, key, after]) {
  byId(id).textContent = before;
  addHtml(byId(id), "b", key);
  byId(id).append(after);
}

function fillAnswers() {
  fillSentence("draw", scene().draw[view.error]);
  fillSentence("buys", scene().buys[view.error]);
  const { sentence, scene: where, row } = front.loses[view.error];
  fillSentence("loses", sentence);
  if (where === null) return;
  const button = addHtml(byId("loses"), "button", "Show it", { type: "button", class: "control inline" });
  button.addEventListener("click", () => {
    chooseScene(where);
    pin(scene().rows[row]);
    byId("chart").scrollIntoView({ block: "center" });
  });
  button.before(" ");
}

function pressOnly(buttons, isChosen) {
  for (const button of buttons) button.setAttribute("aria-pressed", isChosen(button));
}

function chooseScene(index) {
  view.scene = index;
  const people = String(scene().people);
  for (const crowd of document.querySelectorAll(".crowd")) crowd.hidden = crowd.dataset.people !== people;
  pressOnly(byId("crowds").children, (button) => button.dataset.people === people);
  pressOnly(document.querySelectorAll(".view"), (button) => Number(button.dataset.scene) === index);
  byId("scene").textContent = scene().name;
  fillAnswers();
  fillTable(byId("table"), scene(), view.error);
  pin(firstChoice());
  drawLarge();
}

// The same view of another crowd, where it was measured.
function chooseCrowd(people) {
  const there = front.scenes.map((_, index) => index).filter((index) => front.scenes[index].people === people);
  chooseScene(there.find((index) => front.scenes[index].view === scene().view) ?? there[0]);
}

function chooseError(id) {
  view.error = front.errors.findIndex((error) => error.id === id);
  pressOnly(byId("errors").children, (button) => button.dataset.error === id);
  const { name, meaning } = front.errors[view.error];
  byId("meaning").textContent = `${name}: ${meaning}`;
  const { scene: index } = view, pinned = view.pinned;
  drawSmall();
  chooseScene(index);
  if (pinned !== null) pin(pinned);
}

// Pointers and keys on the large chart.

function rowUnder(event) {
  const box = chart().getBoundingClientRect(), scale = chart().viewBox.baseVal.width / box.width;
  const x = (event.clientX - box.left) * scale, y = (event.clientY - box.top) * scale;
  let nearest = null, least = 40 ** 2;
  for (const place of view.places) {
    const away = (place.x - x) ** 2 + (place.y - y) ** 2;
    if (away < least) [nearest, least] = [place.row, away];
  }
  return nearest;
}

function step(by, onFront) {
  const index = new Set(scene().fronts[view.error].map((i) => scene().rows[i]));
  const rows = view.places.map(({ row }) => row).filter((row) => !onFront || index.has(row));
  if (rows.length === 0) return;
  const after = rows.findIndex((row) => row.ms >= view.shown.ms);
  const found = rows.indexOf(view.shown);
  const from = found >= 0 ? found : after - (by > 0 ? 1 : 0);
  pin(rows[Math.min(Math.max(from + by, 0), rows.length - 1)]);
  byId("spoken").textContent = spokenRow(view.shown, view.error);
}

const keys = {
  ArrowLeft: (event) => step(-1, event.shiftKey),
  ArrowRight: (event) => step(1, event.shiftKey),
  Home: (event) => step(-Infinity, event.shiftKey),
  End: (event) => step(Infinity, event.shiftKey),
  Escape: () => pin(firstChoice()),
};

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in keys)) return;
  event.preventDefault();
  keys[event.key](event);
}

function listenToChart() {
  const svg = chart();
  svg.setAttribute("tabindex", "0");
  svg.setAttribute("role", "application");
  svg.setAttribute("aria-describedby", "keys");
  svg.addEventListener("pointermove", (event) => show(rowUnder(event) ?? view.pinned));
  svg.addEventListener("pointerdown", (event) => pin(rowUnder(event) ?? view.pinned));
  svg.addEventListener("pointerleave", () => show(view.pinned));
  svg.addEventListener("keydown", onKey);
}

function setPrinting(isPrinting) {
  view.printWidth = isPrinting ? 700 : null;
  drawLarge();
}

function begin() {
  byId("theme").hidden = false;
  byId("theme").addEventListener("click", nextTheme);
  if (front.scenes.length === 0) return;
  document.documentElement.classList.add("scripted");
  for (const part of [document.querySelector(".toolbar"), byId("keys"), byId("table")]) part.hidden = false;
  listenToChart();
  for (const button of byId("crowds").children) button.addEventListener("click", () => chooseCrowd(Number(button.dataset.people)));
  for (const button of byId("errors").children) button.addEventListener("click", () => chooseError(button.dataset.error));
  for (const button of document.querySelectorAll(".view")) {
    button.addEventListener("click", () => chooseScene(Number(button.dataset.scene)));
  }
  window.addEventListener("beforeprint", () => setPrinting(true));
  window.addEventListener("afterprint", () => setPrinting(false));
  chooseError(front.errors[0].id);
  new ResizeObserver(drawLarge).observe(byId("chart"));
}

begin();
