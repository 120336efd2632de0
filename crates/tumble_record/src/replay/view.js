// The picture of the bodies of a plane.

/** Poses of all bodies at a time, between samples by linear interpolation; x is NaN for a body that is not in the world. */
function posesAt(time, out = []) {
  const { times, poses, bodies, origin } = recording;
  const sample = indexAt(times, time), next = Math.min(sample + 1, times.length - 1);
  const span = times[next] - times[sample];
  const share = span > 0 ? Math.min(Math.max((time - times[sample]) / span, 0), 1) : 0;
  for (let body = 0; body < bodies.length; body++) {
    const now = (sample * bodies.length + body) * 3, later = (next * bodies.length + body) * 3;
    const blend = (i) => {
      const value = poses[now + i], end = poses[later + i];
      return share > 0 && end === end ? value + share * (end - value) : value;
    };
    const angle = blend(2);
    out[body] = { x: origin[0] + blend(0), y: origin[1] + blend(1), cos: Math.cos(angle), sin: Math.sin(angle), angle };
  }
  return out;
}

class View extends Pen {
  constructor(canvas) {
    super(canvas);
    this.camera = { x: 0, y: 0, scale: 100 };
    this.fitted = true;
    this.force = typicalForce();
    this.bodyColors = recording.bodies.map((_, index) => PALETTE[index % PALETTE.length]);
    this.outlines = recording.bodies.map((body) => body.shapes.flatMap(({ geometry }) => outline(geometry)));
    this.reach = recording.bodies.map(bodyReach);
  }

  /** Shows the start and where nearly all bodies go; one that flies away does not shrink the rest to dots. */
  fit() {
    const { bodies, times } = recording;
    const xs = [], ys = [], poses = [];
    const collect = (time, xs, ys) => posesAt(time, poses).forEach((pose, body) => {
      if (!Number.isFinite(pose.x) || !Number.isFinite(pose.y)) return;
      for (const [x, y, radius] of this.outlines[body]) {
        const wx = pose.x + pose.cos * x - pose.sin * y, wy = pose.y + pose.sin * x + pose.cos * y;
        xs.push(wx - radius, wx + radius);
        ys.push(wy - radius, wy + radius);
      }
    });
    const startXs = [], startYs = [];
    for (const { body, point: [x, y] } of [...recording.springs, ...recording.joints].flatMap(({ a, b }) => [a, b])) {
      if (body === null) { startXs.push(x); startYs.push(y); }
    }
    const stride = Math.max(1, Math.floor((bodies.length * times.length) / 50000));
    for (let sample = 0; sample < times.length; sample += stride) collect(times[sample], xs, ys);
    collect(firstTime, startXs, startYs);
    const [left, right] = nearlyAll(xs, startXs), [low, high] = nearlyAll(ys, startYs);

    const width = Math.max(right - left, 1e-9), height = Math.max(high - low, 1e-9);
    // Room for the tool bar above and for ground and scales below.
    const room = { x: Math.max(this.canvas.clientWidth - 100, 50), y: Math.max(this.canvas.clientHeight - 150, 50) };
    this.camera.scale = Math.min(room.x / width, room.y / height);
    // Spare height goes above rather than below, where there is mostly ground.
    const spare = Math.max(room.y - height * this.camera.scale, 0);
    this.camera.x = (left + right) / 2;
    this.camera.y = (low + high) / 2 + (0.25 * spare - 12) / this.camera.scale;
    this.fitted = true;
  }

  toScreen(x, y) {
    return [this.width / 2 + (x - this.camera.x) * this.camera.scale, this.height / 2 - (y - this.camera.y) * this.camera.scale];
  }

  toWorld(px, py) {
    return [this.camera.x + (px - this.width / 2) / this.camera.scale, this.camera.y - (py - this.height / 2) / this.camera.scale];
  }

  zoom(px, py, factor) {
    const [x, y] = this.toWorld(px, py);
    this.camera.scale = Math.min(Math.max(this.camera.scale * factor, 1e-4), 1e8);
    const [nx, ny] = this.toWorld(px, py);
    this.camera.x += x - nx;
    this.camera.y += y - ny;
    this.fitted = false;
  }

  pan(dx, dy) {
    this.camera.x -= dx / this.camera.scale;
    this.camera.y += dy / this.camera.scale;
    this.fitted = false;
  }

  /** What a drag does. */
  drag(dx, dy) { this.pan(dx, dy); }

  /** What is said about a body that the pointer is over. */
  describe(index) {
    const pose = this.poses[index];
    return `x ${show(pose.x)} m   y ${show(pose.y)} m\nangle ${show(pose.angle)} rad`;
  }

  /** Draws everything at a time, with the contacts of a sample. */
  draw(time, sample, options) {
    const { context, width, height } = sharpCanvas(this.canvas);
    Object.assign(this, { context, width, height });
    if (!this.everFitted && width > 0) { this.fit(); this.everFitted = true; }
    this.poses = posesAt(time);
    context.fillStyle = color("--canvas");
    context.fillRect(0, 0, width, height);
    context.lineJoin = context.lineCap = "round";
    this.drawGrid();
    const order = ["static", "kinematic", "dynamic"];
    for (const kind of order) {
      if (kind === "dynamic" && options.trails) this.drawTrails(time);
      recording.bodies.forEach((body, index) => { if (body.kind === kind) this.drawBody(body, index); });
    }
    if (options.springs) this.drawSprings(time);
    if (options.joints) this.drawJoints(time);
    if (options.names) this.drawNames();
    const contacts = recording.times.length ? contactsOf(sample) : [];
    if (options.contacts) this.drawContacts(contacts);
    if (options.forces) this.drawForces(contacts, options.arrowScale);
    this.drawScales(options);
  }

  drawGrid() {
    const { context, width, height, camera } = this;
    const step = niceBelow(110 / camera.scale);
    const [left, top] = this.toWorld(0, 0), [right, bottom] = this.toWorld(width, height);
    for (const [spacing, name] of [[step / 5, "--grid"], [step, "--grid-strong"]]) {
      if (spacing * camera.scale < 9) continue;
      context.strokeStyle = color(name);
      context.lineWidth = 1;
      context.beginPath();
      for (let i = Math.ceil(left / spacing); i * spacing <= right; i++) {
        const x = Math.round(this.toScreen(i * spacing, 0)[0]) + .5;
        context.moveTo(x, 0); context.lineTo(x, height);
      }
      for (let i = Math.ceil(bottom / spacing); i * spacing <= top; i++) {
        const y = Math.round(this.toScreen(0, i * spacing)[1]) + .5;
        context.moveTo(0, y); context.lineTo(width, y);
      }
      context.stroke();
    }
  }

  drawBody(body, index) {
    const pose = this.poses[index];
    if (!Number.isFinite(pose.x) || !Number.isFinite(pose.y)) return;
    const { context, camera } = this;
    const [sx, sy] = this.toScreen(pose.x, pose.y);
    const far = this.reach[index] * camera.scale;
    if (far < Infinity && (sx + far < 0 || sx - far > this.width || sy + far < 0 || sy - far > this.height)) return;
    const ink = body.kind === "static" ? color("--static") : body.kind === "kinematic" ? color("--kinematic") : this.bodyColors[index];
    const place = ([x, y]) => this.toScreen(pose.x + pose.cos * x - pose.sin * y, pose.y + pose.sin * x + pose.cos * y);
    for (const { sensor, geometry } of body.shapes) {
      context.save();
      context.strokeStyle = context.fillStyle = ink;
      context.lineWidth = 2;
      if (sensor) context.setLineDash([5, 5]);
      const fill = () => {
        context.globalAlpha = sensor ? .06 : body.kind === "dynamic" ? .22 : .12;
        context.fill();
        // What no force moves is hatched, like the ground.
        if (body.kind !== "dynamic" && !sensor) {
          context.globalAlpha = .5;
          context.fillStyle = this.hatching(ink, sx, sy, pose.angle);
          context.fill();
          context.fillStyle = ink;
        }
        context.globalAlpha = 1;
        context.stroke();
      };
      if (geometry.Rod) this.drawRod(geometry.Rod, place, far, fill);
      if (geometry.Disc) this.drawDisc(geometry.Disc, place, fill);
      if (geometry.Polygon) {
        context.beginPath();
        geometry.Polygon.points.forEach((point) => context.lineTo(...place(point)));
        context.closePath();
        fill();
      }
      if (geometry.HalfPlane) this.drawHalfPlane(geometry.HalfPlane, place, pose);
      context.restore();
    }
    if (body.kind === "dynamic" && (far > 9)) {
      context.fillStyle = ink;
      context.beginPath(); context.arc(sx, sy, 2.2, 0, 7); context.fill();
    }
  }

  drawRod({ from, to, radius }, place, far, fill) {
    const { context } = this;
    const [start, end] = [place(from), place(to)];
    const wide = radius * this.camera.scale;
    context.beginPath();
    if (wide < 2) {
      // A thin rod has no width of its own: a bold line, finer on small bodies.
      context.lineWidth = Math.min(Math.max(.12 * far, 1), 3.2);
      context.moveTo(...start); context.lineTo(...end);
      context.stroke();
      return;
    }
    const turn = Math.atan2(end[1] - start[1], end[0] - start[0]);
    context.arc(...start, wide, turn + Math.PI / 2, turn - Math.PI / 2);
    context.arc(...end, wide, turn - Math.PI / 2, turn + Math.PI / 2);
    context.closePath();
    fill();
  }

  drawDisc({ centre, radius }, place, fill) {
    const { context } = this;
    const [x, y] = place(centre);
    context.beginPath();
    context.arc(x, y, Math.max(radius * this.camera.scale, 1), 0, 2 * Math.PI);
    fill();
    context.beginPath();
    context.moveTo(x, y); context.lineTo(...place([centre[0] + radius, centre[1]]));
    context.stroke();
  }

  /** Slanting lines in a colour, fixed to a body that stands at a pixel. */
  hatching(ink, x, y, angle) {
    const spacing = 8, ratio = window.devicePixelRatio || 1;
    this.hatchings ??= new Map();
    if (!this.hatchings.has(ink)) {
      const tile = document.createElement("canvas");
      tile.width = tile.height = Math.round(spacing * ratio);
      const pen = tile.getContext("2d");
      pen.scale(tile.width / spacing, tile.height / spacing);
      pen.strokeStyle = ink;
      pen.beginPath();
      // Lines to the corners too, so that the tiles join.
      for (const shift of [-spacing, 0, spacing]) { pen.moveTo(shift - 1, spacing + 1); pen.lineTo(shift + spacing + 1, -1); }
      pen.stroke();
      this.hatchings.set(ink, { tile, pattern: this.context.createPattern(tile, "repeat") });
    }
    const { tile, pattern } = this.hatchings.get(ink);
    pattern.setTransform(new DOMMatrix().translate(x, y).rotate((-angle * 180) / Math.PI).scale(spacing / tile.width));
    return pattern;
  }

  /** Zigzags between the ends of springs, as wide as their length without force says. */
  drawSprings(time) {
    const { context, camera } = this;
    const windings = 9;
    context.strokeStyle = context.fillStyle = color("--spring");
    context.lineWidth = 1.5;
    for (const { a, b, rest_length, from, until } of recording.springs) {
      // An end held by a body that is not in the world is nowhere.
      const ends = [a, b].map((end) => this.anchorOnScreen(end));
      if (time < from || time >= (until ?? Infinity) || !ends.flat().every(Number.isFinite)) continue;
      const [[ax, ay], [bx, by]] = ends;
      const length = Math.hypot(bx - ax, by - ay), wide = Math.min(.06 * rest_length * camera.scale, 7);
      if (length > 2) {
        const [ux, uy] = [(bx - ax) / length, (by - ay) / length];
        const lead = Math.min(.15 * length, 12), coil = (length - 2 * lead) / (2 * windings);
        context.beginPath();
        context.moveTo(ax, ay);
        for (let i = 0; i <= 2 * windings; i++) {
          const along = lead + i * coil, aside = i === 0 || i === 2 * windings ? 0 : i % 2 ? wide : -wide;
          context.lineTo(ax + ux * along - uy * aside, ay + uy * along + ux * aside);
        }
        context.lineTo(bx, by);
        context.stroke();
      }
      for (const [end, [x, y]] of [[a, ends[0]], [b, ends[1]]]) {
        context.beginPath();
        // A ring is held by the world, a dot by a body.
        context.arc(x, y, end.body === null ? 4 : 2.4, 0, 7);
        if (end.body === null) context.stroke(); else context.fill();
      }
    }
  }

  /** Pins as rings, massless rods as lines with a ring at each end, welds as squares, guides as bars along their axis. */
  drawJoints(time) {
    const { context } = this;
    context.strokeStyle = color("--spring");
    context.fillStyle = color("--canvas");
    context.lineWidth = 1.8;
    for (const { kind, a, b, axis, from, until } of recording.joints) {
      const ends = [a, b].map((anchor) => this.anchorOnScreen(anchor));
      if (time < from || time >= (until ?? Infinity) || !ends.flat().every(Number.isFinite)) continue;
      const [[ax, ay], [bx, by]] = ends;
      const stroke = (...points) => {
        context.beginPath();
        points.forEach((point) => context.lineTo(...point));
        context.stroke();
      };
      const ring = ([x, y]) => {
        context.beginPath();
        context.arc(x, y, 4, 0, 7);
        context.fill();
        context.stroke();
      };
      if (kind === "prismatic") {
        const pose = a.body === null ? { cos: 1, sin: 0 } : this.poses[a.body], size = Math.hypot(...axis);
        const [ux, uy] = [(pose.cos * axis[0] - pose.sin * axis[1]) / size, -(pose.sin * axis[0] + pose.cos * axis[1]) / size];
        const along = (bx - ax) * ux + (by - ay) * uy, low = Math.min(along, 0) - 22, high = Math.max(along, 0) + 22;
        for (const aside of [-5, 5]) {
          stroke([ax + ux * low - uy * aside, ay + uy * low + ux * aside], [ax + ux * high - uy * aside, ay + uy * high + ux * aside]);
        }
      } else if (kind === "fixed") {
        context.beginPath();
        context.rect(bx - 4, by - 4, 8, 8);
        context.fill();
        context.stroke();
      } else {
        if (kind === "distance") stroke([ax, ay], [bx, by]);
        ends.slice(kind === "distance" ? 0 : 1).forEach(ring);
      }
    }
  }

  /** Where a spring or a joint is held, in pixels. */
  anchorOnScreen({ body, point: [x, y] }) {
    const pose = body === null ? { x: 0, y: 0, cos: 1, sin: 0 } : this.poses[body];
    return this.toScreen(pose.x + pose.cos * x - pose.sin * y, pose.y + pose.sin * x + pose.cos * y);
  }

  /** Fills the solid side, hatched along its surface; the hatching is fixed to the surface and does not swim. */
  drawHalfPlane({ point, normal }, place, pose) {
    const { context, width, height } = this;
    const n = [pose.cos * normal[0] - pose.sin * normal[1], -(pose.sin * normal[0] + pose.cos * normal[1])];
    const t = [-n[1], n[0]];
    const base = place(point);
    const along = (width / 2 - base[0]) * t[0] + (height / 2 - base[1]) * t[1];
    const half = width + height;
    const at = (s, depth) => [base[0] + t[0] * s - n[0] * depth, base[1] + t[1] * s - n[1] * depth];
    const ink = context.strokeStyle;
    context.fillStyle = color("--ground");
    context.beginPath();
    [at(along - half, 0), at(along + half, 0), at(along + half, 3 * half), at(along - half, 3 * half)].forEach((p) => context.lineTo(...p));
    context.fill();
    context.strokeStyle = ink;
    context.lineWidth = 1;
    context.globalAlpha = .55;
    context.beginPath();
    const spacing = 11;
    for (let i = Math.floor((along - half) / spacing); i * spacing < along + half; i++) {
      context.moveTo(...at(i * spacing, 0)); context.lineTo(...at(i * spacing - 9, 11));
    }
    context.stroke();
    context.globalAlpha = 1;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(...at(along - half, 0)); context.lineTo(...at(along + half, 0));
    context.stroke();
  }

  pixelOf({ x, y }) { return this.toScreen(x, y); }

  drawNames() {
    const { context } = this;
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "left";
    recording.bodies.forEach((body, index) => {
      if (body.kind === "static" || !Number.isFinite(this.poses[index].x)) return;
      const [x, y] = this.toScreen(this.poses[index].x, this.poses[index].y);
      this.outlined(body.name.length > 28 ? body.name.slice(0, 27) + "…" : body.name, x + 7, y - 7);
    });
  }

  drawContacts(contacts) {
    const { context } = this;
    context.lineWidth = 1.5;
    context.fillStyle = color("--contact");
    context.strokeStyle = color("--canvas");
    for (const contact of contacts) {
      context.beginPath();
      context.arc(...this.toScreen(...contact.point), 3.6, 0, 7);
      context.fill();
      context.stroke();
    }
  }

  drawForces(contacts, arrowScale) {
    const pixels = (50 * arrowScale) / this.force;
    for (const contact of contacts) {
      const [x, y] = this.toScreen(...contact.point);
      for (const [body, sign] of [[contact.a, -1], [contact.b, 1]]) {
        if (recording.bodies[body]?.kind === "dynamic") this.arrow(x, y, sign * contact.force[0] * pixels, -sign * contact.force[1] * pixels);
      }
    }
  }

  /** What a length and an arrow mean. */
  drawScales(options) {
    const { context, height, camera } = this;
    const length = niceBelow(130 / camera.scale), y = height - 18;
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "left";
    context.lineCap = "butt";
    for (const [rim, ink] of [[5, "--canvas"], [2, "--ink"]]) {
      context.strokeStyle = color(ink);
      context.lineWidth = rim;
      context.beginPath();
      context.moveTo(16, y - 5); context.lineTo(16, y); context.lineTo(16 + length * camera.scale, y); context.lineTo(16 + length * camera.scale, y - 5);
      context.stroke();
    }
    this.outlined(show(length) + " m", 20, y - 7);
    if (!options.forces || recording.contact_numbers.length === 0) return;
    const pixels = (50 * options.arrowScale) / this.force, force = niceBelow(90 / pixels);
    const start = 16 + length * camera.scale + 36;
    this.arrow(start, y, force * pixels, 0);
    this.outlined(show(force) + " N", start + 2, y - 7);
  }

  /** Index of the body under a pixel, moving ones first; −1 if there is none. */
  bodyAt(px, py) {
    if (!this.poses) return -1;
    const [x, y] = this.toWorld(px, py), slack = 6 / this.camera.scale;
    let best = -1, bestRank = Infinity;
    recording.bodies.forEach((body, index) => {
      const pose = this.poses[index], dx = x - pose.x, dy = y - pose.y;
      const point = [pose.cos * dx + pose.sin * dy, -pose.sin * dx + pose.cos * dy];
      const distance = Math.min(...body.shapes.map(({ geometry }) => distanceTo(geometry, point)));
      const rank = Math.max(distance, 0) + (body.kind === "static" ? slack : 0) + (body.shapes.every((shape) => shape.sensor) ? slack : 0);
      if (distance <= slack && rank <= bestRank) { best = index; bestRank = rank; }
    });
    return best;
  }
}

/** Least and greatest of a list without its outermost half percents, and of a second list with all. */
function nearlyAll(values, always) {
  values.sort((a, b) => a - b);
  let low = values[Math.round(.005 * (values.length - 1))] ?? -1, high = values[Math.round(.995 * (values.length - 1))] ?? 1;
  for (const value of always) { low = Math.min(low, value); high = Math.max(high, value); }
  return [low, high];
}

/** Circles [x, y, radius] in the body frame whose hull is the shape; none for a half-plane, which has no end. */
function outline(geometry) {
  if (geometry.Rod) return [geometry.Rod.from, geometry.Rod.to].map((end) => [...end, geometry.Rod.radius]);
  if (geometry.Disc) return [[...geometry.Disc.centre, geometry.Disc.radius]];
  return (geometry.Polygon?.points ?? []).map((point) => [...point, 0]);
}

/** Largest distance of a body's surface from its centre of mass; infinite for a half-plane. */
function bodyReach(body) {
  if (body.shapes.some(({ geometry }) => geometry.HalfPlane)) return Infinity;
  return Math.max(0, ...body.shapes.flatMap(({ geometry }) => outline(geometry)).map(([x, y, radius]) => Math.hypot(x, y) + radius));
}

/** Distance from a point of the body frame to a shape, at most 0 inside. */
function distanceTo(geometry, [x, y]) {
  const toSegment = ([ax, ay], [bx, by]) => {
    const [ex, ey] = [bx - ax, by - ay];
    const share = Math.min(Math.max(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey || 1), 0), 1);
    return Math.hypot(x - ax - share * ex, y - ay - share * ey);
  };
  if (geometry.Rod) return toSegment(geometry.Rod.from, geometry.Rod.to) - geometry.Rod.radius;
  if (geometry.Disc) return Math.hypot(x - geometry.Disc.centre[0], y - geometry.Disc.centre[1]) - geometry.Disc.radius;
  if (geometry.HalfPlane) {
    const { point, normal } = geometry.HalfPlane;
    return (x - point[0]) * normal[0] + (y - point[1]) * normal[1];
  }
  const corners = geometry.Polygon.points;
  const edges = corners.map((corner, i) => [corner, corners[(i + 1) % corners.length]]);
  const inside = edges.every(([[ax, ay], [bx, by]]) => (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0);
  return inside ? 0 : Math.min(...edges.map(([from, to]) => toSegment(from, to)));
}
