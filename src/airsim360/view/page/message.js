// Pictures in one binary message, from a live world or of a plan.
const KINDS = {f32: Float32Array, u32: Uint32Array, u16: Uint16Array, u8: Uint8Array};

/// {header, planes: {product: {width, height, planes}}, jpeg} of a message "A360".
export function readMessage(buffer) {
  const view = new DataView(buffer);
  if (view.getUint32(0) !== 0x41333630) throw new Error("the server says what this page does not understand");
  const length = view.getUint32(4, true), header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length)));
  const planes = {};
  let jpeg = null;
  for (const {product, plane, type, width, height, at, bytes} of header.planes) {
    if (type === "jpeg") { jpeg = new Blob([new Uint8Array(buffer, 8 + length + at, bytes)], {type: "image/jpeg"}); continue; }
    const Kind = KINDS[type];
    (planes[product] ??= {width, height, planes: {}}).planes[plane] = new Kind(buffer, 8 + length + at, bytes / Kind.BYTES_PER_ELEMENT);
  }
  return {header, planes, jpeg};
}
