// One picture on the screen: drawing, looking around by mouse, touch and keys, and what is drawn over it in lines.
import {Painter} from "./painter.js";
import {pointOfRay} from "./sphere.js";

const SVG = "http://www.w3.org/2000/svg";
// COCO-17.
const BONES = [[5, 7], [7, 9], [6, 8], [8, 10], [5, 6], [5, 11], [6, 12], [11, 12], [11, 13], [13, 15], [12, 14], [14, 16], [0, 1], [0, 2], [1, 3], [2, 4]];
const MOVING_FINENESS = 1.5;  // points of the canvas for one pixel of the picture
const KEY_STEP = 0.12, CLICK_SLACK = 4, ARROW_SPACING = 44, MOST_ARROW = 60;

export class Panorama {
  /// `onPick(x, y)`: a pixel was clicked; `onLook()`: one looks elsewhere.
  constructor(box, look, {onPick, onLook}) {
    Object.assign(this, {box, look, onPick, onLook, people: [], flow: null, signs: [], panoramic: true, flat: false, pointers: new Map()});
    this.canvas = box.querySelector("canvas");
    this.lines = box.querySelector("svg");
    this.painter = new Painter(this.canvas);
    new ResizeObserver(() => this.resize()).observe(box);
    this.canvas.addEventListener("pointerdown", e => this.down(e));
    this.canvas.addEventListener("pointermove", e => this.move(e));
    for (const name of ["pointerup", "pointercancel"]) this.canvas.addEventListener(name, e => this.up(e));
    this.canvas.addEventListener("wheel", e => { e.preventDefault(); this.zoom(Math.exp(0.001 * e.deltaY)); }, {passive: false});
    this.canvas.addEventListener("keydown", e => this.key(e));
    this.resize();
  }
  get size() { return this.painter.size; }

  resize() {
    const {width, height} = this.box.getBoundingClientRect();
    if (!width || !height) return;
    Object.assign(this.look, {width, height});
    this.draw();
  }
  zoom(factor) { this.turnTo(this.look.yaw, this.look.pitch, this.look.fov * factor); }
  turnTo(yaw, pitch, fov) {
    this.look.set(yaw, pitch, fov);
    this.onLook();
  }
  radiansOfPixel() { return this.look.flat ? 2 * Math.PI / this.size[0] / this.look.scale(...this.size) : 1 / this.look.focal(); }

  place(e) {
    const box = this.canvas.getBoundingClientRect();
    return [e.clientX - box.left, e.clientY - box.top];
  }
  down(e) {
    this.canvas.setPointerCapture(e.pointerId);
    this.pointers.set(e.pointerId, this.place(e));
    if (this.pointers.size === 1) this.press = this.place(e);
    else this.press = null;
  }
  move(e) {
    const before = this.pointers.get(e.pointerId);
    if (!before) return;
    const now = this.place(e);
    if (this.pointers.size === 2) {
      const [other] = [...this.pointers].filter(([id]) => id !== e.pointerId).map(([, at]) => at);
      const apart = at => Math.hypot(at[0] - other[0], at[1] - other[1]);
      this.zoom(apart(before) / Math.max(1, apart(now)));
    } else if (!this.press || Math.hypot(now[0] - this.press[0], now[1] - this.press[1]) > CLICK_SLACK) {
      this.press = null;
      const k = this.radiansOfPixel();
      this.turnTo(this.look.yaw - k * (now[0] - before[0]), this.look.pitch + k * (now[1] - before[1]));
    } else {
      return;
    }
    this.pointers.set(e.pointerId, now);
  }
  up(e) {
    if (!this.pointers.delete(e.pointerId)) return;
    if (e.type === "pointerup" && this.press) this.pick(...this.place(e));
    this.press = null;
  }
  pick(sx, sy) {
    const pixel = this.look.pixelAt(sx, sy, ...this.size, this.panoramic);
    if (pixel) this.onPick(...pixel);
  }
  key(e) {
    const {look} = this, step = KEY_STEP * look.fov;
    const turns = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step]};
    if (e.ctrlKey || e.altKey || e.metaKey) return;
    if (turns[e.key]) this.turnTo(look.yaw + turns[e.key][0], look.pitch + turns[e.key][1]);
    else if (e.key === "+" || e.key === "=") this.zoom(0.85);
    else if (e.key === "-") this.zoom(1 / 0.85);
    else if (e.key === "Home") this.turnTo(0, 0, 1.3);
    else if (e.key === "Enter") this.pick(look.width / 2, look.height / 2);
    else return;
    e.preventDefault();
    e.stopPropagation();
  }

  setPicture(bitmap, panoramic) {
    this.panoramic = panoramic;
    this.look.flat = this.flat || !panoramic;
    this.painter.setColor(bitmap);
  }
  setOverlay(overlay) { this.painter.setOverlay(overlay); }

  /// Points of the canvas for one CSS pixel: those of the screen; of a moving picture not many more than it has pixels, which a
  /// weak machine would draw for nothing.
  fineness() {
    const screen = Math.min(2, devicePixelRatio || 1);
    return this.moving ? Math.min(screen, MOVING_FINENESS * this.radiansOfPixel() * this.size[0] / (2 * Math.PI)) : screen;
  }
  fit() {
    const fineness = this.fineness(), {width, height} = this.look, [w, h] = [width, height].map(side => Math.max(1, Math.round(side * fineness)));
    if (this.canvas.width !== w || this.canvas.height !== h) Object.assign(this.canvas, {width: w, height: h});
  }
  draw() {
    cancelAnimationFrame(this.waiting);
    this.waiting = requestAnimationFrame(() => this.paint());
  }
  paint() {
    this.look.flat = this.flat || !this.panoramic;
    this.fit();
    this.painter.draw(this.look, this.panoramic);
    this.drawLines();
  }
  screenOf(x, y) { return this.look.screenOf(x, y, ...this.size, this.panoramic); }
  add(name, attributes, text) {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    if (text) element.textContent = text;
    this.lines.append(element);
  }
  drawLines() {
    if (this.lines.childElementCount) this.lines.replaceChildren();  // an empty drawing is not laid out anew
    for (const person of this.people) this.drawPerson(person);
    if (this.flow) this.drawFlow();
    for (const sign of this.signs) this.drawSign(sign);
  }
  /// A place of the world: a ring and what is said of it.
  drawSign({ray, text}) {
    const at = this.screenOf(...pointOfRay(ray, ...this.size));
    if (!at) return;
    this.add("circle", {cx: at[0], cy: at[1], r: 9, class: "sign"});
    this.add("text", {x: at[0], y: at[1] - 14, class: "tag"}, text);
  }
  drawPerson({keypoints, track_id, behaviour, locomotion, area}) {
    if (!keypoints || !(area > 0)) return;
    const places = [];
    for (let k = 0; k < 17; ++k) places.push(keypoints[3 * k + 2] ? this.screenOf(keypoints[3 * k], keypoints[3 * k + 1]) : null);
    for (const [a, b] of BONES) {
      if (!places[a] || !places[b] || Math.hypot(places[a][0] - places[b][0], places[a][1] - places[b][1]) > this.look.height) continue;
      const seen = keypoints[3 * a + 2] === 2 && keypoints[3 * b + 2] === 2;
      this.add("line", {x1: places[a][0], y1: places[a][1], x2: places[b][0], y2: places[b][1], class: seen ? "bone" : "bone hidden-bone"});
    }
    const top = places.filter(Boolean).sort((a, b) => a[1] - b[1])[0];
    if (top) this.add("text", {x: top[0], y: top[1] - 8, class: "tag"}, [`#${track_id}`, ...new Set([locomotion, behaviour])].filter(Boolean).join(" "));
  }
  drawFlow() {
    const {width, height, planes: {dx, dy}} = this.flow;
    for (let sy = ARROW_SPACING / 2; sy < this.look.height; sy += ARROW_SPACING) {
      for (let sx = ARROW_SPACING / 2; sx < this.look.width; sx += ARROW_SPACING) {
        const pixel = this.look.pixelAt(sx, sy, width, height, this.panoramic);
        if (!pixel) continue;
        const i = pixel[1] * width + pixel[0];
        const from = this.screenOf(pixel[0] + 0.5, pixel[1] + 0.5), to = this.screenOf(pixel[0] + 0.5 + dx[i], pixel[1] + 0.5 + dy[i]);
        if (!from || !to) continue;
        const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
        if (length < 1 || length > this.look.width / 2) continue;
        const k = Math.min(1, MOST_ARROW / length);
        this.add("line", {x1: from[0], y1: from[1], x2: from[0] + k * (to[0] - from[0]), y2: from[1] + k * (to[1] - from[1]), class: "flow", "marker-end": "url(#arrow)"});
      }
    }
  }
}
