// Points of a pixel beside its centre, and random numbers as the CPU has them.

vec3 RayAt(GpuCamera camera, ivec2 p) {
  p = clamp(p, ivec2(0), ivec2(int(camera.width) - 1, int(camera.height) - 1));
  return Load3(camera.rays, uint(p.y) * camera.width + uint(p.x));
}

/// Direction in W through the point (dx, dy) from a canonical pixel's centre, with the sines and cosines of the angles that makes
/// in a panorama: of the azimuth, of the elevation.
vec3 RayThrough(GpuCamera camera, uvec2 pixel, vec2 at, vec4 turn) {
  const float dx = at.x, dy = at.y;
  if (camera.separable != 0) {
    const float sa = turn.x, ca = turn.y, sb = turn.z, cb = turn.w;
    const float st0 = camera.columns.v[3 * camera.stride + pixel.x], ct0 = camera.columns.v[4 * camera.stride + pixel.x];
    const float cp0 = camera.rows.v[pixel.y], sp0 = camera.rows.v[4 * camera.stride_rows + pixel.y];
    const float st = st0 * ca + ct0 * sa, ct = ct0 * ca - st0 * sa, sp = sp0 * cb + cp0 * sb, cp = cp0 * cb - sp0 * sb;
    return Turn(camera.R, vec3(cp * st, -sp, cp * ct));
  }
  // Between the neighbours' rays.
  const ivec2 p = ivec2(pixel);
  const vec3 here = RayAt(camera, p);
  const vec3 right = RayAt(camera, p + ivec2(1, 0)), left = RayAt(camera, p - ivec2(1, 0));
  const vec3 down = RayAt(camera, p + ivec2(0, 1)), up = RayAt(camera, p - ivec2(0, 1));
  if (right == vec3(0.0) || left == vec3(0.0) || up == vec3(0.0) || down == vec3(0.0)) return Turn(camera.R, here);
  return Turn(camera.R, normalize(here + dx * 0.5 * (right - left) + dy * 0.5 * (down - up)));
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
