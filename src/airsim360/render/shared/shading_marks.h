// What feet, wheels and years leave on hard ground, down to millimetres: gum, drips, spills with rims, grime, cracks of
// every width, paint that has come off. In the subset of shading_shared.h, included after shading_ground.h (whose
// noises `wide`, `mid`, `fine` and whose `detail` and `width` it takes) in the same way.

// At most one spot in each square cell of side `cell` metres, in a share of the cells, of radius `least` to `most` (small
// ones are commoner), pulled out of round by `ragged` (0 = a disc). Out: `tone`, a hash of the spot; `rim`, 1 in a thin
// ring at its edge. 0 outside to 1 within; what is narrower than a pixel of size `width` fades with its area.
SHARED real ground_spot(real px, real py, float cell, real share, float least, float most, real ragged, real width, INOUT(real) tone,
                        INOUT(real) rim) {
  real cx = rfloor(px * (1.0f / cell));
  real cy = rfloor(py * (1.0f / cell));
  real h = hash_cell(cx, cy);
  real h1 = hash_again(h, real(41.3f));
  real h2 = hash_again(h, real(87.1f));
  real h3 = hash_again(h, real(171.7f));
  real radius = least + (most - least) * h1 * h1;
  real ox = px - (cx + 0.3f + 0.4f * h2) * cell;
  real oy = py - (cy + 0.3f + 0.4f * h3) * cell;
  real squeeze = 0.75f + 0.6f * hash_again(h, real(293.9f));
  real d = rroot(ox * ox * squeeze + oy * oy / squeeze) * (1.0f + ragged);
  real soft = rmax(width, 0.16f * radius);
  real thin = rmin(2.0f * radius / rmax(width, real(1e-4f)), real(1.0f));
  real there = sel(h < share, thin * thin, real(0.0f));
  tone = hash_again(h, real(521.3f));
  rim = clamp01(1.0f - rabs(d - 0.93f * radius) / rmax(0.09f * radius, width)) * there;
  return clamp01(0.5f + (radius - d) / soft) * there;
}

// Flags, setts and clinker: gum trodden flat (5 to 10 a square metre where many walk), spills with a rim, grime that
// takes the colour out of stones. `color` is what the stones show.
SHARED real3 paving_marks(real3 color, real px, real py, real3 wide, real3 mid, real3 fine, real detail, real width) {
  real tone = real(0.0f);
  real rim = real(0.0f);
  real3 c = color;
  // Grime lies in patches, more in the walked lines, and in the small hollows between.
  real walked = 0.55f * mid.x + 0.30f * wide.y + 0.15f * fine.x;
  real grime = smooth01(clamp01((walked - 0.43f) * 6.5f)) * (0.75f + 1.3f * (fine.y - 0.5f) * detail);
  c = lerp3(c, make3(real(0.072f), real(0.064f), real(0.055f)), 0.08f + 0.46f * clamp01(grime));
  real spill = ground_spot(px, py, 1.37f, 0.10f + 0.9f * (mid.z - 0.42f), 0.05f, 0.27f, 0.9f * (fine.z - 0.5f) * detail, width, tone, rim);
  c = c * (1.0f - (0.08f + 0.34f * tone) * spill) * (1.0f - 0.22f * rim);
  // Far away gum is too small to be seen.
  real close = clamp01((0.05f - width) * 40.0f);
  if (!any_lane(close > 0.0f)) return c;
  real gum = close * ground_spot(px, py, 0.21f, 0.10f + 1.6f * (mid.y - 0.40f), 0.007f, 0.020f, real(0.0f), width, tone, rim);
  real3 old_gum = sel3(tone < 0.78f, c * (0.42f + 0.25f * tone), make3(real(0.34f), real(0.33f), real(0.31f)));
  return lerp3(c, old_gum, 0.85f * gum);
}

// Asphalt and what is painted on it: drops of oil, cracks from a hair to a finger wide that meet in a net where the road
// is tired, grit; paint has come off there and where wheels go. Whatever is paler than any asphalt is paint.
SHARED real3 asphalt_marks(real3 color, real px, real py, real3 wide, real3 mid, real3 fine, real detail, real width) {
  real tone = real(0.0f);
  real rim = real(0.0f);
  real3 c = color;
  real tired = smooth01(clamp01((0.5f * wide.z + 0.5f * mid.x - 0.50f) * 9.0f));
  // Paint: gone in patches with torn edges, worn thin between.
  real paint = clamp01((luminance(c) - 0.22f) * 12.0f);
  real torn = 0.45f * mid.z + 0.35f * fine.x + 0.20f * wide.x + 0.12f * tired;
  real gone = clamp01((torn - 0.52f) * 16.0f);
  real thin = smooth01(clamp01((torn - 0.40f) * 6.0f));
  c = lerp3(c, make3(real(0.105f), real(0.103f), real(0.098f)), paint * (0.14f + 0.30f * thin + 0.48f * gone * (0.4f + 0.6f * detail)));
  // A net of cracks: level lines of two noises, wider in the middle of the tired part.
  real half_width = 0.0010f + 0.0050f * tired * clamp01(2.0f * mid.y - 0.4f);
  real net = rmax(soft_line((fine.y - 0.5f + 0.20f * (mid.x - 0.5f)) * 1.7f, half_width, width),
                  soft_line((fine.z - 0.48f) * 1.7f, half_width, width));
  c = c * (1.0f - 0.55f * net * tired * detail);
  real drop = ground_spot(px, py, 0.43f, 0.08f + 0.8f * (mid.y - 0.44f), 0.008f, 0.075f, 0.9f * (fine.x - 0.5f) * detail, width, tone, rim);
  c = c * (1.0f - (0.18f + 0.42f * tone) * drop);
  real close = clamp01((0.05f - width) * 40.0f);
  if (!any_lane(close > 0.0f)) return c;
  real grit = close * ground_spot(px, py, 0.083f, 0.10f + 0.5f * (mid.z - 0.45f), 0.0012f, 0.0055f, real(0.0f), width, tone, rim);
  return lerp3(c, make3(real(0.10f), real(0.095f), real(0.085f)) + make3(real(0.26f), real(0.24f), real(0.20f)) * tone, 0.8f * grit);
}
