// The recording: decoded once, then read by time.

/** Decodes base64 of little-endian 32-bit words. */
function decodeWords(text, Words) {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  return new Words(bytes.buffer);
}

const recording = (() => {
  const data = JSON.parse(document.getElementById("recording").textContent);
  data.poses = decodeWords(data.poses, Float32Array);
  data.contact_numbers = decodeWords(data.contact_numbers, Float32Array);
  data.contact_pairs = decodeWords(data.contact_pairs, Uint32Array);
  data.contact_starts = decodeWords(data.contact_starts, Uint32Array);
  for (const name of ["kinetic", "potential", "total", "deepest_overlap", "contacts"]) {
    data.audit[name] = decodeWords(data.audit[name], Float32Array);
  }
  return data;
})();
if (recording.stage) {
  for (const mesh of recording.stage.meshes) {
    mesh.corners = decodeWords(mesh.corners, Float32Array);
    mesh.triangles = decodeWords(mesh.triangles, Uint32Array);
  }
}
const firstTime = recording.times[0] ?? 0;
const lastTime = recording.times.at(-1) ?? 0;

/** Index of the last entry that is not later than `time`; 0 before the first. */
function indexAt(times, time) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time) low = middle; else high = middle - 1;
  }
  return low;
}

/** Numbers of a contact: point, impulse on b, normal impulse. */
const contactLength = 2 * recording.origin.length + 1;

/** Contacts of a sample: point, force on b, indices of a and b. */
function contactsOf(sample) {
  const { contact_numbers: numbers, contact_pairs: pairs, contact_starts: starts, origin, dt } = recording;
  const axes = origin.length, contacts = [];
  for (let i = starts[sample]; i < starts[sample + 1]; i++) {
    const row = numbers.subarray(contactLength * i, contactLength * (i + 1));
    contacts.push({
      point: origin.map((middle, axis) => middle + row[axis]),
      force: origin.map((_, axis) => row[axes + axis] / dt),
      a: pairs[2 * i], b: pairs[2 * i + 1],
    });
  }
  return contacts;
}

/** Sum of the normal impulses of a sample. */
function normalImpulse(sample) {
  let sum = 0;
  for (let i = recording.contact_starts[sample]; i < recording.contact_starts[sample + 1]; i++) {
    sum += recording.contact_numbers[contactLength * (i + 1) - 1];
  }
  return sum;
}

/** The force below which half of all impulse is given: many tiny ones count little, and one great one not for all. */
function typicalForce() {
  const { contact_numbers: numbers, origin, dt } = recording;
  const count = numbers.length / contactLength, stride = Math.max(1, Math.floor(count / 20000));
  const forces = [];
  for (let i = 0; i < count; i += stride) {
    const start = contactLength * i + origin.length;
    const force = Math.hypot(...numbers.subarray(start, start + origin.length)) / dt;
    if (force > 0 && isFinite(force)) forces.push(force);
  }
  forces.sort((a, b) => a - b);
  let rest = forces.reduce((sum, force) => sum + force, 0) / 2;
  return forces.find((force) => (rest -= force) <= 0) ?? 1;
}

/** The nearest of 1, 2, 5 times a power of ten that is not above `value`. */
function niceBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * (value >= 5 * power ? 5 : value >= 2 * power ? 2 : 1);
}

/** A number in a few digits, with a true minus sign. */
function show(value, digits = 4) {
  if (value === undefined || value === null || Number.isNaN(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e6 || size < 1e-4 ? value.toExponential(digits - 1) : String(Number(value.toPrecision(digits)));
  return text.replace(/-/g, "−");
}

/** A colour of the style sheet; remembered, because asking the browser is slow. */
function color(name) {
  if (!colors.has(name)) colors.set(name, getComputedStyle(document.documentElement).getPropertyValue(name).trim());
  return colors.get(name);
}
const colors = new Map();

/** Makes a canvas as fine as the screen; returns its context, in CSS pixels, and its size. */
function sharpCanvas(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}
