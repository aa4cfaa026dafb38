// Areas, people and routes drawn on the map: written as the YAML that the commands read, and checked by the code that reads it.
const $ = id => document.getElementById(id);
const round = v => Math.round(v * 100) / 100;

export class Drawing {
  constructor(live, map) {
    Object.assign(this, {live, map, areas: [], people: [], route: [], order: []});
    map.onPlace = (x, y) => { if ($("drawing").open) this.add(x, y); return $("drawing").open; };
    map.marks = () => ($("drawing").open ? this.marks() : []);
    $("drawing").addEventListener("toggle", () => map.draw());
    $("draw-kind").addEventListener("change", () => this.write());
    $("draw-here").addEventListener("click", () => { const [x, y] = this.live.picture.p; this.add(x, y); });
    $("draw-next").addEventListener("click", () => { this.areas.push({count: Number($("draw-count").value), points: []}); });
    $("draw-undo").addEventListener("click", () => this.undo());
    $("draw-save").addEventListener("click", () => this.save());
  }
  add(x, y) {
    const kind = $("draw-kind").value, p = [round(x), round(y)];
    if (kind === "area") {
      if (!this.areas.length) this.areas.push({count: 0, points: []});
      const area = this.areas.at(-1);
      area.count = Number($("draw-count").value);
      area.points.push(p);
      this.order.push(() => { area.points.pop(); if (!area.points.length) this.areas.splice(this.areas.indexOf(area), 1); });
    } else if (kind === "person") {
      this.people.push(p);
      this.order.push(() => this.people.pop());
    } else {
      this.route.push([...p, Number($("draw-height").value)]);
      this.order.push(() => this.route.pop());
    }
    this.write();
  }
  undo() {
    this.order.pop()?.();
    this.write();
  }
  isRoute() { return $("draw-kind").value === "route"; }
  text() {
    if (this.isRoute()) return this.route.length ? `waypoints:\n${this.route.map(([x, y, z]) => `  - {x: ${x}, y: ${y}, z: ${z}}\n`).join("")}` : "";
    const whole = this.areas.filter(({points}) => points.length > 2);
    const areas = whole.map(({count, points}, i) => `  - name: area ${i + 1}\n    polygon: [${points.map(([x, y]) => `[${x}, ${y}]`).join(", ")}]\n    count: ${count}\n`);
    const people = this.people.map(([x, y], i) => `  - {name: drawn ${i + 1}, at: [${x}, ${y}]}\n`);
    return (areas.length ? `areas:\n${areas.join("")}` : "") + (people.length ? `people:\n${people.join("")}` : "");
  }
  async write() {
    const text = $("draw-text").value = this.text(), state = $("draw-state");
    this.map.draw();
    state.textContent = "";
    if (!text) return;
    try {
      const {done} = await this.live.ask({do: "draw", kind: this.isRoute() ? "route" : "people", text});
      if (text === $("draw-text").value) state.textContent = `Valid: ${done}.`;
    } catch (error) {
      if (text === $("draw-text").value) state.textContent = error.message;
    }
  }
  marks() {
    return [...this.areas.map(({points}) => ({points, closed: points.length > 2})), ...this.people.map(p => ({points: [p]})), {points: this.route, closed: false}];
  }
  save() {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.text()], {type: "application/yaml"}));
    link.download = this.isRoute() ? "route.yaml" : "people.yaml";
    link.click();
    URL.revokeObjectURL(link.href);
  }
}
