// What falls from the sky, and where fog begins: neither is under roofs. In the subset of shading_shared.h, after which it is
// included; not a normal header. Asks `roof_hides(ROOFS p)` whether something keeps rain off a point: ROOFS hands the map on
// (with its comma) where it is a parameter, ROOFS_ARGUMENT declares it; both are empty in GLSL. ROOFS_TEXELS_PER_METRE is the map's.

// Roofs are this much higher than what they keep dry, so that they are not taken for dry themselves.
#define ROOF_ABOVE 1.0f

// Share of the place about a surface's point that lies under a roof, 0 where the map is too coarse to tell the edge of a wall: of
// four points half a texel away, a little under the roof's own height.
SHARED real roof_share(ROOFS_ARGUMENT real3 p) {
  if (!(ROOFS_TEXELS_PER_METRE > 3.0f)) return real(0.0f);
  real3 q = make3(p.x, p.y, p.z + ROOF_ABOVE);
  real reach = real(0.5f / ROOFS_TEXELS_PER_METRE);
  real zero = real(0.0f);
  real share = zero;
  for (int i = 0; i < 4; i++) {
    real side = i < 2 ? 0.0f - reach : reach;
    real along = (i & 1) == 0 ? 0.0f - reach : reach;
    share = share + sel(roof_hides(ROOFS q + make3(side, along, zero)), real(0.25f), zero);
  }
  return share;
}

// Metres along a ray that are under roofs from its origin on: up to the open, to within a hand's breadth near by and a fiftieth
// of the way far away, `distance` at the most. Steps grow, so that a gap far away may be missed.
SHARED real roofed_way(ROOFS_ARGUMENT real3 o, real3 d, real distance) {
  mask_t under = roof_hides(ROOFS o);
  if (!any_lane(under)) return real(0.0f);
  real inside = real(0.0f);
  real outside = real(0.0f);
  real t = real(0.5f);
  mask_t walking = under;
  for (int i = 0; i < 14; i++) {
    mask_t hidden = walking && roof_hides(ROOFS o + d * t);
    inside = sel(hidden, t, inside);
    outside = sel(walking && !hidden, t, outside);
    walking = hidden;
    t = t * 1.5f;
  }
  for (int i = 0; i < 5; i++) {
    real middle = (inside + outside) * 0.5f;
    mask_t hidden = roof_hides(ROOFS o + d * middle);
    inside = sel(hidden, middle, inside);
    outside = sel(hidden, outside, middle);
  }
  return sel(under, sel(walking, distance, rmin(outside, distance)), real(0.0f));
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
// the share of places with a drop; `spread` the ray's width per metre. The frame leans: a point is `lean` metres farther along x
// in W for each metre of height.
SHARED real drops_cover(ROOFS_ARGUMENT ufloat lean, real ox, real oy, real oz, real3 d, real reach, ufloat spread, ufloat cell,
                        ufloat period, ufloat streak, ufloat radius, ufloat keep, ufloat range, ufloat seed) {
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
    real hidden = sel(there, amount * fade, real(0.0f));
    if (any_lane(hidden > 0.0f)) {
      real height = oz + d.z * t;
      mask_t dry = roof_hides(ROOFS make3(ox + d.x * t + height * lean, oy + d.y * t, height));
      hidden = sel(dry, real(0.0f), hidden);
    }
    seen = seen * (1.0f - hidden);
    // The next column.
    mask_t along_x = next_x < next_y;
    cx = cx + sel(along_x, sx, real(0.0f));
    cy = cy + sel(along_x, real(0.0f), sy);
    next_x = next_x + sel(along_x, step_x, real(0.0f));
    next_y = next_y + sel(along_x, real(0.0f), step_y);
  }
  return 1.0f - seen;
}

// A flake is opaque. A drop is before a point of its streak for a part of the exposure alone (Garg & Nayar, "Vision and Rain", 2007),
// a fiftieth for these lengths; six times as much, so that a light rain shows.
#define ROOFS_DROP_OPACITY 0.12f

// Share of places that hold a drop, for a rate in mm/h: the number of drops grows with a power of the rate (Marshall & Palmer 1948:
// N ~ R^0.21 times their size; drawn are those large enough to see).
SHARED ufloat places_kept(ufloat rate, ufloat per_place) { return rate * per_place < 0.95f ? rate * per_place : 0.95f; }

// Share of a ray's light that rain hides. In the leaning frame drops fall straight down.
SHARED real rain_hides(ROOFS_ARGUMENT ufloat rate, real3 o, real3 d, real reach, ufloat spread) {
  real x = o.x - o.z * kRainLean;
  real3 s = make3(d.x - d.z * kRainLean, d.y, d.z);
  ufloat keep = places_kept(rate, 0.09f);
  real near = drops_cover(ROOFS kRainLean, x, o.y, o.z, s, reach, spread, 0.40f, 0.48f, 0.30f, 0.0016f, keep, 5.0f, 3.0f);
  real far = drops_cover(ROOFS kRainLean, x, o.y, o.z, s, reach, spread, 1.1f, 0.8f, 0.45f, 0.0045f, keep, 15.0f, 41.0f);
  return (1.0f - (1.0f - near) * (1.0f - far)) * ROOFS_DROP_OPACITY;
}

// The same of snow.
SHARED real snow_hides(ROOFS_ARGUMENT ufloat rate, real3 o, real3 d, real reach, ufloat spread) {
  ufloat keep = places_kept(rate, 0.28f);
  real near = drops_cover(ROOFS 0.0f, o.x, o.y, o.z, d, reach, spread, 0.30f, 0.13f, 0.0f, 0.0040f, keep, 4.5f, 5.0f);
  real far = drops_cover(ROOFS 0.0f, o.x, o.y, o.z, d, reach, spread, 0.75f, 0.24f, 0.0f, 0.0085f, keep, 11.0f, 53.0f);
  return 1.0f - (1.0f - near) * (1.0f - far);
}

// Of both.
SHARED real precipitation_hides(ROOFS_ARGUMENT ufloat rain, ufloat snow, real3 o, real3 d, real reach, ufloat spread) {
  real hidden = real(0.0f);
  if (rain > 0.0f) hidden = rain_hides(ROOFS rain, o, d, reach, spread);
  if (snow > 0.0f) hidden = hidden + (1.0f - hidden) * snow_hides(ROOFS snow, o, d, reach, spread);
  return hidden;
}
