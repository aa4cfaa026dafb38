// Finding a thing of a live world by its name, and flying to it.
import {cardRows} from "./card.js";
import {matching, nearMisses, parseQuestion} from "./search.js";

const $ = id => document.getElementById(id);
const MOST_FOUND = 12, LOOK_MS = 400;
// Where it is tried: metres away, and above its middle. Beside a thing there may be no room.
const NEAR = [[3, 0], [3, 1], [1.5, 1], [6, 2], [12, 6]];

const middle = ({low, high}) => low.map((v, a) => (v + high[a]) / 2);

export class Finder {
  constructor(live, app) {
    Object.assign(this, {live, app});
    $("find-form").addEventListener("submit", e => { e.preventDefault(); app.guard(this.find($("find-text").value)).catch(() => {}); });
    $("fly-there").addEventListener("click", () => app.guard(this.flying ? this.stop() : this.fly(app.chosenName)).catch(() => {}));
  }
  distance(thing) { return Math.hypot(...middle(thing).map((v, a) => v - this.live.picture.p[a])); }

  async find(text) {
    const entities = await this.live.entities(), {said, words, within} = parseQuestion(text);
    $("found").replaceChildren();
    if (!words.length) return;
    const things = matching(entities, words).filter(id => entities[id].low).map(id => ({id, ...entities[id]}));
    for (const thing of things) thing.far = this.distance(thing);
    const near = things.filter(({far}) => far <= within).sort((a, b) => a.far - b.far);
    if (!things.length) return this.offer(nearMisses(entities, words), said);
    $("find-state").textContent = near.length ? `${near.length} found${near.length > 1 ? ", the nearest first" : ""}` : `The nearest is ${Math.min(...things.map(({far}) => far)).toFixed(0)} m away.`;
    for (const thing of near.slice(0, MOST_FOUND)) this.row(`${thing.name} · ${thing.far.toFixed(0)} m`, () => this.show(thing));
    if (near.length) await this.show(near[0]);
  }
  offer(names, said) {
    $("find-state").textContent = `No thing is called "${said}".${names.length ? " Did you mean:" : ""}`;
    for (const name of names) this.row(name, () => { $("find-text").value = name; return this.find(name); });
  }
  row(text, does) {
    const row = document.createElement("li"), button = document.createElement("button");
    Object.assign(button, {type: "button", textContent: text});
    button.addEventListener("click", () => this.app.guard(does()).catch(() => {}));
    row.append(button);
    $("found").append(row);
  }
  /// As if it were clicked: its card, its box on the map, and a look at it.
  async show({id, ...entity}) {
    this.known = entity;
    const {app} = this, box = {low: entity.low, high: entity.high, known: true, exact: true};
    Object.assign(app, {chosen: id, chosenName: entity.name, box});
    const [x, y] = middle(box);
    app.picked = {id, point: [x, y, entity.low[2]]};
    await app.showCard(cardRows({id, entity, box, distance: this.distance(entity)}), this.live, id);
    app.lookAt();
    await app.refresh();
  }

  /// By a mission, around what is in the way.
  async fly(name) {
    const doc = new DOMParser().parseFromString('<root BTCPP_format="4"><BehaviorTree ID="fly_there"><Sequence><Takeoff/><Fallback/><Look/></Sequence></BehaviorTree></root>', "application/xml");
    for (const [distance, height] of NEAR) {
      const going = doc.createElement("Goto");
      for (const [port, value] of Object.entries({to: name, distance, height})) going.setAttribute(port, value);
      doc.querySelector("Fallback").append(going);
    }
    doc.querySelector("Look").setAttribute("at", name);
    await this.live.ask({do: "fly", xml: new XMLSerializer().serializeToString(doc)});
    this.tell(true, `Flying to ${name} …`);
    while (this.flying) {
      const {result, log} = await this.live.ask({do: "mission"});
      if (result !== "running") return this.arrived(name, result, log);
      await new Promise(done => setTimeout(done, LOOK_MS));
    }
  }
  arrived(name, result, log) {
    this.tell(false, result === "success" ? `There: ${name}` : result === "none" ? "Stopped." : `It cannot fly to ${name}: ${log.at(-1)?.replace(/^.*?: /, "") ?? result}`);
    if (result === "success" && this.app.chosenName === name && this.app.box?.exact) return this.show({id: this.app.chosen, ...this.known});
  }
  async stop() {
    if (!this.flying) return;
    this.tell(false, "Stopped.");
    await this.live.ask({do: "stop"});
  }
  tell(flying, text) {
    this.flying = flying;
    $("fly-there").textContent = flying ? "Stop" : "Fly there";
    $("fly-state").textContent = text;
  }
}
