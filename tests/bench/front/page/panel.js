// All that is known of one setting, beside the chart.

function addFacts(parent, title, facts) {
  const shown = facts.filter(([, text]) => text !== "");
  if (shown.length === 0) return;
  addHtml(parent, "h4", title);
  const list = addHtml(parent, "dl");
  for (const [name, text] of shown) {
    const pair = addHtml(list, "div");
    addHtml(pair, "dt", name);
    addHtml(pair, "dd", text);
  }
}

const signedShare = (value) => `${value > 0 ? "+" : ""}${fixed(100 * value, 1)} %`.replace("-", "\u2212");

function errorFacts(row) {
  const facts = front.errors.map(({ name, unit }, error) => [name, errorText(row, error) + unitText(unit)]);
  return [
    ...facts,
    ["Motion, worst", `${fixed(row.motionWorst, 2)} px`],
    ["Outline, worst", `${fixed(row.outlineWorst, 2)} px`],
    ["Light", signedShare(row.brightness)],
    ["Crowd\u2019s light", signedShare(row.crowdBrightness)],
  ];
}

function drawnFacts(row) {
  const counts = front.work.map((name, kind) => [name, row.work[kind] === 0 ? "" : grouped(row.work[kind])]);
  return [
    ...counts,
    ["points a splat-sized square", row.density > 0 ? brief(row.density) : ""],
    ["covering radius of points", row.covering > 0 ? `${fixed(row.covering, 2)} px` : ""],
    ["samples a pixel", row.samples > 0 ? String(row.samples) : ""],
  ];
}

function addCrop(parent, address, caption) {
  const crop = addHtml(parent, "figure", "", { class: "crop" });
  addHtml(crop, "img", "", { src: address, alt: caption });
  addHtml(crop, "figcaption", caption);
}

function addCrops(panel, scene, row) {
  const address = front.crops[row.place], reference = front.references[front.scenes.indexOf(scene)];
  if (address === undefined) return;
  const pair = addHtml(panel, "div", "", { class: "crops" });
  addCrop(pair, address, "this setting");
  if (reference !== null) addCrop(pair, reference, "the reference");
}

function fillPanel(panel, scene, row) {
  panel.replaceChildren();
  panel.dataset.row = row.place;
  const title = addHtml(panel, "h3", settingText(row), { class: `family-${row.family % 12}` });
  if (!isMark(row)) title.prepend(addHtml(title, "i", "", { class: "chip" }));
  if (isMark(row)) addHtml(panel, "p", `chosen by ${row.law} at a target of ${px(row.targetMs)} ms`, { class: "law" });
  const time = addHtml(panel, "p", "", { class: "time" });
  addHtml(time, "b", `${timeText(row.ms)} ms`);
  time.append(` (quartiles ${timeText(row.lowMs)} to ${timeText(row.highMs)})`);
  if (row.processMs > 0) time.append(`; all threads together ${timeText(row.processMs)}`);
  addCrops(panel, scene, row);
  addFacts(panel, "Error", errorFacts(row));
  addFacts(panel, "Drawn", drawnFacts(row));
}

function spokenRow(row, error) {
  const { name, unit } = front.errors[error];
  return `${rowName(row)}: ${timeText(row.ms)} milliseconds, ${name} ${errorText(row, error)}${unitText(unit)}`;
}
