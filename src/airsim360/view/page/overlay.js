// Products as colours over a picture.
import {turn, rayOfPoint} from "./sphere.js";

// Viridis at nine places, far to near.
const RAMP = [[68, 1, 84], [71, 45, 123], [59, 82, 139], [44, 114, 142], [33, 145, 140], [40, 174, 128], [94, 201, 98], [173, 220, 48], [253, 231, 37]];
const DIMMED = [24, 26, 32, 215];

export function rampColor(t) {
  const at = Math.min(1, Math.max(0, t)) * (RAMP.length - 1), i = Math.min(RAMP.length - 2, Math.floor(at)), f = at - i;
  return RAMP[i].map((v, c) => Math.round(v + f * (RAMP[i + 1][c] - v)));
}
/// A colour of its own for each id.
export function idColor(id) {
  let h = Math.imul(id, 2654435761) >>> 0;
  h = (h ^ h >>> 15) >>> 0;
  return [64 + h % 192, 64 + (h >>> 8) % 192, 64 + (h >>> 16) % 192];
}
function flowColor(dx, dy, scale) {
  const angle = Math.atan2(dy, dx), size = Math.min(1, Math.hypot(dx, dy) / scale);
  return [0, 2.0944, 4.18879].map(shift => Math.round(255 * (1 - size * (0.5 - 0.5 * Math.cos(angle - shift)))));
}

/// Least and greatest range of the scale, metres, of a dataset: a wide band about what it mostly sees.
export function rangeScale(medians) {
  const sorted = medians.filter(r => r > 0).sort((a, b) => a - b), middle = sorted[sorted.length >> 1] ?? 10;
  const nice = v => { const p = 10 ** Math.floor(Math.log10(v)); return v / p < 2 ? p : v / p < 5 ? 2 * p : 5 * p; };
  return [nice(middle / 8), nice(middle * 12)];
}
export function rangeFraction(r, [near, far]) { return Math.log(r / near) / Math.log(far / near); }

const byId = name => plane => { const v = plane.planes[name]; const known = new Map([[0, [0, 0, 0]]]);
  return i => { let c = known.get(v[i]); if (!c) known.set(v[i], c = idColor(v[i])); return c; }; };
const gray = plane => { const v = plane.planes.value; return i => [v[i], v[i], v[i]]; };
const wave = v => 255 * (v - Math.floor(v));

// Product -> what makes, of its plane, the colour of a pixel.
const PAINTERS = {
  range: (plane, {scale}) => { const v = plane.planes.Y; return i => v[i] > 0 ? rampColor(1 - rangeFraction(v[i], scale)) : [0, 0, 0]; },
  semantic: (plane, {categories}) => { const v = plane.planes.value; return i => categories.get(v[i])?.color ?? [0, 0, 0]; },
  entity: byId("id"),
  normal: plane => { const v = plane.planes.value, k = v instanceof Uint16Array ? 255 / 65535 : 1; return i => [v[3 * i] * k, v[3 * i + 1] * k, v[3 * i + 2] * k]; },
  albedo: plane => { const v = plane.planes.value; return i => [v[3 * i], v[3 * i + 1], v[3 * i + 2]]; },
  flow: plane => { const {dx, dy} = plane.planes; return i => flowColor(dx[i], dy[i], 32); },
  coverage: plane => { const s = plane.planes["share.0"]; return i => rampColor(2 * (1 - s[i])); },
  part: byId("value"),
  material: byId("value"),
  sky: gray,
  position: plane => { const {X, Y, Z} = plane.planes; return i => [wave(X[i] / 10), wave(Y[i] / 10), wave(Z[i] / 10)]; },
  radiance: plane => { const {R, G, B} = plane.planes; return i => [R[i], G[i], B[i]].map(v => 255 * Math.sqrt(v / (1 + v))); },
};
/// Products that can be laid over a picture, of those that a dataset has.
export function shownProducts(products) { return Object.keys(PAINTERS).filter(name => name in products); }

// Which pixels a filter leaves: null = all.
function filterOf({categories, entities, filter, picture, planes, size}) {
  const tests = [];
  if (filter.hidden.size && planes.semantic) { const v = planes.semantic.planes.value; tests.push(i => !filter.hidden.has(v[i])); }
  if (filter.people && planes.semantic) {
    const v = planes.semantic.planes.value, people = new Set([...categories.values()].filter(c => c.path.split("/").includes("person")).map(c => c.id));
    tests.push(i => people.has(v[i]));
  }
  const [low, high] = filter.height;
  if ((low > -Infinity || high < Infinity) && planes.range && picture.panoramic) {
    const r = planes.range.planes.Y, {width, height} = size;
    tests.push(i => {
      if (!(r[i] > 0)) return false;
      const z = picture.p[2] + r[i] * turn(picture.R, rayOfPoint(i % width + 0.5, Math.floor(i / width) + 0.5, width, height))[2];
      return z >= low && z <= high;
    });
  }
  return tests.length ? i => tests.every(test => test(i)) : null;
}

function outline(pixels, ids, chosen, width, height) {
  for (let y = 0, i = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x, ++i) {
      if (ids[i] !== chosen) continue;
      const left = x ? i - 1 : i + width - 1, right = x + 1 < width ? i + 1 : i + 1 - width;
      const edge = ids[left] !== chosen || ids[right] !== chosen || (y && ids[i - width] !== chosen) || (y + 1 < height && ids[i + width] !== chosen);
      pixels.set(edge ? [255, 255, 0, 255] : [255, 255, 0, 70], 4 * i);
    }
  }
}

/// Where two datasets differ: red where the ids of categories do, else blue to yellow by the relative difference of range.
export function difference(planes, others) {
  const a = planes.range?.planes.Y, b = others.range?.planes.Y, ca = planes.semantic?.planes.value, cb = others.semantic?.planes.value;
  return i => {
    if (ca && cb && ca[i] !== cb[i]) return [230, 30, 30];
    if (!a || !b || !(a[i] > 0) || !(b[i] > 0)) return [0, 0, 0];
    return rampColor(10 * Math.abs(a[i] - b[i]) / b[i]);
  };
}

/// RGBA of a picture's overlay; null where there is nothing to show. `wanted`: {product, opacity, filter, chosen, categories,
/// scale, picture, planes, others}; `planes` has what the rest asks for.
export function paintOverlay(wanted) {
  const {product, opacity, planes, chosen} = wanted;
  const size = Object.values(planes).find(Boolean);
  if (!size) return null;
  const {width, height} = size, pass = filterOf({...wanted, size});
  let color = null;
  if (product === "difference") color = wanted.others && wanted.others.size === width * height ? difference(planes, wanted.others.planes) : null;
  else if (planes[product]) color = PAINTERS[product](planes[product], wanted);
  if (!color && !pass && !(chosen && planes.entity)) return null;
  const pixels = new Uint8ClampedArray(4 * width * height), alpha = Math.round(255 * opacity);
  for (let i = 0, to = 0; i < width * height; ++i, to += 4) {
    if (pass && !pass(i)) { pixels[to] = DIMMED[0]; pixels[to + 1] = DIMMED[1]; pixels[to + 2] = DIMMED[2]; pixels[to + 3] = DIMMED[3]; continue; }
    if (!color) continue;
    const c = color(i);
    pixels[to] = c[0]; pixels[to + 1] = c[1]; pixels[to + 2] = c[2]; pixels[to + 3] = alpha;
  }
  if (chosen && planes.entity) outline(pixels, planes.entity.planes.id, chosen, width, height);
  return {width, height, pixels};
}

/// Planes that an overlay needs.
export function planesFor({product, filter, chosen}) {
  const names = new Set();
  if (product === "difference") { names.add("range"); names.add("semantic"); }
  else if (product) names.add(product);
  if (filter.hidden.size || filter.people) names.add("semantic");
  if (filter.height[0] > -Infinity || filter.height[1] < Infinity) names.add("range");
  if (chosen) names.add("entity");
  return [...names];
}
