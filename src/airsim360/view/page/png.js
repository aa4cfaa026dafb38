// Exact values of PNG files: a canvas would give 8 bits and the colours of palettes. ISO/IEC 15948.

export async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4};
const MOST_PIXELS = 1 << 28;

function readChunks(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 33 || view.getUint32(0) !== 0x89504e47) throw new Error("not a PNG file");
  const head = {width: view.getUint32(16), height: view.getUint32(20), depth: bytes[24], kind: bytes[25], interlaced: bytes[28]};
  const parts = [];
  for (let at = 8; at + 12 <= bytes.length;) {
    const length = view.getUint32(at), type = view.getUint32(at + 4);
    if (at + 12 + length > bytes.length) throw new Error("the PNG file is cut off");
    if (type === 0x49444154) parts.push(bytes.subarray(at + 8, at + 8 + length));  // IDAT
    at += 12 + length;
  }
  return {head, parts};
}

function paeth(a, b, c) {
  const p = a + b - c, pa = Math.abs(p - a), pb = Math.abs(p - b), pc = Math.abs(p - c);
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

// Undoes the filter of each row, in place; rows then follow one another without their filter bytes.
function unfilter(raw, rowBytes, height, step) {
  for (let y = 0, from = 0, to = 0; y < height; ++y, to += rowBytes) {
    const filter = raw[from++], up = to - rowBytes;
    for (let i = 0; i < rowBytes; ++i) {
      const a = i >= step ? raw[to + i - step] : 0, b = y > 0 ? raw[up + i] : 0;
      let add = 0;
      if (filter === 1) add = a;
      else if (filter === 2) add = b;
      else if (filter === 3) add = (a + b) >> 1;
      else if (filter === 4) add = paeth(a, b, i >= step && y > 0 ? raw[up + i - step] : 0);
      raw[to + i] = raw[from + i] + add;
    }
    from += rowBytes;
  }
  return raw.subarray(0, rowBytes * height);
}

/// {width, height, channels, data}: values as stored (palette pictures: indices), 8 bits as Uint8Array, 16 as Uint16Array.
export async function decodePng(bytes) {
  const {head, parts} = readChunks(bytes);
  const channels = CHANNELS[head.kind];
  if (!channels || head.interlaced || (head.depth !== 8 && head.depth !== 16)) throw new Error("a kind of PNG that datasets do not have");
  if (!head.width || !head.height || head.width * head.height > MOST_PIXELS) throw new Error("a PNG of impossible size");
  const step = channels * head.depth / 8, rowBytes = head.width * step;
  const raw = await inflate(new Blob(parts));
  if (raw.length < (rowBytes + 1) * head.height) throw new Error("the PNG file is cut off");
  const flat = unfilter(raw, rowBytes, head.height, step);
  const size = {width: head.width, height: head.height, channels};
  if (head.depth === 8) return {...size, data: flat};
  const data = new Uint16Array(flat.length / 2);
  for (let i = 0; i < data.length; ++i) data[i] = flat[2 * i] << 8 | flat[2 * i + 1];
  return {...size, data};
}
