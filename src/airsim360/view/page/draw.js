// Areas, people, routes, cameras, labels and lamps drawn in the view: written as the YAML that the commands read, and checked by
// the code that reads it.
const $ = id => document.getElementById(id);
const round = v => Math.round(v * 100) / 100;
const quoted = text => JSON.stringify(text);
const DEGREES = 180 / Math.PI;

// Kind -> the file that it goes to, the flag that reads it, and what the drawing needs.
const FILES = {area: "people", person: "people", route: "route", camera: "cameras", label: "labels", lamp: "world"};
const NAMES = {people: "people.yaml", route: "route.yaml", cameras: "rig.yaml", labels: "labels.yaml", world: "world.yaml"};
const FLAGS = {people: "--people people.yaml", route: "collect --route route.yaml", cameras: "--cameras rig.yaml", labels: "--labels labels.yaml", world: "--world world.yaml"};
const HINTS = {area: "Click on the map, or add where the drone is.", person: "Click on the map, or add where the drone is.", route: "Click on the map, or add where the drone is.",
               camera: "Look where the camera shall look, zoom to its field of view, and add it: it hangs on the drone.",
               label: "Click a thing in the picture, say what it is, and add it. * in the name stands for anything.",
               lamp: "Click on the map, or add where the drone is. Lamps burn by night unless they always do; the world file shows them."};

export class Drawing {
  constructor(live, map) {
    Object.assign(this, {live, map, areas: [], people: [], route: [], cameras: [], rules: [], lamps: [], order: [], undone: []});
    map.onPlace = (x, y) => { if (!$("drawing").open || !this.onMap()) return false; this.add(x, y); return true; };
    map.marks = () => ($("drawing").open ? this.marks() : []);
    $("drawing").addEventListener("toggle", () => map.draw());
    $("draw-kind").addEventListener("change", () => this.offer());
    $("draw-here").addEventListener("click", () => this.addHere());
    $("draw-next").addEventListener("click", () => this.do(() => { this.areas.push({count: Number($("draw-count").value), points: []}); return () => this.areas.pop(); }));
    $("draw-undo").addEventListener("click", () => this.undo());
    $("draw-redo").addEventListener("click", () => this.redo());
    $("draw-save").addEventListener("click", () => this.save());
    this.offer();
  }
  get kind() { return $("draw-kind").value; }
  get file() { return FILES[this.kind]; }
  onMap() { return this.kind !== "camera" && this.kind !== "label"; }

  /// The fields that a kind has.
  offer() {
    for (const field of document.querySelectorAll("#drawing [data-kinds]")) field.hidden = !field.dataset.kinds.split(" ").includes(this.kind);
    $("draw-hint").textContent = HINTS[this.kind];
    $("draw-here").textContent = {camera: "Add as one looks", label: "Add the rule"}[this.kind] ?? "Add where the drone is";
    this.write();
  }
  /// A thing was clicked: its name is what a rule begins with.
  picked(name) { $("draw-match").value = name; }

  // Each addition says how it is taken back; what was taken back can be done again.

  do(make) {
    this.order.push({make, back: make()});
    this.undone = [];
    this.write();
  }
  undo() {
    const last = this.order.pop();
    if (last) { last.back(); this.undone.push(last); }
    this.write();
  }
  redo() {
    const next = this.undone.pop();
    if (next) this.order.push({make: next.make, back: next.make()});
    this.write();
  }
  put(list, thing) { this.do(() => { list.push(thing); return () => list.pop(); }); }

  addHere() {
    const [x, y, z] = this.live.picture.p;
    if (this.kind === "camera") this.addCamera();
    else if (this.kind === "label") this.addRule();
    else this.add(x, y, z);
  }
  add(x, y, z) {
    const p = [round(x), round(y)], height = Number($("draw-height").value);
    if (this.kind === "area") this.addCorner(p, Number($("draw-count").value));
    else if (this.kind === "person") this.put(this.people, p);
    else if (this.kind === "route") this.put(this.route, [...p, round(z ?? height)]);
    else this.put(this.lamps, {p: [...p, round(z ?? height)], lumens: Number($("draw-lumens").value), kelvin: Number($("draw-kelvin").value), always: $("draw-always").checked});
  }
  addCorner(p, count) {
    this.do(() => {
      if (!this.areas.length) this.areas.push({count: 0, points: []});
      const area = this.areas.at(-1), before = area.count;
      area.count = count;
      area.points.push(p);
      return () => { area.points.pop(); area.count = before; if (!area.points.length) this.areas.splice(this.areas.indexOf(area), 1); };
    });
  }
  /// Pictures are level and turned as the drone is, so that where one looks in them is where a camera on it looks.
  addCamera() {
    const {yaw, pitch, fov, width, height} = this.live.app.main.look;
    const across = 2 * Math.atan(Math.tan(fov / 2) * width / height) * DEGREES;
    const name = $("draw-camera").value.trim() || `camera_${this.cameras.length + 1}`;
    this.put(this.cameras, {name, fov: Math.min(170, round(across)), yaw: round(-yaw * DEGREES), pitch: round(pitch * DEGREES), size: $("draw-size").value});
    $("draw-camera").value = "";
  }
  addRule() { this.put(this.rules, {match: $("draw-match").value, category: $("draw-category").value.trim(), name: $("draw-name").value.trim()}); }

  // YAML.

  text() { return {people: () => this.peopleText(), route: () => this.routeText(), cameras: () => this.rigText(), labels: () => this.labelText(), world: () => this.worldText()}[this.file](); }
  peopleText() {
    const whole = this.areas.filter(({points}) => points.length > 2);
    const areas = whole.map(({count, points}, i) => `  - name: area ${i + 1}\n    polygon: [${points.map(([x, y]) => `[${x}, ${y}]`).join(", ")}]\n    count: ${count}\n`);
    const people = this.people.map(([x, y], i) => `  - {name: drawn ${i + 1}, at: [${x}, ${y}]}\n`);
    return (areas.length ? `areas:\n${areas.join("")}` : "") + (people.length ? `people:\n${people.join("")}` : "");
  }
  routeText() { return this.route.length ? `waypoints:\n${this.route.map(([x, y, z]) => `  - {x: ${x}, y: ${y}, z: ${z}}\n`).join("")}` : ""; }
  rigText() {
    return this.cameras.length ? `cameras:\n${this.cameras.map(({name, size, fov, yaw, pitch}) => `  - {name: ${quoted(name)}, projection: pinhole, size: ${size}, fov_deg: ${fov}, yaw_deg: ${yaw}, pitch_deg: ${pitch}}\n`).join("")}` : "";
  }
  labelText() {
    return this.rules.length ? `rules:\n${this.rules.map(({match, category, name}) => `  - match: ${quoted(match)}\n${category ? `    category: ${category}\n` : ""}${name ? `    name: ${quoted(name)}\n` : ""}`).join("")}` : "";
  }
  worldText() {
    if (!this.lamps.length) return "";
    const {source, source_text: own} = this.live;
    const lamp = ({p: [x, y, z], lumens, kelvin, always}) => `  - {x: ${x}, y: ${y}, z: ${z}, lumens: ${lumens}, kelvin: ${kelvin}${always ? ", always: true" : ""}}\n`;
    const lamps = `lamps:\n${this.lamps.map(lamp).join("")}`;
    // Of a world file: what it says already, and the lamps with those that it has.
    if (own) return /^lamps:\s*$/m.test(own) ? own.replace(/^lamps:\s*\n/m, lamps) : `${own.replace(/\n*$/, "\n")}${lamps}`;
    return `world: ${/^\w+$/.test(source) ? source : quoted(source)}\nseed: ${this.live.seed}\n${lamps}`;
  }
  async write() {
    const text = $("draw-text").value = this.text(), state = $("draw-state"), {file} = this;
    this.map.draw();
    $("draw-undo").disabled = !this.order.length;
    $("draw-redo").disabled = !this.undone.length;
    $("draw-save").disabled = !text;
    state.textContent = "";
    if (!text) return;
    let said;
    try {
      said = `Valid: ${(await this.live.ask({do: "draw", kind: file, text})).done}. Commands read it with ${FLAGS[file]}.`;
    } catch (error) {
      said = error.message;
    }
    if (text === $("draw-text").value) state.textContent = said;
  }
  marks() {
    return [...this.areas.map(({points}) => ({points, closed: points.length > 2})), ...this.people.map(p => ({points: [p]})), {points: this.route, closed: false},
            ...this.lamps.map(({p}) => ({points: [p], color: "#ffd166", radius: 1}))];
  }
  /// Lamps hang in the picture before the world has them.
  signs() { return $("drawing").open ? this.lamps.map(({p}) => ({p, text: "lamp"})) : []; }
  save() {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.text()], {type: "application/yaml"}));
    link.download = NAMES[this.file];
    link.click();
    URL.revokeObjectURL(link.href);
  }
}
