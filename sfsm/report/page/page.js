// Starts the page's parts that have something to draw.

function begin() {
  byId("theme").addEventListener("click", nextTheme);
  const parts = [];
  const show = (ids) => ids.forEach((id) => byId(id).hidden = false);
  if (recordings.some((run) => run.frames > 0)) {
    show(["recorded", "recorded-spread"]);
    parts.push(startRecordings());
  }
  if (byId("times") && data.runs.some((run) => run.frames > 0)) {
    show(["times", "spread"]);
    parts.push(startLaws());
  }
  // Pictures are drawn as wide as they are seen; on paper all have the width of a page, and nothing is folded.
  const folded = [...document.querySelectorAll("details")].filter((details) => !details.open);
  const print = (width) => {
    for (const details of folded) details.open = width !== null;
    for (const part of parts) {
      part.view.printWidth = width;
      part.draw();
      part.drawSpread();
    }
  };
  window.addEventListener("beforeprint", () => print(820));
  window.addEventListener("afterprint", () => print(null));
  for (const part of parts) {
    part.draw();
    part.drawSpread();
    new ResizeObserver(part.redraw).observe(byId(part.section));
  }
}

begin();
