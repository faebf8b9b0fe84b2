// The charts of recordings. `part` is what they share: shown() the recordings in sight, placesOf(run) where its frames
// lie, view, charts (by id, as drawn last), drawLabels.

function drawRecordedTimes(part) {
  const plot = part.view.printWidth ? 250 : window.innerWidth < 700 ? 230 : 360;
  const marks = part.shown().some((run) => run.stutters.length > 0) ? 14 * part.shown().length + 4 : 0;
  const chart = part.charts["recorded-times"] = openChart("recorded-times", plot + marks + 22, plot + marks, part.view, part.drawLabels);
  const { x } = chart;
  const curves = part.shown().map((run) => ({ run, places: part.placesOf(run), times: thin(run.time, part.placesOf(run), x) }));
  const target = data.target_ms === null ? [] : [{ low: data.target_ms, high: data.target_ms }];
  const sample = () => sortedSample(curves.map(({ run, places }) => sampleInView(run.time, places, x)));
  const y = chart.y = timesAxis(part.view.scale, curves.flatMap(({ times }) => times), target, sample, plot, 14);
  drawYAxis(chart.ground, x, y, 6);
  for (const { low } of target) add(chart.layer, "path", { class: "target", d: `M${x.begin} ${px(y.at(low))}H${x.end}` });
  curves.forEach(({ run, places, times }, i) => {
    const group = addRun(chart.layer, run);
    drawExtent(part, group, chart, run, run.time, places, times);
    drawCarets(group, chart, y, times, places);
    if (marks > 0) drawStutters(chart, run, places, plot + 14 + 14 * i);
  });
}

// Of many frames an area as pale as glass and the means as a line, or one recording would hide another.
function drawExtent(part, group, chart, run, series, places, buckets) {
  const { x, y } = chart;
  const areThin = isThinned(places, run.frames, x);
  const isAlone = part.shown().length === 1;
  add(group, "path", { class: `curve ${areThin ? isAlone ? "extent alone" : "extent" : "measured"}`, d: curvePath(buckets, places, x, y, false) });
  if (areThin) add(group, "path", { class: "curve measured", d: curvePath(meanBuckets(series, buckets), places, x, y, false) });
}

// A mark below each stutter, of those that share a place one; with its cause where there is room for the word.
function drawStutters(chart, run, places, bottom) {
  const marks = [];
  run.stutters.forEach((frame, i) => {
    const place = (along(chart.x, places.begins(frame)) + along(chart.x, places.begins(frame + 1))) / 2;
    const isInView = place > chart.x.begin - 5 && place < chart.x.end + 5;
    if (isInView && place - (marks.at(-1)?.place ?? -Infinity) >= 4) marks.push({ place, cause: shortCause(data.causes[run.causes[i]]) });
  });
  if (marks.length === 0) return;
  const group = addRun(chart.layer, run);
  add(group, "path", { class: "stutter-mark", d: marks.map(({ place }) => `M${px(place - 4)} ${bottom}l4 -9l4 9z`).join("") });
  marks.forEach(({ place, cause }, i) => {
    const room = (marks[i + 1]?.place ?? chart.x.end) - place - 14;
    if (cause && room > 7 * cause.length) add(group, "text", { x: px(place + 7), y: bottom }, cause);
  });
}

function drawSeries(part, id, key, isSigned) {
  if (byId(id).hidden) return;
  const plot = 130;
  const chart = part.charts[id] = openChart(id, plot + 22, plot, part.view, part.drawLabels);
  const { x } = chart;
  const told = part.shown().filter((run) => run[key]);
  // From shown frame to shown frame: those that were never shown are no gap in what is seen.
  const known = (buckets) => buckets.filter(({ low, high }) => low <= high);
  const curves = told.map((run) => ({ run, places: part.placesOf(run), values: known(thin(run[key], part.placesOf(run), x)) }));
  const buckets = curves.flatMap(({ values }) => values);
  const y = chart.y = isSigned ? signedAxis(buckets, plot)
      : timesAxis("fitted", buckets, [], () => sortedSample(told.map((run) => sampleInView(run[key], part.placesOf(run), x))), plot, 8);
  drawYAxis(chart.ground, x, y, 4);
  for (const { run, places, values } of curves) {
    const group = addRun(chart.layer, run);
    drawExtent(part, group, chart, run, run[key], places, values);
    if (!isSigned) drawCarets(group, chart, y, values, places);
  }
}

// As far down as up, so that 0 is in the middle.
function signedAxis(buckets, plot) {
  const far = buckets.reduce((most, { low, high }) => (low <= high ? Math.max(most, -low, high) : most), 0) || 1;
  return makeAxis(-1.05 * far, 1.05 * far, plot, 8);
}

// What was always busy as an area, what was so at times lighter above it, and the frame time as a line over both.
function drawBusy(part, run) {
  const id = `recorded-busy-${run.index}`;
  if (!byId(id)) return;
  byId(id).hidden = !run.shown;
  if (!run.shown) return;
  const plot = 150, places = part.placesOf(run);
  const chart = part.charts[id] = openChart(id, plot + 22, plot, part.view, part.drawLabels);
  const { x } = chart;
  const times = thin(run.time, places, x);
  // The greater first, or it would hide the other.
  const sum = (buckets) => buckets.reduce((all, { low, high }) => (low <= high ? all + low : all), 0);
  const parts = ["gpu", "cpu"].filter((key) => run[key]).map((key) => ({ key, values: thin(run[key], places, x) }))
      .sort((a, b) => sum(b.values) - sum(a.values));
  const sample = () => sortedSample([sampleInView(run.time, places, x)]);
  const y = chart.y = timesAxis("fitted", [...times, ...parts.flatMap(({ values }) => values)], [], sample, plot, 8);
  chart.y = makeAxis(0, y.high, plot, 8);
  drawYAxis(chart.ground, x, chart.y, 4);
  for (const { key, values } of parts) {
    add(chart.layer, "path", { class: `busy busy-${key} at-times`, d: areaPath(values, places, x, chart.y, "high") });
    add(chart.layer, "path", { class: `busy busy-${key}`, d: areaPath(values, places, x, chart.y, "low") });
  }
  add(addRun(chart.layer, run), "path", { class: "curve measured", d: curvePath(meanBuckets(run.time, times), places, x, chart.y, false) });
}
