// A scene's chart: time to the right, error upwards, both logarithmic. chart.cpp is its twin.

const smallLook = { width: 220, height: 132, left: 30, right: 8, top: 8, bottom: 18, point: 1.6, mark: 3, ticks: 2 };
const largeLook = (width, isPrinting) => ({
  width, height: width < 600 || isPrinting ? 330 : 440, left: 54, right: 14, top: 22, bottom: 40,
  point: 4, mark: 6.5, ticks: 6, isLarge: true,
});

// What charts that are compared have in common.
function rangeOf(scenes, error) {
  const rows = scenes.flatMap((scene) => scene.rows).filter((row) => isShown(row, error));
  const targets = rows.map((row) => row.targetMs).filter((ms) => ms > 0 && Number.isFinite(ms));
  const times = [front.frameMs, ...targets, ...rows.map((row) => row.ms)];
  const { isMore } = front.errors[error];
  const heights = rows.map((row) => heightOf(row, error)).filter((height) => height !== Infinity);
  const finite = heights.filter(Number.isFinite);
  const most = finite.length === 0 ? 0 : Math.max(...finite);
  const mostDecades = isMore ? Infinity : 3;  // what is better than that is at the bottom
  const least = finite.length === 0 ? 0 : Math.max(Math.min(...finite), most - mostDecades);
  return {
    fast: Math.min(...times), slow: Math.max(...times), least: Math.min(least, most - (isMore ? 1 : 0.1)), most,
    hasExact: heights.includes(-Infinity),
  };
}

function plotOf(look, range, error) {
  const margin = 0.04 * (range.most - range.least);
  const exact = range.hasExact ? 3 * margin : 0;
  return {
    look, range, error,
    x: makeAxis(range.fast / 1.12, range.slow * 1.12, look.left, look.width - look.right, true),
    y: makeAxis(range.least - margin - exact, range.most + margin, look.height - look.bottom, look.top),
  };
}

const isPower = (value) => Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-6;

// 1, 2 and 5 of each decade of an axis of log10, or powers of ten alone.
function logTicksOf(axis, onlyPowers) {
  const values = logTicks({ low: 10 ** axis.low, high: 10 ** axis.high }, 12);
  return onlyPowers ? values.filter(isPower) : values;
}

function drawErrors(svg, { look, range, error, x, y }) {
  const isLog = !front.errors[error].isMore;
  for (const tick of isLog ? logTicksOf(y, !look.isLarge) : linearTicks(y, look.ticks)) {
    const height = isLog ? Math.log10(tick) : tick;
    if (range.hasExact && height < range.least) continue;  // what is exact has a label of its own
    const place = px(y.at(height));
    add(svg, "path", { class: "grid", d: `M${x.begin} ${place}H${x.end}` });
    add(svg, "text", { x: x.begin - 6, y: Number(place) + 4, "text-anchor": "end" }, brief(isLog ? tick : -tick));
  }
  if (range.hasExact) add(svg, "text", { x: x.begin - 6, y: y.begin, "text-anchor": "end" }, look.isLarge ? "exact" : "=");
}

function drawTimes(svg, { look, error, x, y }) {
  const ticks = logTicks(x, 12);
  for (const tick of look.isLarge && look.width > 600 ? ticks : ticks.filter(isPower)) {
    add(svg, "path", { class: "axis", d: `M${px(x.at(tick))} ${y.begin}v4` });
    add(svg, "text", { x: px(x.at(tick)), y: y.begin + 15, "text-anchor": "middle" }, brief(tick));
  }
  const place = px(x.at(front.frameMs));
  add(svg, "path", { class: "frame", d: `M${place} ${y.end}V${y.begin}` });
  if (!look.isLarge) return;
  add(svg, "text", { class: "strong", x: place, y: y.end - 7, "text-anchor": "middle" }, `${front.frameMs} ms`);
  add(svg, "text", { x: x.end, y: look.height - 4, "text-anchor": "end" }, "time of a frame [ms] \u2192");
  const { name, unit, isMore } = front.errors[error];
  add(svg, "text", { class: "strong", x: 2, y: 10 }, `${name}${unit ? ` [${unit}]` : ""}${isMore ? ", downwards" : ""}`);
}

// The best error so far for every time: down at each point of the front, then on to the next.
function frontPath(scene, { error, x, y }) {
  let path = "";
  for (const index of scene.fronts[error]) {
    const row = scene.rows[index];
    path += (path === "" ? `M${px(x.at(row.ms))} ${y.end}` : `H${px(x.at(row.ms))}`) + `V${px(y.at(heightOf(row, error)))}`;
  }
  return path === "" ? "" : `${path}H${x.end}`;
}

// Where a row is [px of the chart], and its quartiles.
function placeOf(row, { error, x, y }) {
  return { row, x: x.at(row.ms), y: y.at(heightOf(row, error)), low: x.at(row.lowMs), high: x.at(row.highMs) };
}

function drawFamilies(svg, scene, plot, places) {
  const { look, error, x, y } = plot;
  front.families.forEach((name, family) => {
    const rows = scene.rows.filter((row) => row.family === family && !isMark(row) && isShown(row, error)).sort((a, b) => a.ms - b.ms);
    if (rows.length === 0) return;
    const group = add(svg, "g", { class: `family family-${family % 12}` });
    const at = rows.map((row) => [px(x.at(row.ms)), px(y.at(heightOf(row, error)))]);
    add(group, "path", { class: "curve", d: at.map(([left, top], i) => `${i === 0 ? "M" : "L"}${left} ${top}`).join("") });
    rows.forEach((row, i) => {
      add(group, "circle", { class: "point", "data-row": row.place, cx: at[i][0], cy: at[i][1], r: look.point });
      places.push(placeOf(row, plot));
    });
  });
}

function markPath(law, r) {
  const half = 0.9 * r, side = 1.8 * r;
  if (law === "predictive") return `M0 -${r}L${r} 0L0 ${r}L-${r} 0Z`;
  if (law === "safeguarded") return `M-${half} -${half}h${side}v${side}h-${side}Z`;
  if (law === "paper") return `M0 -${r}L${r} ${half}L-${r} ${half}Z`;
  return `M-${half} -${half}l${side} ${side}m0 -${side}l-${side} ${side}`;
}

function lawClass(law) {
  return ["predictive", "safeguarded", "paper"].includes(law) ? law : "other";
}

// A thin line leads from a mark to the target that it was given.
function drawMarks(svg, scene, plot, places) {
  const { look, error, x, y } = plot;
  for (const row of scene.rows.filter((shown) => isMark(shown) && isShown(shown, error))) {
    const left = x.at(row.ms), top = y.at(heightOf(row, error));
    if (look.isLarge && row.targetMs > 0) {
      add(svg, "path", { class: "tether", d: `M${px(left)} ${px(top)}H${px(x.at(row.targetMs))}m0 -4v8` });
    }
    add(svg, "path", {
      class: `mark law-${lawClass(row.law)}`, "data-row": row.place, d: markPath(row.law, look.mark),
      transform: `translate(${px(left)} ${px(top)})`,
    });
    places.push(placeOf(row, plot));
  }
}

// Into an emptied svg. Returns where each row is [px of the chart].
function drawChart(svg, scene, error, range, look) {
  const plot = plotOf(look, range, error);
  const places = [];
  svg.setAttribute("viewBox", `0 0 ${look.width} ${look.height}`);
  svg.setAttribute("aria-label", `${scene.name}: time against ${front.errors[error].name}`);
  svg.replaceChildren();
  drawErrors(svg, plot);
  drawTimes(svg, plot);
  const steps = frontPath(scene, plot);
  const { x, y } = plot;
  if (steps) add(svg, "path", { class: "under", d: `${steps}V${y.begin}H${x.begin}V${y.end}Z` });
  if (steps) add(svg, "path", { class: "front", d: steps });
  drawFamilies(svg, scene, plot, places);
  drawMarks(svg, scene, plot, places);
  return places.sort((a, b) => a.row.ms - b.row.ms);
}
