// Water and snow on surfaces in the subset of shading_shared.h, after which it is included in the same way.

// Albedo of a rough porous surface under a film of water (Lekner & Dorf 1988): light that left the surface is
// partly thrown back at the water's inner face and hits it again. n = 1.33: of diffuse light from below
// 1 - (1 - 0.066) / n^2 = 0.472 comes back, 0.02 is reflected before it enters.
SHARED real wet_albedo(real albedo) { return 0.98f * 0.528f * albedo / (1.0f - 0.472f * albedo); }

// How much of a surface's look a film of water changes: rough mineral and organic matter soaks, skin does not
// (thresholds after Lagarde 2013).
SHARED real porosity(real roughness, real metallic) { return clamp01((roughness - 0.42f) * 3.5f) * (1.0f - metallic); }

// Standing water, 0 … 1, on level ground: hollows of `relief` (mean 0.5, sd about 0.13) fill up to a level
// that rises with wetness; nothing below wetness 0.35, about a third of the ground at 1.
SHARED real puddle_cover(real relief, real wetness) {
  real level = 0.14f + 0.31f * wetness;
  real full = smooth01(clamp01((level - relief) * 26.0f));
  return full * clamp01((wetness - 0.35f) * 4.0f);
}

// Share of a place that snow of `depth` (0 … 1) hides: `up` is the z of the normal, `relief` noise of mean
// 0.5 that makes the edge ragged, `exposed` how much of the sky is open above.
SHARED real snow_cover(real depth, real up, real relief, real exposed) {
  real steep = clamp01((up - 0.42f + 0.5f * (relief - 0.5f)) * 3.6f);
  real lying = depth * exposed * 2.2f;
  return smooth01(clamp01((lying * steep - (0.22f + 0.95f * (relief - 0.30f))) * 4.5f)) * steep;
}

// Slope of the rings that drops make on standing water: one ring per cell of 0.16 m and layer, its age and
// centre hashed. `amount` 0 … 1 is the share of cells with a drop.
SHARED void drop_rings(real px, real py, real amount, INOUT(real) slope_x, INOUT(real) slope_y) {
  real sx = real(0.0f);
  real sy = real(0.0f);
  for (int k = 0; k < 2; k++) {
    real gx = px * 6.25f + 0.5f * float(k);
    real gy = py * 6.25f + 0.31f * float(k);
    real cx = rfloor(gx);
    real cy = rfloor(gy);
    real h = hash_cell(cx + 17.0f * float(k), cy);
    real age = hash_again(h, real(91.7f));
    real ox = gx - cx - 0.5f - 0.3f * (hash_again(h, real(37.1f)) - 0.5f);
    real oy = gy - cy - 0.5f - 0.3f * (hash_again(h, real(53.9f)) - 0.5f);
    real r = rroot(ox * ox + oy * oy + 1e-6f);
    real wave = (r - 0.32f * age) * 12.0f;
    real ring = clamp01(1.0f - rabs(wave)) * wave * 3.0f * (1.0f - age) * sel(h < amount, real(1.0f), real(0.0f));
    sx = sx + ring * ox / r;
    sy = sy + ring * oy / r;
  }
  slope_x = sx * 0.35f;
  slope_y = sy * 0.35f;
}
