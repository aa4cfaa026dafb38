// The flight from above: north up, with where one is and looks, people, and the chosen thing.
import {turn} from "./sphere.js";

const MARGIN = 14, MOST_POINTS = 4000, MOST_OUT = 256;

export class Minimap {
  constructor(canvas, onChoose) {
    Object.assign(this, {canvas, onChoose, points: [], whole: [], out: 1, people: [], box: null, here: null});
    canvas.addEventListener("wheel", e => { e.preventDefault(); this.zoom(Math.exp(0.002 * e.deltaY)); }, {passive: false});
    canvas.addEventListener("click", e => this.click(e));
    new ResizeObserver(() => this.draw()).observe(canvas);
  }
  /// Places of the frames, in W.
  setFlight(points, count = points.length) {
    this.whole = points;
    this.points = points.slice(0, count);  // those behind only have to be on the map
    this.fit();
  }
  /// Shows so many times more than before, never less than the flight.
  zoom(factor) {
    this.out = Math.max(1, Math.min(MOST_OUT, this.out * factor));
    this.fit();
  }
  fit() {
    let low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (const p of this.whole) for (const a of [0, 1]) { low[a] = Math.min(low[a], p[a]); high[a] = Math.max(high[a], p[a]); }
    const least = 10;  // metres, of a flight that stands still
    for (const a of [0, 1]) {
      const middle = (high[a] + low[a]) / 2, half = Math.max(least, high[a] - low[a]) / 2 * this.out;
      low[a] = middle - half;
      high[a] = middle + half;
    }
    Object.assign(this, {low, high});
    this.draw();
  }
  scale() {
    const {width, height} = this.canvas.getBoundingClientRect();
    return Math.min((width - 2 * MARGIN) / (this.high[0] - this.low[0]), (height - 2 * MARGIN) / (this.high[1] - this.low[1]));
  }
  at([x, y]) {
    const {width, height} = this.canvas.getBoundingClientRect(), s = this.scale();
    return [width / 2 + s * (x - (this.low[0] + this.high[0]) / 2), height / 2 - s * (y - (this.low[1] + this.high[1]) / 2)];
  }
  /// The place of W at a point of the canvas.
  placeAt(px, py) {
    const {width, height} = this.canvas.getBoundingClientRect(), s = this.scale();
    return [(px - width / 2) / s + (this.low[0] + this.high[0]) / 2, (height / 2 - py) / s + (this.low[1] + this.high[1]) / 2];
  }
  /// `here`: {p, R, yaw, fov, index}.
  show(here, people, box) {
    Object.assign(this, {here, people, box});
    this.draw();
  }
  click(e) {
    const box = this.canvas.getBoundingClientRect(), x = e.clientX - box.left, y = e.clientY - box.top;
    if (this.onPlace?.(...this.placeAt(x, y))) return;
    let best = -1, least = Infinity;
    this.points.forEach((p, i) => { const [px, py] = this.at(p), d = Math.hypot(px - x, py - y); if (d < least) { least = d; best = i; } });
    if (best >= 0) this.onChoose(best);
  }
  draw() {
    const {width, height} = this.canvas.getBoundingClientRect(), ratio = devicePixelRatio || 1;
    if (!width || !this.points.length) return;
    this.canvas.width = width * ratio;
    this.canvas.height = height * ratio;
    const g = this.canvas.getContext("2d");
    g.scale(ratio, ratio);
    this.drawFlight(g);
    if (this.box) this.drawBox(g);
    g.fillStyle = "#ffb000";
    for (const person of this.people) if (person.position_world) { const [x, y] = this.at(person.position_world); g.fillRect(x - 2, y - 2, 4, 4); }
    for (const mark of this.marks?.() ?? []) this.drawMark(g, mark);
    if (this.here) this.drawHere(g);
    this.drawScale(g, height);
  }
  drawFlight(g) {
    const step = Math.max(1, Math.ceil(this.points.length / MOST_POINTS));
    g.strokeStyle = "#5b8bd0";
    g.fillStyle = "#8ab4f8";
    g.beginPath();
    for (let i = 0; i < this.points.length; i += step) g.lineTo(...this.at(this.points[i]));
    g.stroke();
    if (this.points.length <= 400) for (const p of this.points) { const [x, y] = this.at(p); g.fillRect(x - 1.5, y - 1.5, 3, 3); }
  }
  /// Lines and places over the flight, such as what is drawn by hand: {points, closed, color, dots, radius in metres}.
  drawMark(g, {points, closed, color = "#7ee787", dots = true, radius = 0}) {
    g.strokeStyle = g.fillStyle = color;
    g.beginPath();
    for (const p of points) g.lineTo(...this.at(p));
    if (closed) g.closePath();
    g.stroke();
    if (dots) for (const p of points) { const [x, y] = this.at(p); g.fillRect(x - 2.5, y - 2.5, 5, 5); }
    if (!radius) return;
    g.beginPath();
    g.arc(...this.at(points[0]), radius * this.scale(), 0, 7);
    g.stroke();
  }
  drawBox(g) {
    const [x0, y0] = this.at(this.box.low), [x1, y1] = this.at(this.box.high);
    g.strokeStyle = "#ffff00";
    g.strokeRect(x0 - 1, y1 - 1, Math.max(3, x1 - x0 + 2), Math.max(3, y0 - y1 + 2));
  }
  drawHere(g) {
    const {p, R, yaw, fov} = this.here, [x, y] = this.at(p), d = turn(R, [Math.sin(yaw), 0, Math.cos(yaw)]);
    const heading = Math.atan2(-d[1], d[0]);
    g.fillStyle = "rgba(255,255,255,.35)";
    g.beginPath();
    g.moveTo(x, y);
    g.arc(x, y, 26, heading - fov / 2, heading + fov / 2);
    g.fill();
    g.fillStyle = "#ff5252";
    g.beginPath();
    g.arc(x, y, 4.5, 0, 7);
    g.fill();
  }
  drawScale(g, height) {
    const s = this.scale(), raw = 60 / s, p = 10 ** Math.floor(Math.log10(raw)), metres = raw / p < 2 ? p : raw / p < 5 ? 2 * p : 5 * p;
    g.fillStyle = g.strokeStyle = "#e8eaed";
    g.font = "11px sans-serif";
    g.fillRect(8, height - 8, metres * s, 2);
    g.fillText(`${metres} m`, 8, height - 12);
  }
}
