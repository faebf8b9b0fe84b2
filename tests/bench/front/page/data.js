// The front's data: scenes with their rows, as embedded.cpp writes them.

const block = document.getElementById("data");
const front = JSON.parse(block.textContent);
block.remove();

function decodeRow([place, family, way, setting, law, target, wall, low, high, process, errors, work,
                    share, brightness, crowdBrightness, motionWorst, outlineWorst, covering, density, samples]) {
  const [targetMs, ms, lowMs, highMs, processMs] = [target, wall, low, high, process].map(Number);
  return {
    place, family, way, setting, law, targetMs, ms, lowMs, highMs, processMs, work, samples,
    errors: errors.map(Number), share: Number(share), brightness: Number(brightness),
    crowdBrightness: Number(crowdBrightness), motionWorst: Number(motionWorst), outlineWorst: Number(outlineWorst),
    covering: Number(covering), density: Number(density),
  };
}

for (const scene of front.scenes) scene.rows = scene.rows.map(decodeRow);

const isMark = (row) => row.law !== "";
const settingText = (row) => (row.setting === "" ? row.way : `${row.way}, ${row.setting.replaceAll(" = ", "\u00a0=\u00a0")}`);
const rowName = (row) => (isMark(row) ? `${row.law} at ${px(row.targetMs)} ms: ${settingText(row)}` : settingText(row));

// How high it is in a chart: equal ratios of errors (of PSNR: differences) are equally high. -Infinity: the same picture.
const heightOf = (row, error) => (front.errors[error].isMore ? -row.errors[error] : Math.log10(Math.max(0, row.errors[error])));

const isShown = (row, error) => Number.isFinite(row.ms) && row.ms > 0 && !Number.isNaN(heightOf(row, error));

function fixed(value, digits) {
  if (Number.isNaN(value)) return "\u2013";
  if (!Number.isFinite(value)) return value > 0 ? "\u221e" : "\u2212\u221e";
  return Math.abs(value) >= 1e7 ? brief(value) : value.toFixed(digits);
}

function timeText(ms) {
  if (ms >= 1000 && ms < 1e7) return grouped(Math.round(ms));
  return fixed(ms, ms < 10 ? 2 : ms < 100 ? 1 : 0);
}

const errorText = (row, error) => fixed(row.errors[error], front.errors[error].digits);
const unitText = (unit) => (unit === "" ? "" : ` ${unit}`);
