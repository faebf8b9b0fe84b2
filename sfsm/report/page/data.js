// The report's data: runs with one typed array a series.

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// Values that come several times in a row are stored once, with how often.
function decodeSeries(Type, frames, { values, counts }) {
  const stored = new Type(bytesOf(values).buffer);
  if (counts === "") return stored;
  const times = new Uint32Array(bytesOf(counts).buffer);
  const all = new Type(frames);
  let at = 0;
  for (let i = 0; i < stored.length; ++i) {
    all.fill(stored[i], at, at + times[i]);
    at += times[i];
  }
  return all;
}

function decodeRun({ name, frames, series }, index) {
  const floats = (key) => decodeSeries(Float32Array, frames, series[key]);
  const state = decodeSeries(Uint8Array, frames, series.state);
  const distance = floats("motion_distance");
  for (let i = 0; i < frames; ++i) if (state[i] === 0) distance[i] = NaN;  // D means nothing in state 0
  return {
    index, name, frames, state, distance, shown: true,
    target: floats("target_ms"), time: floats("frame_ms"), predicted: floats("predicted_ms"), splat: floats("splat_size"),
    rate: series.rate ? floats("rate") : null,  // null: D and S decided all along
  };
}

// For the shares of states in any stretch of frames: how many frames before each are in state 1, and in state 2.
function countStates(run) {
  run.before = [1, 2].map((state) => {
    const before = new Uint32Array(run.frames + 1);
    for (let i = 0; i < run.frames; ++i) before[i + 1] = before[i] + (run.state[i] === state ? 1 : 0);
    return before;
  });
}

function sameValues(a, b) {
  return a.length === b.length && a.every((value, i) => Object.is(value, b[i]));
}

// Finite times of the frames [begin, end), sorted.
function sortedTimes(run, begin, end) {
  return run.time.slice(begin, Math.min(end, run.frames)).filter(Number.isFinite).sort();
}

// The smallest of the sorted values that at least `share` of them do not exceed.
function ranked(sorted, share) {
  return sorted[Math.max(1, Math.ceil(share * sorted.length)) - 1];
}

const block = document.getElementById("data");
const runs = JSON.parse(block.textContent).runs.map(decodeRun);
block.remove();
runs.forEach(countStates);
const stateNames = ["original", "slowed", "points"];
const shownRuns = () => runs.filter((run) => run.shown);
