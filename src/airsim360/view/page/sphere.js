// Geometry of pictures, the same for drawing, clicks and labels. Nothing here knows the page.
//
// Camera frame C: +X right, +Y down, +Z forward. Equirectangular, as docs/reference/projection.md: the centre of pixel (i, j) is at
// (i + 0.5, j + 0.5); azimuth theta = 2 pi (x / W - 0.5) grows to the right, elevation phi = pi (0.5 - y / H) upwards.

const TWO_PI = 2 * Math.PI;

/// Unit ray in C of a point (x, y) of a W x H panorama.
export function rayOfPoint(x, y, w, h) {
  const theta = TWO_PI * (x / w - 0.5), phi = Math.PI * (0.5 - y / h);
  return [Math.cos(phi) * Math.sin(theta), -Math.sin(phi), Math.cos(phi) * Math.cos(theta)];
}

/// The point of a W x H panorama that a ray in C meets; 0 <= x <= W.
export function pointOfRay([x, y, z], w, h) {
  const theta = Math.atan2(x, z), phi = Math.atan2(-y, Math.hypot(x, z));
  return [(theta / TWO_PI + 0.5) * w, (0.5 - phi / Math.PI) * h];
}

/// The pixel that a point lies in; columns wrap, rows end.
export function pixelOfPoint([x, y], w, h) {
  const column = Math.floor(x) % w;
  return [column < 0 ? column + w : column, Math.min(h - 1, Math.max(0, Math.floor(y)))];
}

/// Matrix of a quaternion, row by row.
export function matrixOf([w, x, y, z]) {
  return [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
          2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
          2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)];
}
export function turn(m, [x, y, z]) {
  return [m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z, m[6] * x + m[7] * y + m[8] * z];
}
export function turnBack(m, [x, y, z]) {
  return [m[0] * x + m[3] * y + m[6] * z, m[1] * x + m[4] * y + m[7] * z, m[2] * x + m[5] * y + m[8] * z];
}

/// Where one looks in a picture, and how it lies on a screen of `width` x `height` CSS pixels. On the sphere: an ideal lens that
/// looks to yaw (to the right) and pitch (up). Flat: the picture as it is stored, with that direction in the middle.
export class Look {
  constructor() {
    Object.assign(this, {yaw: 0, pitch: 0, fov: 1.3, flat: false, width: 1, height: 1});
  }
  set(yaw, pitch, fov = this.fov) {
    this.yaw = yaw - TWO_PI * Math.round(yaw / TWO_PI);
    this.pitch = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, pitch));
    this.fov = Math.min(2.2, Math.max(0.05, fov));
  }
  /// From the screen's frame (right, down, into the screen) to C.
  matrix() {
    const ct = Math.cos(this.yaw), st = Math.sin(this.yaw), cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
    return [ct, st * sp, st * cp, 0, cp, -sp, -st, ct * sp, ct * cp];
  }
  /// CSS pixels from the middle of the screen to where a ray 45 degrees off meets it.
  focal() { return this.height / 2 / Math.tan(this.fov / 2); }
  /// CSS pixels of one pixel of a flat picture.
  scale(w, h) { return Math.min(this.width / w, this.height / h) * Math.max(1, 1.3 / this.fov); }
  /// The point of the picture in the middle of the screen.
  middle(w, h) { return [(this.yaw / TWO_PI + 0.5) * w, (0.5 - this.pitch / Math.PI) * h]; }

  /// Point of the picture under a place of the screen.
  pointAt(sx, sy, w, h) {
    const dx = sx - this.width / 2, dy = sy - this.height / 2;
    if (this.flat) {
      const [cx, cy] = this.middle(w, h), s = this.scale(w, h);
      return [cx + dx / s, cy + dy / s];
    }
    const f = this.focal();
    return pointOfRay(turn(this.matrix(), [dx / f, dy / f, 1]), w, h);
  }
  /// Pixel under a place of the screen; null beside the picture.
  pixelAt(sx, sy, w, h, wraps = true) {
    const point = this.pointAt(sx, sy, w, h);
    if (this.flat && (point[1] < 0 || point[1] >= h || (!wraps && (point[0] < 0 || point[0] >= w)))) return null;
    return pixelOfPoint(point, w, h);
  }
  /// Place on the screen of a point of the picture; null behind one's back.
  screenOf(x, y, w, h, wraps = true) {
    if (this.flat) {
      const [cx, cy] = this.middle(w, h), s = this.scale(w, h);
      const dx = x - cx, across = wraps ? dx - w * Math.round(dx / w) : dx;
      return [this.width / 2 + across * s, this.height / 2 + (y - cy) * s];
    }
    const d = turnBack(this.matrix(), rayOfPoint(x, y, w, h));
    if (d[2] < 0.05) return null;
    const f = this.focal();
    return [this.width / 2 + f * d[0] / d[2], this.height / 2 + f * d[1] / d[2]];
  }
}
