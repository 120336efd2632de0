// The picture of the bodies of space: solids by WebGL, and what is known about them drawn above.

const add = (a, b, share = 1) => [a[0] + share * b[0], a[1] + share * b[1], a[2] + share * b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, factor) => a.map((part) => part * factor);
const unit = (a) => scaled(a, 1 / (Math.hypot(...a) || 1));
/** A vector of the body frame in world axes, by a quaternion x, y, z, w. */
const turned = (q, v) => add(v, cross(q, add(cross(q, v), v, q[3])), 2);
/** Colour of a style sheet's #rrggbb as shares of red, green and blue. */
const shares = (hex) => [1, 3, 5].map((start) => parseInt(hex.slice(start, start + 2), 16) / 255);

/** Poses of all bodies at a time, between samples on the shorter way; place is relative to the origin, NaN for a body that is not in the world. */
function posesAt(time, out = []) {
  const { times, poses, bodies } = recording;
  const sample = indexAt(times, time), next = Math.min(sample + 1, times.length - 1);
  const span = times[next] - times[sample];
  const share = span > 0 ? Math.min(Math.max((time - times[sample]) / span, 0), 1) : 0;
  for (let body = 0; body < bodies.length; body++) {
    const row = (index) => Array.from(poses.subarray((index * bodies.length + body) * 7, (index * bodies.length + body + 1) * 7));
    const now = sample >= 0 && times.length ? row(sample) : Array(7).fill(NaN), later = share > 0 ? row(next) : now;
    const blended = Number.isFinite(later[0]) ? share : 0;
    const place = add(now, add(later, now, -1), blended).slice(0, 3);
    let turn = now.slice(3), end = later.slice(3);
    if (blended > 0) {
      const sign = turn[0] * end[0] + turn[1] * end[1] + turn[2] * end[2] + turn[3] * end[3] < 0 ? -1 : 1;
      turn = turn.map((part, i) => part + blended * (sign * end[i] - part));
    }
    const length = Math.hypot(...turn) || 1;
    out[body] = { place, turn: turn.map((part) => part / length) };
  }
  return out;
}

class View extends Pen {
  constructor(canvas) {
    super(canvas);
    this.help = "drag to turn, shift or right button to move, wheel to zoom";
    const { up, span: [low, high] } = recording.stage;
    this.up = up;
    const side = Math.abs(up[0]) < .9 ? [1, 0, 0] : [0, 1, 0];
    this.east = unit(add(side, up, -dot(side, up)));
    this.south = cross(this.east, up);
    [this.low, this.high] = [low, high];
    this.size = Math.hypot(...add(high, low, -1)) || 1;
    this.force = typicalForce();
    this.bodyColors = recording.bodies.map((_, index) => PALETTE[index % PALETTE.length]);
    this.light = new Light(canvas);
    if (!this.light.works) {
      const words = document.createElement("p");
      words.id = "missing";
      words.textContent = "This browser does not offer WebGL 2, which the picture of the bodies needs. Time, energies and numbers work; the tables and plots of the run have everything.";
      canvas.before(words);
    }
    this.camera = { azimuth: .55, elevation: .3, distance: 1, focus: [0, 0, 0] };
    this.fitted = true;
  }

  /** Shows all that moves, at all times. */
  fit() {
    this.camera = { azimuth: .55, elevation: .3, distance: 1, focus: [0, 0, 0] };
    const axes = this.axes(), slope = this.slope(), aspect = this.width / Math.max(this.height, 1);
    const { bodies, times } = recording, balls = [], poses = [];
    const stride = Math.max(1, Math.floor((bodies.length * times.length) / 50000));
    for (let sample = 0; sample < times.length; sample += stride) {
      posesAt(times[sample], poses).forEach(({ place }, body) => {
        if (bodies[body].kind !== "static" && place.every(Number.isFinite)) balls.push({ seen: axes.map((axis) => dot(axis, place)), reach: bodies[body].reach });
      });
    }
    const bounds = [0, 1, 2].map((axis) => balls.reduce(([low, high], { seen, reach }) =>
      [Math.min(low, seen[axis] - reach), Math.max(high, seen[axis] + reach)], balls.length ? [Infinity, -Infinity] : [-1, 1]));
    const middle = bounds.map(([low, high]) => (low + high) / 2);
    this.camera.focus = axes.reduce((sum, axis, i) => add(sum, axis, middle[i]), [0, 0, 0]);
    // Room for the tool bar above.
    const distance = balls.reduce((most, { seen, reach }) => {
      const [x, y, depth] = add(seen, middle, -1);
      return Math.max(most, Math.max((Math.abs(x) + reach) / (slope * aspect * .92), (Math.abs(y) + reach) / (slope * .82)) - depth);
    }, 0);
    this.camera.distance = Math.max(distance, 1e-3 * this.size);
    this.fitted = true;
  }

  slope() { return Math.tan(.26); }

  /** Unit vectors to the right, up and into the picture. */
  axes() {
    const { azimuth, elevation } = this.camera, { east, south, up } = this;
    const level = add(scaled(south, Math.cos(azimuth)), east, Math.sin(azimuth));
    const forward = scaled(add(scaled(level, Math.cos(elevation)), up, Math.sin(elevation)), -1);
    const right = add(scaled(east, Math.cos(azimuth)), south, -Math.sin(azimuth));
    return [right, cross(right, forward), forward];
  }

  drag(dx, dy) {
    this.camera.azimuth -= dx * .0075;
    this.camera.elevation = Math.min(Math.max(this.camera.elevation + dy * .0075, -1.45), 1.55);
    this.fitted = false;
  }

  pan(dx, dy) {
    const [right, above] = this.axes(), length = (2 * this.slope() * this.camera.distance) / Math.max(this.height, 1);
    this.camera.focus = add(add(this.camera.focus, right, -dx * length), above, dy * length);
    this.fitted = false;
  }

  zoom(px, py, factor) {
    this.camera.distance = Math.min(Math.max(this.camera.distance / factor, 1e-4 * this.size), 1e3 * this.size);
    this.fitted = false;
  }

  /** Draws everything at a time, with the contacts of a sample. */
  draw(time, sample, options) {
    const { context, width, height } = sharpCanvas(this.canvas);
    Object.assign(this, { context, width, height });
    if (!this.everFitted && width > 0) { this.fit(); this.everFitted = true; }
    this.poses = posesAt(time);
    const [right, above, forward] = this.axes(), { distance, focus } = this.camera;
    const eye = add(focus, forward, -distance);
    this.seen = { right, above, forward, eye, scale: height / (2 * this.slope()) };
    this.drawSky();
    const contacts = recording.times.length ? contactsOf(sample) : [];
    const marks = options.contacts ? contacts.map(({ point }) => add(point, recording.origin, -1)) : [];
    if (this.light.works && width > 0) this.drawSolids(marks);
    context.lineJoin = context.lineCap = "round";
    if (options.trails) this.drawTrails(time);
    if (options.springs) this.drawSprings(time);
    if (options.joints) this.drawJoints(time);
    if (!this.light.works) this.drawMarks(marks);
    if (options.forces) this.drawForces(contacts, options.arrowScale);
    if (options.names) this.drawNames();
    this.drawScale(options);
  }

  /** The sky is the page behind the solids: hazy at the horizon, where the ground ends in haze too. */
  drawSky() {
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    this.haze = dark ? "#20252d" : "#e9edf2";
    const horizon = this.height / 2 - this.seen.scale * Math.tan(this.camera.elevation);
    this.canvas.parentElement.style.background =
      `linear-gradient(${dark ? "#0f1318" : "#b3c9e2"} ${horizon - .6 * this.height}px, ${this.haze} ${horizon}px)`;
  }

  drawSolids(marks) {
    const { right, above, forward, eye } = this.seen, { distance } = this.camera;
    const slope = this.slope(), aspect = this.width / this.height, near = .02 * distance, far = distance + 60 * this.size;
    const row = (axis, factor) => [...scaled(axis, factor), -factor * dot(axis, eye)];
    const rows = [row(right, 1 / (slope * aspect)), row(above, 1 / slope)];
    const depth = row(forward, 1), steep = (far + near) / (far - near), shift = (-2 * far * near) / (far - near);
    rows.push(depth.map((part, i) => steep * part + (i === 3 ? shift : 0)), depth);
    const columns = (rows) => new Float32Array([0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column])));
    const toSun = unit(add(add(this.up, this.east, -.42), this.south, .62));
    const across = unit(cross(toSun, this.south)), along = cross(across, toSun), middle = scaled(add(this.low, this.high), .5);
    const half = .75 * this.size;
    const flat = (axis, factor) => [...scaled(axis, factor / half), (-factor / half) * dot(axis, middle)];
    const sun = columns([flat(across, 1), flat(along, 1), flat(toSun, -.5), [0, 0, 0, 1]]);
    const items = [];
    recording.bodies.forEach((body, index) => {
      const { place, turn } = this.poses[index];
      if (!place.every(Number.isFinite)) return;
      const ground = body.parts.length > 0 && body.parts.every(([mesh]) => recording.stage.meshes[mesh].ground);
      const hex = body.kind === "static" ? (ground ? this.groundColor() : "#a9afb9") : body.kind === "kinematic" ? "#8a6fbf" : this.bodyColors[index];
      const color = shares(hex);
      for (const [mesh, sensor] of body.parts) items.push({ mesh, sensor, place, turn, color, glow: index === this.hovered });
    });
    const inks = { color: shares(color("--contact")), rim: shares(color("--canvas")) };
    this.light.draw(items, { places: marks, ...inks }, { camera: columns(rows), eye, sun, toSun, up: this.up, size: this.size, haze: shares(this.haze) });
  }

  groundColor() { return matchMedia("(prefers-color-scheme: dark)").matches ? "#454c57" : "#d3d7dd"; }

  /** Pixel of a point relative to the origin; NaN behind the camera. */
  toScreen(point) {
    const { right, above, forward, eye, scale } = this.seen, offset = add(point, eye, -1), depth = dot(forward, offset);
    if (!(depth > 0)) return [NaN, NaN];
    return [this.width / 2 + (scale * dot(right, offset)) / depth, this.height / 2 - (scale * dot(above, offset)) / depth];
  }

  pixelOf({ place }) { return this.toScreen(place); }

  line(...points) {
    const { context } = this, pixels = points.map((point) => this.toScreen(point));
    if (!pixels.flat().every(Number.isFinite)) return;
    context.beginPath();
    pixels.forEach((pixel) => context.lineTo(...pixel));
    context.stroke();
  }

  dotAt(point, radius, rim) {
    const { context } = this, pixel = this.toScreen(point);
    if (!pixel.every(Number.isFinite)) return;
    context.beginPath();
    context.arc(...pixel, radius, 0, 7);
    context.fill();
    if (rim) context.stroke();
  }

  /** Where a spring or a joint is held. */
  anchor({ body, point }) {
    if (body === null) return add(point, recording.origin, -1);
    const { place, turn } = this.poses[body];
    return add(place, turned(turn, point));
  }

  /** Zigzags between the ends of springs. */
  drawSprings(time) {
    const { context } = this, windings = 9;
    context.strokeStyle = context.fillStyle = color("--spring");
    context.lineWidth = 1.5;
    for (const { a, b, rest_length, from, until } of recording.springs) {
      if (time < from || time >= (until ?? Infinity)) continue;
      const [start, end] = [a, b].map((held) => this.anchor(held)), along = add(end, start, -1), { forward } = this.seen;
      const aside = scaled(unit(cross(along, forward)), Math.min(.06 * rest_length, .12 * Math.hypot(...along)));
      const points = [start];
      for (let i = 0; i <= 2 * windings; i++) {
        const shift = i === 0 || i === 2 * windings ? 0 : i % 2 ? 1 : -1;
        points.push(add(add(start, along, .12 + (.76 * i) / (2 * windings)), aside, shift));
      }
      this.line(...points, end);
      for (const point of [start, end]) this.dotAt(point, 3);
    }
  }

  /** Rings where joints hold, and a line between the ends of massless rods. */
  drawJoints(time) {
    const { context } = this;
    context.strokeStyle = color("--spring");
    context.fillStyle = color("--canvas");
    context.lineWidth = 1.8;
    for (const { kind, a, b, axis, from, until } of recording.joints) {
      if (time < from || time >= (until ?? Infinity)) continue;
      const ends = [a, b].map((held) => this.anchor(held));
      if (kind === "distance") this.line(...ends);
      if (axis) {
        const held = a.body === null ? axis : turned(this.poses[a.body].turn, axis), reach = .08 * this.size;
        this.line(add(ends[1], unit(held), -reach), add(ends[1], unit(held), reach));
      }
      for (const end of kind === "distance" ? ends : ends.slice(1)) this.dotAt(end, 4, true);
    }
  }

  /** Marks of contact points where nothing can hide them. */
  drawMarks(marks) {
    this.context.lineWidth = 1.2;
    this.context.fillStyle = color("--contact");
    this.context.strokeStyle = color("--canvas");
    for (const place of marks) this.dotAt(place, 2.8, true);
  }

  /** Forces on moving bodies as arrows, as long in the world as they would be in the middle of the picture. */
  drawForces(contacts, arrowScale) {
    const length = (50 * arrowScale * this.camera.distance) / (this.force * this.seen.scale);
    for (const { point, force, a, b } of contacts) {
      const start = add(point, recording.origin, -1), from = this.toScreen(start);
      for (const [body, sign] of [[a, -1], [b, 1]]) {
        if (recording.bodies[body]?.kind !== "dynamic") continue;
        const to = this.toScreen(add(start, force, sign * length));
        if ([...from, ...to].every(Number.isFinite)) this.arrow(...from, to[0] - from[0], to[1] - from[1]);
      }
    }
  }

  drawNames() {
    const { context } = this;
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "left";
    recording.bodies.forEach((body, index) => {
      const [x, y] = this.toScreen(this.poses[index].place);
      if (body.kind === "static" || !Number.isFinite(x)) return;
      this.outlined(body.name.length > 28 ? body.name.slice(0, 27) + "…" : body.name, x + 7, y - 7);
    });
  }

  /** The world's axes, and what an arrow means. */
  drawScale(options) {
    const { context, height } = this, { right, above, forward } = this.seen, corner = [44, height - 44];
    context.font = "600 11px system-ui, sans-serif";
    context.textAlign = "center";
    const axes = [["x", [1, 0, 0], "#d1495b"], ["y", [0, 1, 0], "#3c9d5f"], ["z", [0, 0, 1], "#3a78c9"]];
    axes.sort((one, other) => dot(forward, other[1]) - dot(forward, one[1]));
    for (const [name, axis, ink] of axes) {
      const tip = [corner[0] + 24 * dot(right, axis), corner[1] - 24 * dot(above, axis)];
      context.strokeStyle = context.fillStyle = ink;
      context.lineWidth = 2;
      context.beginPath(); context.moveTo(...corner); context.lineTo(...tip); context.stroke();
      context.fillText(name, corner[0] + 33 * dot(right, axis), corner[1] - 33 * dot(above, axis) + 4);
    }
    context.textAlign = "left";
    context.font = "12px system-ui, sans-serif";
    if (!options.forces || recording.contact_numbers.length === 0) return;
    const pixels = (50 * options.arrowScale) / this.force, force = niceBelow(90 / pixels);
    this.arrow(96, height - 18, force * pixels, 0);
    this.outlined(show(force) + " N", 98, height - 25);
  }

  /** Index of the moving body whose ball is nearest under a pixel; −1 if there is none. */
  bodyAt(px, py) {
    let best = -1, nearest = Infinity;
    if (this.poses) recording.bodies.forEach((body, index) => {
      if (body.kind === "static") return;
      const { place } = this.poses[index], [x, y] = this.toScreen(place), depth = dot(this.seen.forward, add(place, this.seen.eye, -1));
      const radius = Math.max((.8 * body.reach * this.seen.scale) / depth, 5);
      if (Math.hypot(x - px, y - py) <= radius && depth < nearest) { best = index; nearest = depth; }
    });
    this.hovered = best;
    return best;
  }

  /** What is said about a body that the pointer is over. */
  describe(index) {
    const { place, turn } = this.poses[index], at = add(place, recording.origin);
    return ["x", "y", "z"].map((name, axis) => `${name} ${show(at[axis])} m`).join("   ") +
      `\nturned by ${show((360 / Math.PI) * Math.acos(Math.min(Math.abs(turn[3]), 1)))}°`;
  }
}

