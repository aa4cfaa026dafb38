// Points of a pixel beside its centre, and random numbers as the CPU has them.

/// The angle from a fisheye's axis at a distance from the centre of its picture (ThetaOfRadius); below 0: none.
float FisheyeTheta(GpuCamera camera, float r) {
  const float last = FisheyeRadius(camera, camera.max_theta);
  if (!(r <= last)) return -1.0;
  // Newton, kept inside a bracket that halves whenever a step would leave it.
  float low = 0.0, high = camera.max_theta, theta = min(r, camera.max_theta);
  for (int k = 0; k < 24; ++k) {
    const float t = theta * theta, error = FisheyeRadius(camera, theta) - r;
    if (error == 0.0) break;
    if (error > 0.0) high = theta;
    else low = theta;
    const float slope = 1.0 + t * (3.0 * camera.distortion[0] + t * (5.0 * camera.distortion[1] +
                                   t * (7.0 * camera.distortion[2] + t * 9.0 * camera.distortion[3])));
    float next = theta - error / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const float change = abs(next - theta);
    theta = next;
    if (change <= 1e-7 * theta) break;
  }
  return theta;
}

/// Direction through a point of a picture that is no panorama, in the frame of its projection; 0 0 0 = none.
vec3 ProjectionRay(GpuCamera camera, vec2 at) {
  const vec2 q = (at - vec2(camera.center[0], camera.center[1])) / vec2(camera.focal[0], camera.focal[1]);
  if (camera.projection == 1) return normalize(vec3(q, 1.0));
  const float r = length(q), theta = FisheyeTheta(camera, r);
  if (theta < 0.0) return vec3(0.0);
  return vec3(q * (r > 0.0 ? sin_approx(theta) / r : 1.0), cos_approx(theta));
}

/// Ray of a lens half a pixel or less from a pixel's centre; 0 0 0 = none, also where the centre has none. The rays of the
/// neighbours tell how it turns with the position, two steps of Newton the rest.
vec3 LensRayNear(GpuCamera camera, uvec2 pixel, vec2 at) {
  const uint w = camera.width, i = pixel.y * w + pixel.x;
  const vec3 c = Load3(camera.rays, i);
  if (c == vec3(0.0)) return c;
  vec3 turn[2];
  for (int axis = 0; axis < 2; ++axis) {
    const uint step = axis == 0 ? 1 : w, place = axis == 0 ? pixel.x : pixel.y, last = (axis == 0 ? w : camera.height) - 1;
    vec3 before = place > 0 ? Load3(camera.rays, i - step) : vec3(0.0);
    vec3 after = place < last ? Load3(camera.rays, i + step) : vec3(0.0);
    // On a border the next one continues the two that there are.
    if (before == vec3(0.0)) before = after == vec3(0.0) ? c : 2.0 * c - after;
    if (after == vec3(0.0)) after = 2.0 * c - before;
    turn[axis] = 0.5 * (after - before);
  }
  vec3 ray = normalize(c + at.x * turn[0] + at.y * turn[1]);
  const vec2 wanted = vec2(pixel) + 0.5 + at;
  for (int k = 0; k < 2; ++k) {
    const vec2 off = wanted - LensPixel(camera, ray);
    ray = normalize(ray + off.x * turn[0] + off.y * turn[1]);
  }
  return atan2_approx(length(ray.xy), ray.z) <= camera.max_theta ? ray : vec3(0.0);
}

/// Direction in W through the point (dx, dy) from a canonical pixel's centre, with the sines and cosines of the angles that makes
/// in a panorama: of the azimuth, of the elevation. 0 0 0: there is no ray.
vec3 RayThrough(GpuCamera camera, uvec2 pixel, vec2 at, vec4 turn) {
  if (camera.separable != 0) {
    const float sa = turn.x, ca = turn.y, sb = turn.z, cb = turn.w;
    const float st0 = camera.columns.v[3 * camera.stride + pixel.x], ct0 = camera.columns.v[4 * camera.stride + pixel.x];
    const float cp0 = camera.rows.v[pixel.y], sp0 = camera.rows.v[4 * camera.stride_rows + pixel.y];
    const float st = st0 * ca + ct0 * sa, ct = ct0 * ca - st0 * sa, sp = sp0 * cb + cp0 * sb, cp = cp0 * cb - sp0 * sb;
    return Turn(camera.R, vec3(cp * st, -sp, cp * ct));
  }
  if (camera.projection == 3) return Turn(camera.projection_R, LensRayNear(camera, pixel, at));
  return Turn(camera.projection_R, ProjectionRay(camera, vec2(pixel) + 0.5 + at));
}

/// Direction in W through a point of a canonical pixel, `s` being a row of camera.offsets: dx dy, then sines and cosines of the
/// angles that makes in a panorama.
vec3 SampleRay(GpuCamera camera, uvec2 pixel, uint s) {
  Floats o = camera.offsets;
  return RayThrough(camera, pixel, vec2(o.v[6 * s], o.v[6 * s + 1]),
                    vec4(o.v[6 * s + 2], o.v[6 * s + 3], o.v[6 * s + 4], o.v[6 * s + 5]));
}

// MixBits of base/random.h on 64 bits as (low, high), so that samples are the CPU's.
uvec2 Add(uvec2 a, uvec2 b) {
  uint carry;
  const uint low = uaddCarry(a.x, b.x, carry);
  return uvec2(low, a.y + b.y + carry);
}
uvec2 Times(uvec2 a, uvec2 b) {
  uint high, low;
  umulExtended(a.x, b.x, high, low);
  return uvec2(low, high + a.x * b.y + a.y * b.x);
}
uvec2 FoldDown(uvec2 a, int n) { return a ^ uvec2((a.x >> n) | (a.y << (32 - n)), a.y >> n); }
uvec2 Mix(uvec2 x) {
  x = Add(x, uvec2(0x7f4a7c15u, 0x9e3779b9u));
  x = Times(FoldDown(x, 30), uvec2(0x1ce4e5b9u, 0xbf58476du));
  x = Times(FoldDown(x, 27), uvec2(0x133111ebu, 0x94d049bbu));
  return FoldDown(x, 31);
}

/// Index of the pixel beside (x, y) of a picture's rows in k: left, right, up, down; its own beyond a border.
uint Beside(GpuCamera camera, ivec2 at, int k) {
  const int w = int(camera.width), h = int(camera.height);
  int x = at.x + (k == 0 ? -1 : k == 1 ? 1 : 0);
  const int y = clamp(at.y + (k == 2 ? -1 : k == 3 ? 1 : 0), 0, h - 1);
  x = camera.separable != 0 ? (x + w) % w : clamp(x, 0, w - 1);
  return uint(y * w + x);
}
