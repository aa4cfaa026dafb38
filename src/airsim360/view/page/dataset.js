// A recorded dataset: its index is read once, pictures when they are looked at.
import {readMessage} from "./message.js";
import {matrixOf} from "./sphere.js";

const KEPT_FRAMES = 6;

const worker = new Worker(new URL("decode_worker.js", import.meta.url), {type: "module"});
const waiting = new Map();
let nextKey = 0;
worker.onmessage = ({data}) => {
  const {resolve, reject} = waiting.get(data.key);
  waiting.delete(data.key);
  data.error ? reject(new Error(data.error)) : resolve(data.result);
};
function ask(message) {
  return new Promise((resolve, reject) => {
    const key = nextKey++;
    waiting.set(key, {resolve, reject});
    worker.postMessage({...message, key});
  });
}

async function json(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  return response.json();
}

/// One picture of one frame with its labels: what the panorama shows, recorded or live.
class Picture {
  constructor(dataset, index, view) {
    Object.assign(this, {dataset, index, view, stem: dataset.index.frames.stem[index], kept: new Map()});
    const v = dataset.index.views[view];
    this.panoramic = v.projection === "erp";
    this.p = v.p[index];
    this.R = matrixOf(v.q[index]);
  }
  once(key, make) {
    if (!this.kept.has(key)) this.kept.set(key, make());
    return this.kept.get(key);
  }
  url(product) { return this.dataset.url(product, this.index, this.view); }
  /// Colours; null in datasets without.
  bitmap() {
    return this.once("rgb", async () => {
      if (!this.dataset.has("rgb")) return null;
      const response = await fetch(this.url("rgb"));
      if (!response.ok) throw new Error(`${this.url("rgb")}: ${response.status}`);
      return createImageBitmap(await response.blob(), {colorSpaceConversion: "none", premultiplyAlpha: "none"});
    });
  }
  /// {width, height, planes} of a product; null if the dataset has none.
  plane(product) {
    return this.once(product, async () => this.dataset.has(product) ? ask({what: "plane", url: this.url(product), product}) : null);
  }
  people() {
    return this.once("people", async () => this.dataset.index.people ? json(`${this.dataset.base}people/${this.stem}${this.dataset.index.views[this.view].suffix}.json`) : []);
  }
  close() { this.kept.get("rgb")?.then(bitmap => bitmap?.close(), () => {}); }
}

/// A frame of a plan: drawn by the server when it is asked for, all products at once.
class PlannedPicture {
  constructor(dataset, index) { Object.assign(this, {dataset, index, panoramic: true}); }
  ready() { return this.coming ??= this.load(); }
  async load() {
    const response = await fetch(`${this.dataset.base}frame/${this.index}`);
    if (!response.ok) throw new Error((await response.json()).error.message);
    const {header, planes, jpeg} = readMessage(await response.arrayBuffer());
    Object.assign(this, {header, planes, p: header.p, R: matrixOf(header.q)});
    this.shown = jpeg && await createImageBitmap(jpeg, {colorSpaceConversion: "none", premultiplyAlpha: "none"});
  }
  async bitmap() { await this.ready(); return this.shown; }
  async plane(product) { await this.ready(); return this.planes[product] ?? null; }
  async people() { await this.ready(); return this.header.persons ?? []; }
  close() { this.coming?.then(() => this.shown?.close(), () => {}); }
}

export class Dataset {
  /// `base`: address of its folder, ending in "/".
  constructor(base) {
    this.base = new URL(base, location.href).href;
    this.pictures = new Map();  // in the order of their use
  }
  async open() {
    this.index = await json(this.base + "index.json");
    this.categories = new Map(this.index.categories.map(c => [c.id, c]));
    // What is seen where is not known before it is drawn.
    this.planned = this.index.planned === true;
    if (this.planned) this.appearances = null;
    this.categoryByPath = new Map(this.index.categories.map(c => [c.path, c]));
    return this;
  }
  get size() { return this.index.frames.stem.length; }
  has(product) { return product in this.index.products; }
  url(product, frame, view) {
    return `${this.base}${product}/${this.index.frames.stem[frame]}${this.index.views[view].suffix}${this.index.products[product]}`;
  }
  /// Names come with the worlds of a plan, which are opened one by one.
  entities() { return this.planned ? json(this.base + "entities.json") : this.named ??= json(this.base + "entities.json"); }
  parts() { return this.partNames ??= json(this.base + "parts.json"); }
  materials() { return this.materialNames ??= json(this.base + "materials.json"); }
  /// Entity id -> [frame, pixels, frame, pixels, …].
  appearances() { return this.seen ??= json(this.base + "appearances.json"); }
  nearest(frame, view, ids) {
    return ask({what: "nearest", entity: this.url("entity", frame, view), range: this.url("range", frame, view), ids});
  }
  picture(index, view = 0) {
    const key = `${index} ${view}`;
    const picture = this.pictures.get(key) ?? (this.planned ? new PlannedPicture(this, index) : new Picture(this, index, view));
    this.pictures.delete(key);
    this.pictures.set(key, picture);
    while (this.pictures.size > KEPT_FRAMES) {
      const [oldest, gone] = this.pictures.entries().next().value;
      this.pictures.delete(oldest);
      gone.close();
    }
    return picture;
  }
}
