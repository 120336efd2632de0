// What the pictures of the plane and of space share.

const PALETTE = ["#2f7fc1", "#d9742b", "#2aa37a", "#c0589a", "#b98d00", "#4fa3d8", "#a5544a", "#6f7fd0"];

/** Draws on a canvas, in CSS pixels. */
class Pen {
  constructor(canvas) {
    this.canvas = canvas;
  }

  /** Text with a rim in the colour of the page, readable on anything. */
  outlined(text, x, y) {
    const { context } = this;
    context.lineWidth = 4;
    context.strokeStyle = color("--canvas");
    context.strokeText(text, x, y);
    context.fillStyle = color("--ink");
    context.fillText(text, x, y);
  }

  /** An arrow of at most 220 px; one that had to be cut has a double head. */
  arrow(x, y, dx, dy) {
    const { context } = this;
    const full = Math.hypot(dx, dy);
    if (!(full >= 1.5)) return;
    const length = Math.min(full, 220), head = Math.min(9, .6 * length);
    context.save();
    context.translate(x, y);
    context.rotate(Math.atan2(dy, dx));
    context.strokeStyle = context.fillStyle = color("--force");
    context.lineWidth = 2;
    context.lineCap = "butt";
    context.beginPath(); context.moveTo(0, 0); context.lineTo(length - head, 0); context.stroke();
    for (const tip of full > 220 ? [length, length - 8] : [length]) {
      context.beginPath();
      context.moveTo(tip, 0); context.lineTo(tip - head, .42 * head); context.lineTo(tip - head, -.42 * head);
      context.fill();
    }
    context.restore();
  }

  /** Where bodies were in the last two seconds. */
  drawTrails(time) {
    const { context } = this, marks = 60, span = 2, past = [];
    for (let i = marks; i >= 0; i--) past.push(posesAt(Math.max(firstTime, time - (span * i) / marks)));
    context.lineWidth = 1.5;
    context.globalAlpha = .6;
    recording.bodies.forEach((body, index) => {
      if (body.kind === "static") return;
      context.strokeStyle = this.bodyColors[index];
      context.beginPath();
      const pixels = past.map((poses) => this.pixelOf(poses[index]));
      pixels.filter((pixel) => pixel.every(Number.isFinite)).forEach((pixel) => context.lineTo(...pixel));
      context.stroke();
    });
    context.globalAlpha = 1;
  }
}
