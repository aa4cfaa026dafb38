// Reads label files beside the page's own thread.
import {decodeExr} from "./exr.js";
import {decodePng} from "./png.js";

async function bytesOf(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status}`);
  return new Uint8Array(await response.arrayBuffer());
}

// Ids of R + 256 G + 65536 B.
function idsOf({width, height, data}) {
  const ids = new Uint32Array(width * height);
  for (let i = 0; i < ids.length; ++i) ids[i] = data[3 * i] | data[3 * i + 1] << 8 | data[3 * i + 2] << 16;
  return ids;
}

async function plane({url, product}) {
  const bytes = await bytesOf(url);
  if (url.endsWith(".exr")) return decodeExr(bytes);
  const picture = await decodePng(bytes);
  const {width, height, channels} = picture;
  return product === "entity" ? {width, height, planes: {id: idsOf(picture)}} : {width, height, channels, planes: {value: picture.data}};
}

// Least range of any of `ids`, Infinity where none is seen or has one, and the pixel that has it.
async function nearest({entity, range, ids}) {
  const [labels, far] = await Promise.all([plane({url: entity, product: "entity"}), plane({url: range})]);
  const wanted = new Set(ids), id = labels.planes.id, metres = far.planes.Y;
  let least = Infinity, at = -1;
  for (let i = 0; i < id.length; ++i) if (metres[i] > 0 && metres[i] < least && wanted.has(id[i])) { least = metres[i]; at = i; }
  return {least, at: at < 0 ? null : [at % labels.width, Math.floor(at / labels.width)]};
}

onmessage = async ({data}) => {
  try {
    const result = await (data.what === "nearest" ? nearest(data) : plane(data));
    const buffers = result.planes ? Object.values(result.planes).map(p => p.buffer) : [];
    postMessage({key: data.key, result}, [...new Set(buffers)]);
  } catch (error) {
    postMessage({key: data.key, error: error.message});
  }
};
