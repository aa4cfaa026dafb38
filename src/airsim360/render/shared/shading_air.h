// The air: extinction that falls with height, the light it adds, shadows of clouds, rain and snow. In the
// subset of shading_shared.h, after which it is included; not a normal header.

// How many scale heights below its base a layer still grows denser, and how many a ray may go down.
#define AIR_DEEPEST 2.0f
#define AIR_STEEPEST 60.0f

// Path through a layer whose extinction falls as exp(-height / scale): in metres of its extinction at height
// 0. `height` of the origin, `slope` = sine of the ray's elevation.
SHARED real layer_path(real height, real slope, real distance, ufloat scale) {
  real x = rmax(slope * distance * (1.0f / scale), real(-AIR_STEEPEST));
  // (1 - exp(-x)) / x, by its series where that would cancel.
  real mean = 1.0f - x * (0.5f - x * 0.16666667f);
  mask_t large = rabs(x) >= 1e-2f;
  if (any_lane(large)) {
    real large_x = rmax(rabs(x), real(1e-2f));
    real divided = sel(x < 0.0f, 0.0f - large_x, large_x);
    mean = sel(large, (1.0f - exp_approx(0.0f - divided)) / divided, mean);
  }
  return exp_approx(0.0f - rmax(height * (1.0f / scale), real(-AIR_DEEPEST))) * distance * mean;
}

// Henyey-Greenstein of asymmetry g times 4 pi: 1 on average over the sphere.
SHARED real forward_phase(ufloat g, real mu) {
  real d = 1.0f + g * g - 2.0f * g * mu;
  return (1.0f - g * g) / rmax(d * rroot(d), real(1e-4f));
}

// A function of azimuth as seven harmonics of the horizontal direction.
SHARED real3 around_horizon(ufloat3 c0, ufloat3 cx, ufloat3 cy, ufloat3 cxx, ufloat3 cxy, ufloat3 cx3, ufloat3 cy3, real3 d) {
  real x2 = d.x * d.x;
  real y2 = d.y * d.y;
  real3 c = cx * d.x + cy * d.y + cxx * (x2 - y2) + cxy * (2.0f * d.x * d.y);
  c = c + cx3 * (d.x * (x2 - 3.0f * y2)) + cy3 * (d.y * (3.0f * x2 - y2));
  c = c + c0;
  return make3(rmax(c.x, real(0.0f)), rmax(c.y, real(0.0f)), rmax(c.z, real(0.0f)));
}

// Where a point's shadow coordinate lies in the cloud shadow map, in texels of [0, size - 1): `along` the
// axis, moved to the map's plane along the sun's ray.
SHARED real shadow_column(real along, real above, ufloat slant, ufloat origin, ufloat cells_per_metre, ufloat size) {
  real x = (along - above * slant) * cells_per_metre + origin;
  return rmin(rmax(x, real(0.0f)), real(size - 1.001f));
}

// ---- rain and snow
// Drops fall along lines, one in each column of a square lattice of the world; a ray walks the columns that
// it crosses (Amanatides & Woo 1987) and meets the line in each.

SHARED real fract1(real x) { return x - rfloor(x); }

// Three numbers in [0, 1) from three of small magnitude (after Hoskins' "hash without sine", 2014).
SHARED real3 hash3(real x, real y, real z) {
  real a = fract1(x * 0.1031f);
  real b = fract1(y * 0.1030f);
  real c = fract1(z * 0.0973f);
  real m = a * (b + 33.33f) + b * (a + 33.33f) + c * (c + 33.33f);
  a = a + m;
  b = b + m;
  c = c + m;
  return make3(fract1((a + b) * c), fract1((a + a) * b), fract1((b + a) * a));
}

// Share of a ray's light that drops of one lattice hide. Lengths in metres: `cell` of the lattice, `period`
// between drops of a line, `streak` their blurred length (0: a round flake), `radius` of a drop; `keep` is
// the share of places with a drop; `spread` the ray's width per metre.
SHARED real drops_cover(real ox, real oy, real oz, real3 d, real reach, ufloat spread, ufloat cell, ufloat period, ufloat streak,
                        ufloat radius, ufloat keep, ufloat range, ufloat seed) {
  real px = ox * (1.0f / cell);
  real py = oy * (1.0f / cell);
  real cx = rfloor(px);
  real cy = rfloor(py);
  real sx = sel(d.x < 0.0f, real(-1.0f), real(1.0f));
  real sy = sel(d.y < 0.0f, real(-1.0f), real(1.0f));
  real step_x = cell / rmax(rabs(d.x), real(1e-5f));
  real step_y = cell / rmax(rabs(d.y), real(1e-5f));
  real next_x = sel(d.x < 0.0f, px - cx, cx + 1.0f - px) * step_x;
  real next_y = sel(d.y < 0.0f, py - cy, cy + 1.0f - py) * step_y;
  real flat2 = rmax(d.x * d.x + d.y * d.y, real(1e-6f));
  real seen = real(1.0f);
  for (int i = 0; i < 18; i++) {
    // The line of this column, well inside it, and where the ray passes closest.
    real3 h = hash3(cx, cy, real(seed));
    real ax = (cx + 0.1f + 0.8f * h.x) * cell - ox;
    real ay = (cy + 0.1f + 0.8f * h.y) * cell - oy;
    real t = (ax * d.x + ay * d.y) / flat2;
    real offset_x = d.x * t - ax;
    real offset_y = d.y * t - ay;
    real off2 = offset_x * offset_x + offset_y * offset_y;
    // The drop of the line there.
    real along = (oz + d.z * t) * (1.0f / period) + h.z;
    real which = rfloor(along);
    real3 drop = hash3(cx + 17.0f, cy, which + seed);
    real size = 0.6f + 0.7f * drop.y;
    real z = (along - which - 0.5f) * period;
    real wide = rmax(radius * size, spread * 0.6f * t);
    real thin = radius * size / wide;
    real ends = rmax(rabs(z) - streak * 0.5f * size, real(0.0f));
    real inside = rmax(1.0f - (off2 + ends * ends) / (wide * wide), real(0.0f));
    // What a pixel shows of a drop smaller than itself: a line loses width, a flake area.
    real amount = inside * rmin(real(1.0f), 1.5f * (streak > 0.0f ? thin : thin * thin * 1.4f));
    real fade = clamp01((t - 0.35f) * 2.5f) * clamp01(2.0f - 2.0f * t * (1.0f / range));
    mask_t there = (drop.x < keep) && (t < reach);
    seen = seen * (1.0f - sel(there, amount * fade, real(0.0f)));
    // The next column.
    mask_t along_x = next_x < next_y;
    cx = cx + sel(along_x, sx, real(0.0f));
    cy = cy + sel(along_x, real(0.0f), sy);
    next_x = next_x + sel(along_x, step_x, real(0.0f));
    next_y = next_y + sel(along_x, real(0.0f), step_y);
  }
  return 1.0f - seen;
}
