// Time, controls, and what the reader sees beside the picture.

const element = (id) => document.getElementById(id);
const view = new View(element("view"));
const energyPlot = new EnergyPlot(element("energy"));
const ICONS = { play: "M4 2.5v11l9-5.5z", pause: "M3.5 2.5h3.5v11H3.5zM9 2.5h3.5v11H9z" };
const player = { time: firstTime, playing: false, speed: 1, contactSample: 0, lastFrame: 0, scheduled: false };

/** Adds rows of a term and its value to a description list; returns the value elements. */
function describe(list, rows) {
  return rows.map(([term, value]) => {
    const row = document.createElement("div");
    const [name, content] = [document.createElement("dt"), document.createElement("dd")];
    name.textContent = term;
    content.textContent = value;
    row.append(name, content);
    list.append(row);
    return content;
  });
}

const count = (number) => number.toLocaleString("en").replace(/,/g, "\u2009");
document.title = `${recording.scene} – replay`;
element("scene-name").textContent = recording.scene;
element("about").textContent = recording.about;
describe(element("facts"), [
  ["contact model", recording.contact || "–"],
  ["step dt", `${show(recording.dt)} s`],
  ["bodies", count(recording.bodies.length)],
  ["samples", count(recording.recorded_samples)],
]);
const readout = describe(element("readout"),
  ["time", "step", "kinetic", "potential", "total", "contact points", "deepest overlap"].map((term) => [term, ""]));
if (recording.times.length < recording.recorded_samples) {
  element("notice").hidden = false;
  element("notice").textContent =
    `To keep this file small it shows ${count(recording.times.length)} of ${count(recording.recorded_samples)} samples; the tables have all of them.`;
}

if (view.help) element("drag-help").textContent = view.help;
element("springs-choice").hidden = recording.springs.length === 0;
element("joints-choice").hidden = recording.joints.length === 0;

/** Goes to a time; contacts are those of the sample there, or of the strongest one passed on the way. */
function goTo(time, { passing = false } = {}) {
  const earlier = indexAt(recording.times, player.time);
  player.time = Math.min(Math.max(time, firstTime), lastTime);
  // A step in the URL or a sum of frames may miss a sample by a rounding error.
  const sample = indexAt(recording.times, player.time + 1e-9 * (lastTime - firstTime));
  player.contactSample = sample;
  if (passing) {
    let strongest = normalImpulse(sample);
    for (let passed = sample - 1; passed > earlier; passed--) {
      const impulse = normalImpulse(passed);
      if (impulse > strongest) { strongest = impulse; player.contactSample = passed; }
    }
  }
  redraw();
}

/** Goes to the sample that many samples on. */
function stepBy(samples) {
  pause();
  const here = indexAt(recording.times, player.time + 1e-9 * (lastTime - firstTime));
  const between = player.time - recording.times[here] > 1e-6 * recording.dt;
  const target = here + samples + (samples < 0 && between ? 1 : 0);
  goTo(recording.times[Math.min(Math.max(target, 0), recording.times.length - 1)] ?? 0);
}

function play() {
  if (player.time >= lastTime) goTo(firstTime);
  player.playing = true;
  player.lastFrame = performance.now();
  showPlaying();
  requestAnimationFrame(frame);
}

function pause() {
  player.playing = false;
  showPlaying();
}

function frame(now) {
  if (!player.playing) return;
  // A page that was hidden must not leap.
  const passed = Math.min(Math.max(now - player.lastFrame, 0), 100) / 1000;
  player.lastFrame = now;
  goTo(player.time + passed * player.speed, { passing: true });
  if (player.time >= lastTime) pause(); else requestAnimationFrame(frame);
}

function showPlaying() {
  const icon = player.playing ? "pause" : "play";
  element("play").innerHTML = `<svg viewBox="0 0 16 16"><path d="${ICONS[icon]}"/></svg>`;
  element("play").setAttribute("aria-label", player.playing ? "Pause" : "Play");
}

/** Draws once before the next frame, however often it is called. */
/** Arrows of a crowd begin shorter, so that they do not bury the bodies. */
const crowd = Math.max(1, recording.contact_starts.reduce((most, start, i, starts) => Math.max(most, start - (starts[i - 1] ?? 0)), 0) / 40);
element("arrow-scale").value = Math.max(-1.5, -0.9 * Math.log10(crowd));

function redraw() {
  if (player.scheduled) return;
  player.scheduled = true;
  requestAnimationFrame(() => { player.scheduled = false; draw(); });
}

function draw() {
  const { time } = player;
  view.draw(time, player.contactSample, {
    forces: element("show-forces").checked,
    contacts: element("show-contacts").checked,
    springs: element("show-springs").checked,
    joints: element("show-joints").checked,
    names: element("show-names").checked,
    trails: element("show-trails").checked,
    arrowScale: 10 ** Number(element("arrow-scale").value),
  });
  energyPlot.draw(time);
  const span = lastTime - firstTime;
  element("slider").value = span > 0 ? (time - firstTime) / span : 0;
  const decimals = span < 2 ? 4 : span < 100 ? 3 : 2;
  element("clock").textContent = `${time.toFixed(decimals)} / ${lastTime.toFixed(decimals)} s`;

  const { audit } = recording, row = indexAt(audit.times, time + 1e-9 * span);
  const sample = indexAt(recording.times, time + 1e-9 * span);
  const values = [
    `${time.toFixed(decimals)} s`, String(recording.steps[sample] ?? "–"),
    `${show(audit.kinetic[row])} J`, `${show(audit.potential[row])} J`, `${show(audit.total[row])} J`,
    show(audit.contacts[row]), `${show(audit.deepest_overlap[row], 3)} m`,
  ];
  readout.forEach((cell, index) => { cell.textContent = values[index]; });
  showTooltip();
  document.body.dataset.time = String(time);
}

const pointer = { x: 0, y: 0, over: false, dragging: false };

function showTooltip() {
  if (!pointer.over) view.hovered = -1;
  const tooltip = element("tooltip");
  const body = pointer.over && !pointer.dragging ? view.bodyAt(pointer.x, pointer.y) : -1;
  tooltip.hidden = body < 0;
  if (body < 0) return;
  const name = document.createElement("b");
  name.textContent = recording.bodies[body].name;
  const kind = recording.bodies[body].kind;
  const where = kind === "static" ? "" : `\n${view.describe(body)}`;
  tooltip.replaceChildren(name, kind + where);
  tooltip.style.left = `${Math.max(4, Math.min(pointer.x + 14, view.width - tooltip.offsetWidth - 4))}px`;
  tooltip.style.top = `${Math.max(4, Math.min(pointer.y + 14, view.height - tooltip.offsetHeight - 4))}px`;
}

element("play").addEventListener("click", () => (player.playing ? pause() : play()));
element("back").addEventListener("click", () => stepBy(-1));
element("forward").addEventListener("click", () => stepBy(1));
element("fit").addEventListener("click", () => { view.fit(); redraw(); });
element("speed").addEventListener("change", (event) => { player.speed = Number(event.target.value); });
element("slider").addEventListener("input", (event) => {
  pause();
  goTo(firstTime + Number(event.target.value) * (lastTime - firstTime));
});
for (const id of ["show-forces", "show-contacts", "show-springs", "show-joints", "show-names", "show-trails", "arrow-scale"]) {
  element(id).addEventListener("input", redraw);
}
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
  const actions = {
    " ": () => (player.playing ? pause() : play()),
    ArrowLeft: () => stepBy(event.shiftKey ? -10 : -1),
    ArrowRight: () => stepBy(event.shiftKey ? 10 : 1),
    Home: () => { pause(); goTo(firstTime); },
    End: () => { pause(); goTo(lastTime); },
    f: () => { view.fit(); redraw(); },
  };
  const action = actions[event.key] ?? actions[event.key.toLowerCase()];
  if (!action) return;
  event.preventDefault();
  // Else the space bar would also press the button that was clicked last.
  if (event.key === " ") document.activeElement?.blur();
  action();
});

const canvas = view.canvas;
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  view.zoom(event.offsetX, event.offsetY, Math.exp(-event.deltaY * (event.deltaMode === 1 ? .04 : .0015)));
  redraw();
}, { passive: false });
/** Fingers and buttons that are down, by the id of the pointer. */
const touches = new Map();
canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  touches.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
  pointer.dragging = true;
  Object.assign(pointer, { x: event.offsetX, y: event.offsetY });
  canvas.classList.add("dragging");
});
canvas.addEventListener("pointermove", (event) => {
  const before = touches.get(event.pointerId), now = { x: event.offsetX, y: event.offsetY };
  if (before && touches.size === 2) {
    // Two fingers: their distance zooms, their middle moves.
    const [other] = [...touches].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
    const reach = ({ x, y }) => Math.max(Math.hypot(x - other.x, y - other.y), 1);
    view.zoom((now.x + other.x) / 2, (now.y + other.y) / 2, reach(now) / reach(before));
    view.pan((now.x - before.x) / 2, (now.y - before.y) / 2);
  } else if (before) {
    if (event.shiftKey || event.buttons & 6) view.pan(now.x - before.x, now.y - before.y);
    else view.drag(now.x - before.x, now.y - before.y);
  }
  if (before) touches.set(event.pointerId, now);
  Object.assign(pointer, { ...now, over: true });
  redraw();
});
for (const name of ["pointerup", "pointercancel"]) {
  canvas.addEventListener(name, (event) => {
    touches.delete(event.pointerId);
    if (touches.size === 0) { pointer.dragging = false; canvas.classList.remove("dragging"); }
    redraw();
  });
}
canvas.addEventListener("contextmenu", (event) => event.preventDefault());
canvas.addEventListener("pointerleave", () => { pointer.over = false; redraw(); });
canvas.addEventListener("dblclick", () => { view.fit(); redraw(); });

const seek = (event) => { pause(); goTo(energyPlot.timeAt(event.offsetX)); };
energyPlot.canvas.addEventListener("pointerdown", (event) => { energyPlot.canvas.setPointerCapture(event.pointerId); seek(event); });
energyPlot.canvas.addEventListener("pointermove", (event) => { if (event.buttons) seek(event); });

/** Follows `#t=1.5` in the address. */
function followHash() {
  const match = /[#&]t=([-+.\deE]+)/.exec(location.hash);
  if (match && Number.isFinite(Number(match[1]))) { pause(); goTo(Number(match[1])); }
}
window.addEventListener("hashchange", followHash);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { colors.clear(); view.hatchings?.clear(); redraw(); });
new ResizeObserver(() => { if (view.fitted) view.everFitted = false; redraw(); }).observe(element("stage"));

showPlaying();
goTo(firstTime);
followHash();
draw();
Object.assign(document.body.dataset, {
  ready: "true",
  bodies: String(recording.bodies.length),
  samples: String(recording.times.length),
});
