// What back ends read from tables of the sky and how they mix it, in the subset of shading_shared.h, after which it is included in
// the same way.

// Row of an elevation e (share of a right angle) in a table of the upper hemisphere, as a share of its rows: the inverse of
// SkyTable::ElevationOfRow with kSkyRowSlope = 0.6.
SHARED real sky_row(real e) { return (rroot(0.36f + 1.6f * e) - 0.6f) * 1.25f; }

// Share of the ground below the horizon of a sharp picture of the sky.
SHARED real ground_share(real down) { return clamp01(down * -12.0f); }

// How a surface's roughness mixes the blurred pictures of the sky over the sharp one: 0.05, 0.30, 0.55, 0.85 of the four.
SHARED real3 blur_shares(real roughness) {
  return make3(clamp01((roughness - 0.05f) * 4.0f), clamp01((roughness - 0.30f) * 4.0f), clamp01((roughness - 0.55f) * (1.0f / 0.30f)));
}

// Part of the open sky and ground that reaches a place: by the light around it and that in the open.
SHARED real open_share(real around, real open) { return rmin(around / rmax(open, real(1e-4f)), real(1.0f)); }

// How far away the ground is `height` below along a direction that falls by `down`.
SHARED real ground_distance(real height, real down) { return rmax(height, real(2.0f)) / rmax(0.0f - down, real(1e-4f)); }

// The sun's disc of 0.53 degrees, darker towards its limb: 1 - 0.6 (1 - mu) (Hestroffer & Magnan 1998, mid-visible), by the square
// of the distance from its middle in radii; times SUN_LIMB_GAIN its mean is 1.
#define SUN_LIMB_GAIN 1.25f
SHARED real sun_limb(real x2) { return 0.4f + 0.6f * rroot(rmax(1.0f - x2, real(0.0f))); }

// Share of ambient light that something `reach` or less above level ground leaves.
SHARED real contact_share(real distance, real reach) {
  real t = rmin(real(1.0f), distance / reach);
  return 0.25f + (1.0f - 0.25f) * t * t * (3.0f - 2.0f * t);
}
