// The report's data: series of one number a frame, as they are or thinned when the page was written.

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// Values that come several times in a row are stored once, with how often.
function unpackRepeated(Type, { values, counts }) {
  const stored = new Type(bytesOf(values).buffer);
  if (counts === "") return stored;
  const times = new Uint32Array(bytesOf(counts).buffer);
  const all = new Type(times.reduce((sum, count) => sum + count, 0));
  let at = 0;
  for (let i = 0; i < stored.length; ++i) {
    all.fill(stored[i], at, at + times[i]);
    at += times[i];
  }
  return all;
}

// Varints, one a value: 0 for none, else 1 + the zigzag of the steps from the last value.
function unpackSteps({ quantum, packed }) {
  const bytes = bytesOf(packed);
  let count = 0;
  for (const byte of bytes) count += byte < 0x80;
  const values = new Float64Array(count);
  let last = 0, code = 0, weight = 1, i = 0;
  for (const byte of bytes) {
    code += (byte & 0x7f) * weight;
    weight *= 0x80;
    if (byte >= 0x80) continue;
    if (code === 0) {
      values[i++] = NaN;
    } else {
      const change = code - 1;
      last += change % 2 === 0 ? change / 2 : -(change + 1) / 2;
      values[i++] = last * quantum;
    }
    code = 0;
    weight = 1;
  }
  return values;
}

const unpack = (stored) => (stored.packed === undefined ? unpackRepeated(Float32Array, stored) : unpackSteps(stored));

// `low` and `high` have the least and the most of each `width` frames; they are the same where nothing is thinned.
// `digits`: how many after the point were kept, up to 3.
function decodeSeries(frames, stored) {
  if (!stored) return null;
  const low = unpack(stored.low);
  const digits = stored.low.quantum >= 0.01 ? 2 : 3;
  return { frames, width: stored.width, low, high: stored.high ? unpack(stored.high) : low, digits };
}

const isExact = (series) => series.width === 1;

// Of a thinned series the middle of what is known.
function valueAt(series, frame) {
  const i = Math.floor(frame / series.width);
  return frame < series.frames ? (series.low[i] + series.high[i]) / 2 : NaN;
}

// A number, or of a thinned series from where to where it goes around this frame.
function textAt(series, frame, text) {
  if (!series || frame >= series.frames) return text(NaN);
  const i = Math.floor(frame / series.width);
  const [low, high] = [series.low[i], series.high[i]].map((value) => text(value, series.digits));
  return series.low[i] === series.high[i] || Number.isNaN(series.low[i]) ? low : `${low} to ${high}`;
}

function sameSeries(a, b) {
  return a.frames === b.frames && a.low.every((value, i) => Object.is(value, b.low[i])) &&
      a.high.every((value, i) => Object.is(value, b.high[i]));
}

const isTold = (series) => series !== null && series.low.some(Number.isFinite);

// Known values of the frames [begin, end), sorted; of a thinned series the ends of its stretches.
function sortedValues(series, begin, end) {
  const from = Math.floor(begin / series.width), to = Math.ceil(Math.min(end, series.frames) / series.width);
  const parts = isExact(series) ? [series.low] : [series.low, series.high];
  const known = parts.map((part) => part.slice(from, to).filter(Number.isFinite));
  const all = new Float64Array(known.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of known) {
    all.set(part, at);
    at += part.length;
  }
  return all.sort();
}

// Between the places of sorted values, as the numbers on the page have it (frame_times/figures.h).
function percentileOf(sorted, share) {
  const place = Math.min(Math.max((sorted.length + 1 / 3) * share + 1 / 3, 1), sorted.length), rank = Math.floor(place);
  const next = sorted[Math.min(rank, sorted.length - 1)];
  return sorted[rank - 1] + (place - rank) * (next - sorted[rank - 1]);
}

// The smallest of the sorted values that at least `share` of them do not exceed.
function ranked(sorted, share) {
  return sorted[Math.max(1, Math.ceil(share * sorted.length)) - 1];
}

const block = document.getElementById("data");
const data = JSON.parse(block.textContent);
block.remove();
