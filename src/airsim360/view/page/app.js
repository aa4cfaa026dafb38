// The page: what is chosen, and what follows from it.
import {boxOf, cardRows, fillList} from "./card.js";
import {Dataset} from "./dataset.js";
import {Flights} from "./flights.js";
import {FrameList} from "./frame_list.js";
import {Live} from "./live.js";
import {Minimap} from "./minimap.js";
import {paintOverlay, planesFor, rampColor, rangeScale, shownProducts} from "./overlay.js";
import {Panorama} from "./panorama.js";
import {nearMisses, parseQuestion, search} from "./search.js";
import {Look, pointOfRay, rayOfPoint, turn, turnBack} from "./sphere.js";

const PLAY_MS = 100, ADDRESS_MS = 300;
const $ = id => document.getElementById(id);

class App {
  constructor() {
    Object.assign(this, {frame: 0, view: 0, product: "", chosen: 0, box: null, turn: 0, panes: [],
                         filter: {hidden: new Set(), people: false, height: [-Infinity, Infinity]}});
  }

  async open() {
    const asked = this.session();
    this.map = new Minimap($("map"), i => this.showFrame(this.flights ? this.flights.current.first + i : this.visited ? this.visited[i].frame : i));
    this.addPane($("pane-a"));
    const session = await asked;
    this.listen();
    this.readAddress();
    if (session.live) await this.openLive(session.live);
    else await this.openRecorded(session.datasets);
    addEventListener("hashchange", () => { this.readAddress(); this.refresh(); });
  }
  /// What there is to see. The server answers at once, also while it still opens a world.
  async session() {
    for (;;) {
      const session = await (await fetch("session.json")).json(), coming = session.live?.coming;
      if (session.live?.error) throw new Error(session.live.error);
      document.body.className = session.live ? "live" : "recorded";
      $("opening").hidden = !coming;
      if (!coming) return session;
      document.title = `${coming} – AirSim360 live`;
      $("opening").textContent = `Opening ${coming} …  The first time a world is built, which may take a minute.`;
    }
  }
  addPane(box) {
    const pane = {box, look: new Look()};
    pane.panorama = new Panorama(box, pane.look, {
      onPick: (x, y) => this.guard(this.pick(pane, x, y)),
      onLook: () => this.lookElsewhere(pane),
    });
    pane.panorama.flat = $("flat").checked;
    this.panes.push(pane);
    return pane;
  }
  get main() { return this.panes[0]; }

  async openRecorded(bases) {
    this.main.dataset = await new Dataset(bases[0]).open();
    if (bases[1]) await this.openSecond(bases[1]);
    const {index} = this.main.dataset;
    document.title = `${index.name} – AirSim360 view`;
    $("title").textContent = `${index.name} · ${index.world} · ${this.main.dataset.size} frames`;
    $("fly-hint").textContent = /^[a-z]\w*$/.test(index.world ?? "") ? `To fly in this world: airsim360 view --world ${index.world}` : "";
    this.scale = rangeScale(index.frames.range);
    this.fillProducts(shownProducts(index.products), this.panes.length > 1);
    this.fillViews(index.views);
    $("people-choice").hidden = !index.people;
    $("time").max = this.main.dataset.size - 1;
    if (index.planned) $("search-form").closest("details").hidden = true;
    if (index.flights) this.flights = new Flights(this, index.flights);
    else if (index.planned) this.openPlan();
    else this.map.setFlight(index.views[0].p);
    this.list = new FrameList($("frame-list"), frame => this.showFrame(frame));
    this.listAll();
    await this.showFrame(Math.min(this.frame, this.main.dataset.size - 1));
  }
  openPlan() {
    this.visited = [];
    this.map.setFlight([]);
  }
  async openSecond(base) {
    $("pane-b").hidden = false;
    const pane = this.addPane($("pane-b"));
    pane.dataset = await new Dataset(base).open();
    pane.byStem = new Map(pane.dataset.index.frames.stem.map((stem, i) => [stem, i]));
    this.panes.forEach(p => { const name = p.box.querySelector(".pane-name"); name.hidden = false; name.textContent = p.dataset.index.name; });
  }
  async openLive(live) {
    this.live = new Live(live, $("live"), this);
    this.main.panorama.moving = true;
    $("title").textContent = `${live.world} · live`;
    document.title = `${live.world} – AirSim360 live`;
    this.fillProducts(live.products, false);
    this.scale = live.scale;
    this.map.setFlight([]);
    await this.live.start();
  }

  fillProducts(names, both) {
    for (const name of [...names, ...(both ? ["difference"] : [])]) $("product").append(new Option(name, name));
    if (this.main.dataset && !this.main.dataset.has("rgb") && !this.product) this.product = "semantic";
    $("product").value = this.product;
    this.product = $("product").value;
  }
  fillViews(views) {
    $("view-choice").hidden = views.length < 2;
    for (const [i, v] of views.entries()) $("view").append(new Option(v.suffix.slice(1) || v.projection, i));
  }
  describe(frame) {
    const {stem, t, world} = this.main.dataset.index.frames;
    return `${stem[frame]} · ${this.visited ? world[frame] : `${t[frame].toFixed(2)} s`}`;
  }
  listAll() {
    $("all-frames").hidden = true;
    $("frames-title").textContent = `Frames (${this.main.dataset.size})`;
    this.list.set([...Array(this.main.dataset.size).keys()], frame => this.describe(frame));
    this.list.choose(this.frame);
  }
  listFlight({id, first, last}) { this.listSome([...Array(last - first + 1).keys()].map(i => first + i), id); }
  listSome(frames, what) {
    $("all-frames").hidden = false;
    $("frames-title").textContent = `${what} (${frames.length})`;
    this.list.set(frames, frame => this.describe(frame));
    this.list.choose(this.frame);
  }

  listen() {
    $("product").addEventListener("change", () => { this.product = $("product").value; this.refresh(); });
    $("opacity").addEventListener("input", () => this.refresh());
    $("flat").addEventListener("change", () => { for (const p of this.panes) p.panorama.flat = $("flat").checked; this.refresh(); });
    $("view").addEventListener("change", () => { this.view = Number($("view").value); this.refresh(); });
    $("skeletons").addEventListener("change", () => this.refresh());
    $("arrows").addEventListener("change", () => this.refresh());
    $("only-people").addEventListener("change", () => { this.filter.people = $("only-people").checked; this.refresh(); });
    for (const [i, id] of ["low", "high"].entries()) $(id).addEventListener("change", () => {
      this.filter.height[i] = $(id).value === "" ? (i ? Infinity : -Infinity) : Number($(id).value);
      this.refresh();
    });
    $("time").addEventListener("input", () => this.showFrame(Number($("time").value)));
    for (const [id, factor] of [["map-out", 2], ["map-in", 0.5]]) $(id).addEventListener("click", () => this.map.zoom(factor));
    $("back").addEventListener("click", () => this.step(-1));
    $("on").addEventListener("click", () => this.step(1));
    $("play").addEventListener("click", () => this.play());
    $("help-button").addEventListener("click", () => { $("help").hidden = !$("help").hidden; $("help-button").setAttribute("aria-expanded", !$("help").hidden); });
    $("all-frames").addEventListener("click", () => this.listAll());
    $("forget").addEventListener("click", () => this.forget());
    $("look-at").addEventListener("click", () => this.lookAt());
    $("only-frames").addEventListener("click", () => this.guard(this.listChosen()));
    $("search-form").addEventListener("submit", e => { e.preventDefault(); this.guard(this.find($("question").value)); });
    addEventListener("keydown", e => this.key(e));
  }
  key(e) {
    if (e.target.matches("input, select, textarea") || e.ctrlKey || e.altKey || e.metaKey) return;
    if (this.live?.key(e, true)) return e.preventDefault();
    const does = this.live ? {"/": () => { $("finding").open = true; $("find-text").focus(); }}[e.key]
                           : {",": () => this.step(-1), ".": () => this.step(1), p: () => this.play(), "/": () => $("question").focus()}[e.key];
    if (!does) return;
    e.preventDefault();
    does();
  }
  /// Shows what went wrong instead of failing silently.
  guard(promise) {
    return Promise.resolve(promise).catch(error => { $("problem").hidden = false; $("problem").textContent = error.message; throw error; });
  }
  say(text) { $("say").textContent = text; }

  // Frames.

  step(by) {
    const rows = this.list.rows, at = rows.indexOf(this.frame), to = at < 0 ? 0 : Math.min(rows.length - 1, Math.max(0, at + by));
    return this.showFrame(rows[to]);
  }
  async play() {
    this.playing = !this.playing;
    $("play").setAttribute("aria-label", this.playing ? "Stop" : "Play");
    $("play").textContent = this.playing ? "■" : "▶▶";
    while (this.playing) {
      const before = this.frame;
      const [, shown] = await Promise.all([new Promise(done => setTimeout(done, PLAY_MS)), this.step(1).then(() => true, () => false)]);
      if (!shown || this.frame === before) break;
    }
    if (this.playing) this.play();
  }
  showFrame(frame) {
    if (this.live) return;
    this.frame = frame;
    $("time").value = frame;
    $("time").setAttribute("aria-valuetext", this.describe(frame));
    $("now").textContent = `${frame + 1} / ${this.main.dataset.size}`;
    this.list.choose(frame);
    this.flights?.show(frame);
    return this.refresh();
  }
  pictureOf(pane) {
    if (this.live) return this.live.picture;
    const {dataset, byStem} = pane;
    const index = byStem ? byStem.get(this.main.dataset.index.frames.stem[this.frame]) ?? Math.min(this.frame, dataset.size - 1) : this.frame;
    return dataset.picture(index, Math.min(this.view, dataset.index.views.length - 1));
  }

  // Drawing: everything is fetched first, and shown at once if it is still wanted.

  refresh() {
    this.asideDue = true;  // also where a picture overtakes this
    return this.guard(this.draw(++this.turn));
  }
  wanted() {
    return {product: this.product, opacity: Number($("opacity").value), filter: this.filter, chosen: this.chosen, scale: this.scale};
  }
  /// `aside`: map and legend too, which need not follow every picture of a live world.
  async draw(turn, aside = true) {
    const names = planesFor(this.wanted());
    const fetched = await Promise.all(this.panes.map(pane => this.fetchPane(pane, names)));
    if (turn !== this.turn) return;
    fetched.forEach((got, i) => this.showPane(this.panes[i], got, fetched[0]));
    $("problem").hidden = true;
    this.shown = fetched;
    if (aside || this.asideDue) {
      this.asideDue = false;
      this.showMap();
      this.showLegend(fetched[0]);
    }
    if (!this.live) this.noteAddress();
    if (!this.first) this.first = performance.now();
  }
  async fetchPane(pane, names) {
    const picture = this.pictureOf(pane);
    if (picture.ready) await this.drawn(picture);
    const [bitmap, people, ...planes] = await Promise.all([picture.bitmap(), picture.people(), ...names.map(name => picture.plane(name))]);
    return {picture, bitmap, people, planes: Object.fromEntries(names.map((name, i) => [name, planes[i]]))};
  }
  /// A frame of a plan, once the server has drawn it; the first of a world takes longest.
  async drawn(picture) {
    if (!picture.shown) $("pose").textContent = `Drawing frame ${picture.index} …`;
    await picture.ready();
    if (!this.visited || this.visited.some(({frame}) => frame === picture.index)) return;
    this.visited.push({frame: picture.index, p: picture.p});
    this.map.setFlight(this.visited.map(({p}) => p));
  }
  showPane(pane, {picture, bitmap, people, planes}, first) {
    const {panorama} = pane, categories = (pane.dataset ?? this.live).categories;
    const one = Object.values(first.planes).find(Boolean), others = {planes: first.planes, size: one ? one.width * one.height : 0};
    panorama.setPicture(bitmap, picture.panoramic);
    panorama.setOverlay(paintOverlay({...this.wanted(), product: this.product === "difference" && pane === this.main ? "" : this.product, picture, planes, categories, others}));
    panorama.people = $("skeletons").checked ? people : [];
    panorama.signs = (this.flights ?? this.live)?.signs?.(picture).map(({p, text}) => ({ray: turnBack(picture.R, p.map((v, a) => v - picture.p[a])), text})) ?? [];
    panorama.flow = this.product === "flow" && $("arrows").checked ? planes.flow : null;
    panorama.draw();
  }
  lookElsewhere(pane) {
    for (const other of this.panes) {
      if (other !== pane) other.look.set(pane.look.yaw, pane.look.pitch, pane.look.fov);
      other.panorama.draw();
    }
    if (this.shown) this.showMap();
    this.noteAddress();
  }
  showMap() {
    const {picture, people} = this.shown[0], {yaw, fov} = this.main.look;
    this.map.show({p: picture.p, R: picture.R, yaw, fov}, people, this.box?.known ? this.box : null);
    $("pose").textContent = `x ${picture.p[0].toFixed(2)} m, y ${picture.p[1].toFixed(2)} m, z ${picture.p[2].toFixed(2)} m`;
  }

  // Legend.

  showLegend({picture, planes}) {
    const legend = $("legend");
    $("arrows-choice").hidden = this.product !== "flow";
    if (this.product === "semantic" && planes.semantic) return this.classLegend(legend, planes.semantic);
    legend.replaceChildren();
    if (this.product === "range") this.rampLegend(legend, this.scale.map(v => `${v} m`), true);
    else if (this.product === "coverage") this.rampLegend(legend, ["one thing", "half"], false);
    else if (this.product === "difference") { this.text(legend, "Red: another category. Colours: difference of range."); this.rampLegend(legend, ["0 %", "10 %"], false); }
    else this.text(legend, {flow: "Hue: direction of motion in the picture. Saturation: up to 32 pixels.", entity: "One colour for each thing.",
                            normal: "Red, green, blue: normal along east, north, up."}[this.product] ?? (this.product || "Choose a product above the picture."));
    if (this.product !== "semantic" && this.filter.hidden.size) this.text(legend, `${this.filter.hidden.size} categories are hidden.`);
  }
  text(box, text) {
    const p = document.createElement("p");
    p.textContent = text;
    box.append(p);
  }
  rampLegend(legend, ends, reversed) {
    const canvas = document.createElement("canvas"), ticks = document.createElement("div");
    Object.assign(canvas, {width: 256, height: 1, className: "ramp"});
    const g = canvas.getContext("2d");
    for (let x = 0; x < 256; ++x) { g.fillStyle = `rgb(${rampColor(reversed ? 1 - x / 255 : x / 255)})`; g.fillRect(x, 0, 1, 1); }
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `Scale from ${ends[0]} to ${ends[1]}`);
    ticks.className = "ticks";
    for (const end of this.product === "range" ? [ends[0], `${Number(Math.sqrt(this.scale[0] * this.scale[1]).toPrecision(2))} m`, ends[1]] : ends) {
      const span = document.createElement("span");
      span.textContent = end;
      ticks.append(span);
    }
    legend.append(canvas, ticks);
  }
  classLegend(legend, plane) {
    const counts = new Map(), values = plane.planes.value, {categories} = this.main.dataset ?? this.live;
    for (const v of values) counts.set(v, (counts.get(v) ?? 0) + 1);
    for (const id of this.filter.hidden) if (!counts.has(id)) counts.set(id, 0);
    const list = document.createElement("ul");
    for (const [id, count] of [...counts].sort((a, b) => b[1] - a[1])) list.append(this.classRow(id, categories.get(id), count / values.length));
    legend.replaceChildren(list);
  }
  classRow(id, category, share) {
    const row = document.createElement("li"), label = document.createElement("label"), box = document.createElement("input");
    const swatch = document.createElement("span"), name = document.createElement("span"), part = document.createElement("span");
    Object.assign(box, {type: "checkbox", checked: !this.filter.hidden.has(id)});
    box.addEventListener("change", () => { box.checked ? this.filter.hidden.delete(id) : this.filter.hidden.add(id); this.refresh(); });
    swatch.className = "swatch";
    swatch.style.background = `rgb(${category?.color ?? [0, 0, 0]})`;
    name.textContent = category?.path ?? `category ${id}`;
    part.className = "share";
    part.textContent = `${(100 * share).toFixed(1)} %`;
    label.append(box, swatch, name, part);
    row.append(label);
    return row;
  }

  // Things.

  async pick(pane, x, y) {
    const source = pane.dataset ?? this.live, planesOf = picture => Promise.all(["entity", "range", "semantic"].map(name => picture.plane(name)));
    let picture = this.pictureOf(pane), planes;
    try {
      planes = await planesOf(picture);
    } catch (error) {
      if (!this.live) throw error;
      // Others look too, and the server has forgotten this picture by now.
      picture = this.pictureOf(pane);
      planes = await planesOf(picture);
    }
    const [entity, range, semantic] = planes;
    const i = y * entity.width + x, id = entity.planes.id[i], entities = await source.entities();
    const box = boxOf(picture, {entity, range}, id, [x, y], entities[id]);
    const person = (await picture.people()).find(p => p.entity_id === id);
    const rows = cardRows({id, entity: entities[id], category: source.categories.get(semantic?.planes.value[i]), range: range?.planes.Y[i], pixel: [x, y], box, person});
    if (id === 0) return;
    Object.assign(this, {chosen: id, box, chosenName: entities[id]?.name ?? String(id)});
    this.picked = {id, x, y, p: picture.p, range: range?.planes.Y[i], category: semantic?.planes.value[i]};
    await this.showCard(rows, source, id);
    if (this.live && range) await this.offerPlacing(picture, range, [x, y]);
    await this.refresh();
  }
  /// People can be sent, and cars put, to the point that was clicked.
  offerPlacing(picture, range, [x, y]) {
    const along = turn(picture.R, rayOfPoint(x + 0.5, y + 0.5, range.width, range.height));
    this.picked.point = along.map((v, a) => picture.p[a] + v * range.planes.Y[y * range.width + x]);
    this.live.drawing?.picked(this.chosenName);
    return this.live.offerPlacing();
  }
  async showCard(rows, source, id) {
    $("card-hint").hidden = true;
    $("card-tools").hidden = false;
    fillList($("card"), rows);
    this.say(rows.slice(0, 5).map(([name, text]) => `${name} ${text}`).join(", "));
    $("look-at").hidden = !this.box.known;
    $("only-frames").hidden = true;
    $("fly-there").hidden = !(this.live?.finder && source === this.live);
    if (!source.appearances) return;
    const seen = (await source.appearances())[id] ?? [];
    $("only-frames").hidden = false;
    $("only-frames").textContent = `Its ${seen.length / 2} frames`;
  }
  async listChosen() {
    const seen = (await this.main.dataset.appearances())[this.chosen] ?? [];
    this.listSome(seen.filter((_, i) => i % 2 === 0), this.chosenName);
  }
  forget() {
    Object.assign(this, {chosen: 0, box: null});
    $("card").replaceChildren();
    $("card-hint").hidden = false;
    $("card-tools").hidden = true;
    this.refresh();
  }
  lookAt() {
    const {p, R} = this.shown[0].picture, centre = this.box.low.map((v, a) => (v + this.box.high[a]) / 2 - p[a]);
    const [x, y] = pointOfRay(turnBack(R, centre), 2 * Math.PI, Math.PI);
    this.main.panorama.turnTo(x - Math.PI, Math.PI / 2 - y);
  }
  async find(text) {
    this.searching?.abort();
    const {signal} = this.searching = new AbortController(), question = parseQuestion(text), hits = [];
    $("hits").replaceChildren();
    if (!question.words.length) return;
    $("search-state").textContent = "Searching …";
    const onHit = hit => { hits.push(hit); if (hits.length <= 200) $("hits").append(this.hitRow(hit)); };
    const onProgress = (done, all) => { $("search-state").textContent = done < all ? `${done} of ${all} frames looked at, ${hits.length} found` : `${hits.length} frames`; };
    const ids = await search(this.main.dataset, this.view, question, signal, onHit, onProgress);
    if (signal.aborted) return;
    if (!ids.length) await this.offerInstead(question);
    else if (hits.length) this.listSome(hits.map(h => h.frame), text);
  }
  /// Nothing has all the words: what has most of them is offered.
  async offerInstead({said, words, within}) {
    const names = nearMisses(await this.main.dataset.entities(), words);
    $("search-state").textContent = `No thing is called "${said}".${names.length ? " Did you mean:" : ""}`;
    for (const name of names) {
      const row = document.createElement("li"), button = document.createElement("button");
      button.type = "button";
      button.textContent = name;
      button.addEventListener("click", () => { $("question").value = name + (within < Infinity ? ` within ${within} m` : ""); this.guard(this.find($("question").value)); });
      row.append(button);
      $("hits").append(row);
    }
  }
  /// A hit: its frame, with the nearest of the things that were looked for in the middle.
  async showHit(frame, ids) {
    await this.showFrame(frame);
    if (!this.main.dataset.has("range") || !this.main.dataset.has("entity")) return;
    const {at} = await this.main.dataset.nearest(frame, this.view, ids);
    if (!at || this.frame !== frame) return;
    await this.pick(this.main, ...at);
    if (this.box?.known) this.lookAt();
  }
  hitRow({frame, least, ids}) {
    const row = document.createElement("li"), button = document.createElement("button");
    button.type = "button";
    button.textContent = this.describe(frame) + (least === null ? "" : ` · ${least.toFixed(1)} m`);
    button.addEventListener("click", () => this.guard(this.showHit(frame, ids)));
    row.append(button);
    return row;
  }

  // The address tells what is seen, so that it can be sent to somebody.

  // Not at every picture: browsers bear some two hundred changes in half a minute.
  noteAddress() {
    clearTimeout(this.writing);
    this.writing = setTimeout(() => this.writeAddress(), ADDRESS_MS);
  }
  writeAddress() {
    const {yaw, pitch, fov} = this.main.look, said = new URLSearchParams({frame: this.frame, yaw: yaw.toFixed(4), pitch: pitch.toFixed(4), fov: fov.toFixed(3)});
    if (this.product) said.set("show", this.product);
    if ($("flat").checked) said.set("flat", 1);
    history.replaceState(null, "", `#${said}`);
  }
  readAddress() {
    const said = new URLSearchParams(location.hash.slice(1)), number = (name, otherwise) => Number.isFinite(Number(said.get(name) ?? NaN)) ? Number(said.get(name)) : otherwise;
    this.frame = Math.max(0, Math.floor(number("frame", 0)));
    if (this.main.dataset) this.frame = Math.min(this.frame, this.main.dataset.size - 1);
    this.product = said.get("show") ?? "";
    if ($("product").options.length > 1) { $("product").value = this.product; this.product = $("product").value; }
    $("flat").checked = said.has("flat");
    for (const pane of this.panes) {
      pane.look.set(number("yaw", 0), number("pitch", 0), number("fov", 1.3));
      pane.panorama.flat = $("flat").checked;
    }
    if (this.list) { this.list.choose(this.frame); $("time").value = this.frame; }
  }
}

const app = window.airsim360 = new App();
app.guard(app.open());
