// The air: extinction that falls with height, the light it adds, shadows of clouds. In the subset of shading_shared.h,
// after which it is included; not a normal header.

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

// Share of the weather's light in that of the way: of its optical depth and that of the clear air.
SHARED real fog_share(real fog, real clear) { return fog / rmax(fog + clear, real(1e-9f)); }

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

// How many ambient rays the probes stand for in tier `high`: none by day, four by night (from 3 to 1 lx of open sky, one lx
// being 1.5e-4), when the light of windows is met by one ray in tens.
SHARED real probe_rays(real open_sky) { return 4.0f * clamp01(1.5f - open_sky * (0.5f / 1.5e-4f)); }
