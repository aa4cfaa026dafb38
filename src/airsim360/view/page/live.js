// A world that is flown: asks for one picture after the other, with what the hands do.
import {Drawing} from "./draw.js";
import {Finder} from "./find.js";
import {readMessage} from "./message.js";
import {matrixOf} from "./sphere.js";
import {TreeEditor} from "./trees.js";

// Key -> which of forward, left, up, turn left, and which way.
const KEYS = {w: [0, 1], s: [0, -1], a: [1, 1], d: [1, -1], r: [2, 1], f: [2, -1], q: [3, 1], e: [3, -1]};
const PAD = [["q", "Turn left", "↺"], ["w", "Forward", "▲"], ["e", "Turn right", "↻"], ["r", "Up", "⤒"],
             ["a", "Left", "◀"], ["s", "Back", "▼"], ["d", "Right", "▶"], ["f", "Down", "⤓"]];
const GONE = "the server is gone: start 'airsim360 view' again";
const DEAD_ZONE = 0.12, RETRY_MS = 1000, SPEEDS = 4, PATH_POINTS = 3000;
const TELL_MS = 200;  // between two looks at figures, map and legend
const WAIT_MS = 3;  // for a picture: who waits longer is faster than the renderer

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
  constructor({token, world, seed, source, source_text, categories, weathers, keeps, flies, follows, resets}, box, app) {
    Object.assign(this, {token, world, seed, source, source_text, app, flies, follows, resets, held: new Set(), path: [], width: 1024, speed: 0.3, frames: []});
    this.categories = new Map(categories.map(c => [c.id, c]));
    this.controls(box, weathers, keeps);
    for (const id of ["trees", "drawing", "finding"]) document.getElementById(id).hidden = follows;
    if (follows) return;
    this.trees = new TreeEditor(this);
    this.drawing = new Drawing(this, app.map);
    this.finder = new Finder(this, app);
  }
  async start() {
    this.peopled = false;
    await this.connect();
    this.run();
  }
  /// Names of a large world are megabytes: they come after the first picture.
  entities() {
    return this.named ??= fetch("entities.json").then(said => said.json()).catch(error => { this.named = null; throw error; });
  }
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

  // Lines to the server on which nothing waits for something else: pictures, what the hands do, and the rest. Pictures have two,
  // so that one is rendered while the other travels; a world elsewhere is asked for one at a time.
  async connect() {
    const streams = this.follows ? 1 : 2, [talk, hands, ...stream] = await Promise.all(Array.from({length: 2 + streams}, () => Line.open()));
    Object.assign(this, {talk, hands, stream, wait: 0, asked: 0});
  }
  ask(message) { return this.talk.ask({...message, token: this.token}); }

  // The next picture is asked for before this one is drawn, so that the renderer never waits for the page.
  async run() {
    let coming = [];
    for (;;) {
      try {
        this.askAhead(coming);
        const since = performance.now(), [message, asked] = await coming.shift();
        this.wait = 0.8 * this.wait + 0.2 * (performance.now() - since);
        this.askAhead(coming);
        this.steer();
        await this.show(message, asked);
        this.entities().catch(() => {});
      } catch (error) {
        this.app.guard(Promise.reject(error)).catch(() => {});
        await new Promise(done => setTimeout(done, RETRY_MS));
        if (!this.stream.every(line => line.open)) await this.connect().catch(() => {});
        coming = [];
      }
    }
  }
  /// One picture ahead of the one that is rendered, unless the page is the slower one: there they would only grow old.
  askAhead(coming) {
    const most = this.wait > WAIT_MS ? this.stream.length : 1;
    while (coming.length < most) coming.push(this.nextPicture());
  }
  nextPicture() {
    const asked = performance.now(), input = this.follows && this.flies ? this.input() : undefined, line = this.stream[this.asked++ % this.stream.length];
    const coming = line.ask({do: "picture", width: this.width, products: this.wantedProducts(), input, token: this.token}).then(message => [message, asked]);
    coming.catch(() => {});  // told where it is awaited
    return coming;
  }
  /// What the hands do counts for the next picture that is rendered, also for one that was asked for before.
  steer() {
    if (this.follows || !this.flies || !this.hands?.open) return;
    this.steered = (this.steered ?? 0) + 1;
    this.hands.ask({do: "hands", input: this.input(), number: this.steered, token: this.token}).catch(() => {});
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
    const now = performance.now(), aside = !(now - this.toldAt < TELL_MS);
    if (aside) this.toldAt = now;
    await this.app.draw(++this.app.turn, aside);
    before?.shown.close();
    this.tell(message.header, performance.now() - asked, aside);
  }
  /// Figures, which nobody reads faster than some times a second.
  tell(header, ms, aside) {
    const rate = this.countRate();
    this.notePath();
    if (aside) this.follows ? this.tellFollowed(header, ms, rate) : this.tellFlown(header, ms, rate);
  }
  countRate() {
    this.frames.push(performance.now());
    while (this.frames[0] < performance.now() - 3000) this.frames.shift();
    return this.frames.length / 3;
  }
  tellFollowed({t, episode, instruction, step, end, distance, goal, score}, ms, rate) {
    this.figures = {ms, rate};
    const task = episode ? ` · episode ${episode}, ${step} actions, ${distance == null ? "goal not told" : `${distance.toFixed(1)} m from the goal`}${end === "running" ? "" : ` · ${end}, ${score?.success ? "success" : "failure"}`}` : "";
    this.state.textContent = `${this.flies ? "flying" : "looking on"} · ${this.figures.rate.toFixed(1)} pictures/s · ${(t - (this.began ??= episode ? 0 : t)).toFixed(1)} s${task}`;
    this.task.textContent = instruction ?? "";
    this.goal = goal;
    if (episode !== this.episode) this.enter(episode);
  }
  /// Another episode: its world may be another one, its way begins here.
  enter(episode) {
    this.episode = episode;
    this.path = [];
    this.named = null;
  }
  signs() { return this.goal ? [{p: this.goal, text: "goal"}] : this.drawing?.signs() ?? []; }
  tellFlown({v, render_ms, collisions, touched, kept, charge}, ms, rate) {
    this.figures = {ms, render_ms, rate};
    this.state.textContent = `${Math.hypot(...v).toFixed(1)} m/s · ${this.figures.rate.toFixed(1)} pictures/s (${render_ms.toFixed(0)} ms rendering) · battery ${Math.round(100 * charge)} %` +
      (collisions ? ` · touched ${touched ?? "something"} (${collisions})` : "");
    this.keptCount = kept;
    if (this.save) this.countKept(kept);
  }
  countKept(kept) {
    this.save.textContent = kept === 1 ? "Save 1 frame" : `Save ${kept} frames`;
    this.save.disabled = kept === 0;
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
    // Who takes the keys takes the drone.
    if (down) this.finder?.stop().catch(() => {});
    this.hold(key, down);
    return true;
  }
  hold(key, down) {
    if (down === this.held.has(key)) return;
    down ? this.held.add(key) : this.held.delete(key);
    this.steer();
  }
  letGo() { for (const key of [...this.held]) this.hold(key, false); }
  controls(box, weathers, keeps) {
    const {flies, follows, resets} = this;
    addEventListener("keyup", e => this.key(e, false));
    addEventListener("blur", () => this.letGo());
    if (flies) box.append(this.pad(), this.slider("Speed", 1, SPEEDS * 4, 1, 5, value => { this.speed = value / 16; }));
    if (!follows) box.append(this.choice("Weather", ["the world's own", ...weathers], value => this.set({weather: value === "the world's own" ? "" : value})),
               this.slider("Hour", 0, 24, 0.5, 12, value => this.set({hour: value}), "its own"),
               this.choice("Size", ["512", "1024", "2048", "4096"], value => { this.width = Number(value); }, "1024"));
    if (resets) box.append(this.button("To the start", () => this.ask({do: "reset"})));
    if (keeps) {
      this.save = this.button("Save 0 frames", async () => { this.note.textContent = "rendering them …"; const said = await this.ask({do: "save"}); this.app.say(`Saved ${said.frames} frames in ${said.folder}`); this.note.textContent = `saved: airsim360 view ${said.folder} shows them`; });
      this.countKept(0);
      this.note = document.createElement("span");
      box.append(this.button("Keep this frame", () => this.ask({do: "keep"})), this.save, this.note);
    } else if (!follows) {
      box.append(Object.assign(document.createElement("span"), {className: "hint", textContent: "To keep frames, start with --record DIR"}));
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
      button.addEventListener("pointerdown", e => { button.setPointerCapture(e.pointerId); this.hold(key, true); });
      for (const end of ["pointerup", "pointercancel"]) button.addEventListener(end, () => this.hold(key, false));
      button.addEventListener("keydown", e => { if (e.key === " " || e.key === "Enter") this.hold(key, true); });
      for (const end of ["keyup", "blur"]) button.addEventListener(end, () => this.hold(key, false));
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
  slider(text, min, max, step, value, does, shown = value) {
    const input = document.createElement("input"), out = document.createElement("output"), label = this.labelled(text, input);
    Object.assign(input, {type: "range", min, max, step, value});
    input.addEventListener("input", () => { out.textContent = input.value; does(Number(input.value)); });
    out.textContent = shown;
    label.append(out);
    return label;
  }
}
