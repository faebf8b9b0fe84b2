// The front's points and the laws' choices as a table. tables.cpp is its twin.

function addRow(body, row, kind) {
  const line = addHtml(body, "tr", "", kind);
  addHtml(line, "th", rowName(row), { scope: "row" });
  addHtml(line, "td", timeText(row.ms));
  addHtml(line, "td", `${timeText(row.lowMs)}\u2013${timeText(row.highMs)}`);
  front.errors.forEach((_, error) => addHtml(line, "td", errorText(row, error)));
}

function fillTable(place, scene, error) {
  const table = document.createElement("table");
  const head = addHtml(addHtml(table, "thead"), "tr");
  const addHead = (name, unit) => {
    const cell = addHtml(head, "th", name, { scope: "col" });
    if (unit) addHtml(cell, "small", ` ${unit}`);
    return cell;
  };
  addHead("The front, fast to slow");
  addHead("Time", "ms");
  addHead("Quartiles");
  front.errors.forEach(({ name, unit }, i) => addHead(name, unit).classList.toggle("chosen", i === error));
  const settings = addHtml(table, "tbody");
  for (const index of scene.fronts[error]) addRow(settings, scene.rows[index], {});
  const laws = addHtml(table, "tbody");
  for (const row of scene.rows.filter(isMark)) addRow(laws, row, { class: "of-law" });
  place.replaceChildren(table);
}
