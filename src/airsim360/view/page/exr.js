// OpenEXR files as this program writes them: scan lines, not compressed or ZIP, channels of 16 or 32 bits. Format: openexr.com,
// "OpenEXR file layout".
import {inflate} from "./png.js";

const KIND_BYTES = [4, 2, 4];  // uint, half, float
const ROWS_OF_BLOCK = {0: 1, 2: 1, 3: 16};
const MOST_PIXELS = 1 << 28;

class Reader {
  constructor(bytes) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.at = 0;
  }
  int() { this.at += 4; return this.view.getInt32(this.at - 4, true); }
  name() {
    const end = this.bytes.indexOf(0, this.at);
    if (end < 0) throw new Error("the EXR file is cut off");
    const text = new TextDecoder().decode(this.bytes.subarray(this.at, end));
    this.at = end + 1;
    return text;
  }
}

function readChannels(reader, end) {
  const channels = [];
  while (reader.at < end - 1) {
    const name = reader.name(), kind = reader.int();
    reader.at += 12;  // linear, reserved, sampling
    channels.push({name, kind});
  }
  return channels;
}

function readHeader(reader) {
  if (reader.int() !== 20000630) throw new Error("not an EXR file");
  reader.int();
  const head = {};
  for (;;) {
    const name = reader.name();
    if (!name) return head;
    reader.name();
    const size = reader.int(), end = reader.at + size;
    if (size < 0 || end > reader.bytes.length) throw new Error("the EXR file is cut off");
    if (name === "channels") head.channels = readChannels(reader, end);
    if (name === "compression") head.compression = reader.bytes[reader.at];
    if (name === "dataWindow") head.window = [reader.int(), reader.int(), reader.int(), reader.int()];
    reader.at = end;
  }
}

// ZIP blocks hold differences of bytes, the first half of which are the even ones.
function undoZip(packed) {
  for (let i = 1; i < packed.length; ++i) packed[i] = packed[i - 1] + packed[i] - 128;
  const bytes = new Uint8Array(packed.length), half = (packed.length + 1) >> 1;
  for (let i = 0; i < half; ++i) bytes[2 * i] = packed[i];
  for (let i = half; i < packed.length; ++i) bytes[2 * (i - half) + 1] = packed[i];
  return bytes;
}

export function floatOfHalf(bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? 2 ** (exponent - 15) * (1 + fraction / 1024) : 2 ** -14 * fraction / 1024);
}

function copyRow(view, at, kind, width, out, to) {
  for (let x = 0; x < width; ++x) {
    out[to + x] = kind === 2 ? view.getFloat32(at + 4 * x, true) : kind === 1 ? floatOfHalf(view.getUint16(at + 2 * x, true))
                                                                              : view.getUint32(at + 4 * x, true);
  }
}

/// {width, height, planes: {channel: Float32Array}}; `wanted`: names of channels, all without.
export async function decodeExr(bytes, wanted) {
  const reader = new Reader(bytes), head = readHeader(reader);
  const {channels, compression, window} = head;
  const width = window[2] - window[0] + 1, height = window[3] - window[1] + 1, rows = ROWS_OF_BLOCK[compression];
  if (!rows || channels.some(c => !KIND_BYTES[c.kind])) throw new Error("an EXR compression that datasets do not have");
  if (!(width > 0 && height > 0) || width * height > MOST_PIXELS) throw new Error("an EXR of impossible size");
  const planes = {};
  for (const {name} of channels) if (!wanted || wanted.includes(name)) planes[name] = new Float32Array(width * height);
  const rowBytes = channels.reduce((sum, c) => sum + KIND_BYTES[c.kind] * width, 0);
  const blocks = Math.ceil(height / rows);
  reader.at += 8 * blocks;
  for (let block = 0; block < blocks; ++block) {
    const top = reader.int() - window[1], size = reader.int(), count = Math.min(rows, height - top);
    if (top < 0 || size < 0 || count <= 0 || reader.at + size > bytes.length) throw new Error("the EXR file is cut off");
    const stored = bytes.subarray(reader.at, reader.at + size);
    reader.at += size;
    const raw = size < rowBytes * count ? undoZip(await inflate(stored)) : stored;
    const view = new DataView(raw.buffer, raw.byteOffset, raw.byteLength);
    for (let row = 0, at = 0; row < count; ++row) {
      for (const {name, kind} of channels) {
        if (planes[name]) copyRow(view, at, kind, width, planes[name], (top + row) * width);
        at += KIND_BYTES[kind] * width;
      }
    }
  }
  return {width, height, planes};
}
