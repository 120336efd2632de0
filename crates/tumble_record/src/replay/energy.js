// The energy plot, with a cursor at the present time.

class EnergyPlot {
  constructor(canvas) {
    this.canvas = canvas;
    this.curves = ["kinetic", "potential", "total"];
    const legend = document.getElementById("legend");
    for (const name of this.curves) {
      const entry = document.createElement("span");
      entry.textContent = name;
      entry.style.setProperty("--swatch", `var(--${name})`);
      legend.append(entry);
    }
    let low = Infinity, high = -Infinity;
    for (const name of this.curves) {
      for (const value of recording.audit[name]) {
        if (Number.isFinite(value)) { low = Math.min(low, value); high = Math.max(high, value); }
      }
    }
    if (!(low <= high)) [low, high] = [0, 1];
    const margin = high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high)) ? .06 * (high - low) : .1 * Math.abs(high) || 1;
    this.range = [low - margin, high + margin];
  }

  /** Where the axes are [px]. */
  frame(width, height) {
    return { left: 48, right: width - 8, top: 18, bottom: height - 34 };
  }

  /** Time under a pixel. */
  timeAt(px) {
    const { left, right } = this.frame(this.canvas.clientWidth, this.canvas.clientHeight);
    return firstTime + Math.min(Math.max((px - left) / (right - left), 0), 1) * (lastTime - firstTime);
  }

  draw(time) {
    const { context, width, height } = sharpCanvas(this.canvas);
    const { left, right, top, bottom } = this.frame(width, height);
    const span = lastTime - firstTime || 1, [low, high] = this.range;
    const toX = (t) => left + ((t - firstTime) / span) * (right - left);
    const toY = (value) => bottom - ((value - low) / (high - low)) * (bottom - top);
    this.drawAxes(context, { left, right, top, bottom }, toX, toY, span);
    context.save();
    context.beginPath();
    context.rect(left, top, right - left, bottom - top);
    context.clip();
    const { times } = recording.audit;
    context.lineWidth = 1.8;
    context.lineJoin = "round";
    for (const name of this.curves) {
      const values = recording.audit[name];
      context.strokeStyle = color(`--${name}`);
      context.beginPath();
      let drawing = false;
      for (let i = 0; i < times.length; i++) {
        const finite = Number.isFinite(values[i]);
        if (finite) context[drawing ? "lineTo" : "moveTo"](toX(times[i]), toY(values[i]));
        drawing = finite;
      }
      context.stroke();
    }
    context.restore();
    this.drawCursor(context, time, toX(time), top, bottom, toY);
  }

  drawAxes(context, { left, right, top, bottom }, toX, toY, span) {
    const [low, high] = this.range;
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = color("--faint");
    context.strokeStyle = color("--grid-strong");
    context.lineWidth = 1;
    context.beginPath();
    context.textBaseline = "middle";
    context.textAlign = "right";
    const rise = niceBelow((high - low) / 3.2);
    for (let i = Math.ceil(low / rise); i * rise <= high; i++) {
      const y = Math.round(toY(i * rise)) + .5;
      context.moveTo(left, y); context.lineTo(right, y);
      context.fillText(show(i * rise, 6), left - 6, y);
    }
    context.textBaseline = "top";
    context.textAlign = "center";
    const stride = niceBelow(span / 3.2);
    for (let i = Math.ceil(firstTime / stride - 1e-9); i * stride <= lastTime + 1e-9 * span; i++) {
      const x = Math.round(toX(i * stride)) + .5;
      context.moveTo(x, top); context.lineTo(x, bottom);
      context.fillText(show(i * stride, 6), x, bottom + 6);
    }
    context.stroke();
    context.fillText("time [s]", (left + right) / 2, bottom + 20);
    context.textAlign = "left";
    context.textBaseline = "alphabetic";
    context.fillText("[J]", 2, top - 6);
    context.strokeStyle = color("--faint");
    context.beginPath();
    context.moveTo(left + .5, top); context.lineTo(left + .5, bottom + .5); context.lineTo(right, bottom + .5);
    context.stroke();
  }

  drawCursor(context, time, x, top, bottom, toY) {
    context.strokeStyle = color("--ink");
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(x, top); context.lineTo(x, bottom);
    context.stroke();
    const row = indexAt(recording.audit.times, time);
    for (const name of this.curves) {
      const value = recording.audit[name][row];
      if (!Number.isFinite(value)) continue;
      context.fillStyle = color(`--${name}`);
      context.strokeStyle = color("--panel");
      context.lineWidth = 1.5;
      context.beginPath();
      context.arc(x, toY(value), 4, 0, 7);
      context.fill();
      context.stroke();
    }
  }
}
