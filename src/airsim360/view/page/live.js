// A world that is flown: asks for one picture after the other, with what the hands do.
import {Drawing} from "./draw.js";
import {readMessage} from "./message.js";
import {matrixOf} from "./sphere.js";
import {TreeEditor} from "./trees.js";

// Key -> which of forward, left, up, turn left, and which way.
const KEYS = {w: [0, 1], s: [0, -1], a: [1, 1], d: [1, -1], r: [2, 1], f: [2, -1], q: [3, 1], e: [3, -1]};
const PAD = [["q", "Turn left", "↺"], ["w", "Forward", "▲"], ["e", "Turn right", "↻"], ["r", "Up", "⤒"],
             ["a", "Left", "◀"], ["s", "Back", "▼"], ["d", "Right", "▶"], ["f", "Down", "⤓"]];
const GONE = "the server is gone: start 'airsim360 view' again";
const DEAD_ZONE = 0.12, RETRY_MS = 1000, SPEEDS = 4, PATH_POINTS = 3000;

// A picture of the stream, with the same questions as a recorded one.
class LivePicture {
  constructor(live, {header, planes}, bitmap) {
    Object.assign(this, {live, number: header.number, p: header.p, R: matrixOf(header.q), planes, shown: bitmap, panoramic: true});
  }
  async bitmap() { return this.shown; }
  async people() { return []; }
  // One question for all of them: the server forgets pictures while others follow.
  async plane(product) {
    if (!this.planes[product]) await (this.coming ??= this.live.ask({do: "planes", number: this.number}).then(({planes}) => Object.assign(this.planes, planes)));
    return this.planes[product] ?? null;
  }
}

// A WebSocket: answers come in the order of the questions.
class Line {
  static open() {
    const address = new URL("live", location.href), line = new Line();
    address.protocol = address.protocol.replace("http", "ws");
    address.hash = "";
    line.waiting = [];
    line.socket = new WebSocket(address);
    line.socket.binaryType = "arraybuffer";
    line.socket.onclose = () => { for (const {reject} of line.waiting.splice(0)) reject(new Error(GONE)); };
    line.socket.onmessage = ({data}) => line.answered(data);
    return new Promise((resolve, reject) => {
      line.socket.onopen = () => resolve(line);
      line.socket.onerror = () => reject(new Error(GONE));
    });
  }
  get open() { return this.socket.readyState === WebSocket.OPEN; }
  answered(data) {
    const {resolve, reject} = this.waiting.shift();
    if (typeof data !== "string") return resolve(readMessage(data));
    const said = JSON.parse(data);
    said.error ? reject(new Error(said.error)) : resolve(said);
  }
  ask(message) {
    return new Promise((resolve, reject) => {
      if (!this.open) return reject(new Error(GONE));
      this.waiting.push({resolve, reject});
      this.socket.send(JSON.stringify(message));
    });
  }
}

export class Live {
  /// `flies`: the hands may steer; `follows`: the world is in another server, which passes its time and has its own light.
  constructor({token, world, seed, categories, weathers, keeps, flies, follows, resets}, box, app) {
    Object.assign(this, {token, world, seed, app, flies, follows, resets, held: new Set(), path: [], width: 1024, speed: 0.3, frames: []});
    this.categories = new Map(categories.map(c => [c.id, c]));
    this.controls(box, weathers, keeps);
    for (const id of ["trees", "drawing"]) document.getElementById(id).hidden = follows;
    if (follows) return;
    this.trees = new TreeEditor(this);
    this.drawing = new Drawing(this, app.map);
  }
  async start() {
    this.named = await (await fetch("entities.json")).json();
    this.peopled = false;
    await this.connect();
    this.run();
  }
  entities() { return this.named; }
  /// Buttons that send and bring people, and put vehicles, to the point that was clicked; nothing in worlds without them.
  async offerPlacing() {
    if (this.follows || this.peopled) return;
    this.peopled = true;
    await this.offerCars();
    const {people} = await this.ask({do: "trees"}), $ = id => document.getElementById(id);
    if (!people.length) return;
    for (const {name} of people) $("placed-person").append(new Option(name, name));
    for (const [id, action] of [["person-send", "send"], ["person-bring", "bring"], ["person-remove", "remove"]])
      $(id).addEventListener("click", () => this.app.guard(this.place(action, $("placed-person").value)).catch(() => {}));
    $("person-tools").hidden = false;
  }
  async offerCars() {
    const {cars} = await this.ask({do: "cars"}), $ = id => document.getElementById(id);
    if (!cars.length) return;
    for (const {name, kind} of cars) $("placed-car").append(new Option(`${name} · ${kind.split("/").at(-1)}`, name));
    $("car-bring").addEventListener("click", () => this.app.guard(this.putCar($("placed-car").value)).catch(() => {}));
    $("car-tools").hidden = false;
  }
  async putCar(car) {
    await this.ask({do: "car", car, point: this.app.picked.point});
    this.app.say(`${car} stands there and drives on`);
  }
  async place(action, person) {
    await this.ask({do: "person", action, person, point: this.app.picked.point});
    this.app.say(`${person}: ${action}`);
  }

  // Two lines to the server, so that pictures do not wait for what takes long.
  async connect() {
    [this.stream, this.talk] = await Promise.all([Line.open(), Line.open()]);
  }
  ask(message) { return this.talk.ask({...message, token: this.token}); }

  // The next picture is asked for before this one is drawn, so that the renderer never waits for the page.
  async run() {
    let coming = this.nextPicture();
    for (;;) {
      try {
        const [message, asked] = await coming;
        coming = this.nextPicture();
        await this.show(message, asked);
      } catch (error) {
        this.app.guard(Promise.reject(error)).catch(() => {});
        await new Promise(done => setTimeout(done, RETRY_MS));
        if (!this.stream.open) await this.connect().catch(() => {});
        coming = this.nextPicture();
      }
    }
  }
  nextPicture() {
    const asked = performance.now();
    const coming = this.stream.ask({do: "picture", width: this.width, products: this.wantedProducts(), input: this.flies ? this.input() : undefined, token: this.token}).then(message => [message, asked]);
    coming.catch(() => {});  // told where it is awaited
    return coming;
  }
  wantedProducts() {
    const names = new Set(this.app.product ? [this.app.product] : []), {filter, chosen} = this.app;
    if (filter.hidden.size || filter.people) names.add("semantic");
    if (filter.height[0] > -Infinity || filter.height[1] < Infinity) names.add("range");
    if (chosen) names.add("entity");
    return [...names];
  }
  async show(message, asked) {
    const bitmap = await createImageBitmap(message.jpeg, {colorSpaceConversion: "none", premultiplyAlpha: "none"});
    const before = this.picture;
    this.picture = new LivePicture(this, message, bitmap);
    await this.app.draw(++this.app.turn);
    before?.shown.close();
    this.tell(message.header, performance.now() - asked);
  }
  tell(header, ms) { this.follows ? this.tellFollowed(header, ms) : this.tellFlown(header, ms); this.notePath(); }
  countRate() {
    this.frames.push(performance.now());
    while (this.frames[0] < performance.now() - 3000) this.frames.shift();
    return this.frames.length / 3;
  }
  tellFollowed({t, episode, instruction, step, end, distance, goal, score}, ms) {
    this.figures = {ms, rate: this.countRate()};
    const task = episode ? ` · episode ${episode}, ${step} actions, ${distance.toFixed(1)} m from the goal${end === "running" ? "" : ` · ${end}, ${score?.success ? "success" : "failure"}`}` : "";
    this.state.textContent = `${this.flies ? "flying" : "looking on"} · ${this.figures.rate.toFixed(1)} pictures/s · time ${t.toFixed(1)} s${task}`;
    this.task.textContent = instruction ?? "";
    this.goal = goal;
    if (episode !== this.episode) this.enter(episode);
  }
  /// Another episode: its world may be another one, its way begins here.
  enter(episode) {
    this.episode = episode;
    this.path = [];
    fetch("entities.json").then(said => said.json()).then(named => { this.named = named; }).catch(() => {});
  }
  signs() { return this.goal ? [{p: this.goal, text: "goal"}] : this.drawing?.signs() ?? []; }
  tellFlown({v, render_ms, collisions, touched, kept, charge}, ms) {
    this.figures = {ms, render_ms, rate: this.countRate()};
    this.state.textContent = `${Math.hypot(...v).toFixed(1)} m/s · ${this.figures.rate.toFixed(1)} pictures/s (${render_ms.toFixed(0)} ms rendering) · battery ${Math.round(100 * charge)} %` +
      (collisions ? ` · touched ${touched ?? "something"} (${collisions})` : "");
    this.keptCount = kept;
    if (this.save) this.save.textContent = `Save ${kept} frames`;
  }
  notePath() {
    const {p} = this.picture, last = this.path.at(-1);
    if (!last || Math.hypot(p[0] - last[0], p[1] - last[1]) > 0.25) {
      this.path.push(p);
      if (this.path.length > PATH_POINTS) this.path.shift();
      this.app.map.setFlight(this.path);
    }
  }

  // Hands.

  input() {
    const sum = [0, 0, 0, 0];
    for (const key of this.held) { const [axis, way] = KEYS[key]; sum[axis] += way * (axis === 3 ? 0.6 : this.speed); }
    for (const pad of navigator.getGamepads?.() ?? []) {
      if (!pad) continue;
      const [turn, up, side, ahead] = pad.axes.map(v => Math.abs(v) < DEAD_ZONE ? 0 : v);
      sum[0] -= (ahead ?? 0) * this.speed * 2;
      sum[1] -= (side ?? 0) * this.speed * 2;
      sum[2] -= (up ?? 0) * this.speed;
      sum[3] -= turn ?? 0;
    }
    return sum.map(v => Math.max(-1, Math.min(1, v)));
  }
  key(e, down) {
    const key = e.key.toLowerCase();
    if (!KEYS[key] || !this.flies) return false;
    down ? this.held.add(key) : this.held.delete(key);
    return true;
  }
  controls(box, weathers, keeps) {
    const {flies, follows, resets} = this;
    addEventListener("keyup", e => this.key(e, false));
    addEventListener("blur", () => this.held.clear());
    if (flies) box.append(this.pad(), this.slider("Speed", 1, SPEEDS * 4, 1, 5, value => { this.speed = value / 16; }));
    if (!follows) box.append(this.choice("Weather", ["the world's own", ...weathers], value => this.set({weather: value === "the world's own" ? "" : value})),
               this.slider("Hour", 0, 24, 0.5, 12, value => this.set({hour: value})),
               this.choice("Size", ["512", "1024", "2048", "4096"], value => { this.width = Number(value); }, "1024"));
    if (resets) box.append(this.button("To the start", () => this.ask({do: "reset"})));
    if (keeps) {
      this.save = this.button("Save 0 frames", async () => { const said = await this.ask({do: "save"}); this.app.say(`Saved ${said.frames} frames in ${said.folder}`); this.note.textContent = `saved: ${said.folder}`; });
      this.note = document.createElement("span");
      box.append(this.button("Keep this frame", () => this.ask({do: "keep"})), this.save, this.note);
    }
    this.state = document.createElement("output");
    this.task = document.createElement("p");
    box.append(this.state, this.task);
  }
  set(message) {
    clearTimeout(this.setting);
    this.setting = setTimeout(() => this.app.guard(this.ask({do: "set", ...message})).catch(() => {}), 250);
  }
  pad() {
    const pad = document.createElement("div");
    pad.className = "pad";
    for (const [key, name, sign] of PAD) {
      const button = this.button(sign, () => {});
      button.setAttribute("aria-label", name);
      button.addEventListener("pointerdown", e => { button.setPointerCapture(e.pointerId); this.held.add(key); });
      for (const end of ["pointerup", "pointercancel"]) button.addEventListener(end, () => this.held.delete(key));
      button.addEventListener("keydown", e => { if (e.key === " " || e.key === "Enter") this.held.add(key); });
      for (const end of ["keyup", "blur"]) button.addEventListener(end, () => this.held.delete(key));
      pad.append(button);
    }
    return pad;
  }
  button(text, does) {
    const button = document.createElement("button");
    Object.assign(button, {type: "button", textContent: text});
    button.addEventListener("click", () => this.app.guard(does()).catch(() => {}));
    return button;
  }
  labelled(text, input) {
    const label = document.createElement("label");
    label.append(text, " ", input);
    return label;
  }
  choice(text, values, does, chosen) {
    const select = document.createElement("select");
    for (const value of values) select.append(new Option(value, value));
    if (chosen) select.value = chosen;
    select.addEventListener("change", () => does(select.value));
    return this.labelled(text, select);
  }
  slider(text, min, max, step, value, does) {
    const input = document.createElement("input"), out = document.createElement("output"), label = this.labelled(text, input);
    Object.assign(input, {type: "range", min, max, step, value});
    input.addEventListener("input", () => { out.textContent = input.value; does(Number(input.value)); });
    label.append(out);
    return label;
  }
}
