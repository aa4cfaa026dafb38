// shading_air.h applied to an AirView: included after it by shading_scalar.h and shading_simd.h, not in GLSL.

SHARED ufloat3 ufloat3_of(const float* p) { return ufloat3{p[0], p[1], p[2]}; }

/// What a way through the air does to light behind it: light * kept + added.
struct AirEffect {
  real3 kept, added;
};

SHARED AirEffect air_effect(real3 depth, real3 source) {
  // Little air, as near by, by the series of the exponential.
  const real3 one = make3(real(1.0f), real(1.0f), real(1.0f));
  real3 kept = one - depth * (one - depth * (one * real(0.5f) - depth * real(0.16666667f)));
  const mask_t thick = rmax(depth.x, rmax(depth.y, depth.z)) >= 0.01f;
  if (any_lane(thick)) {
    kept = sel3(thick, make3(exp_approx(0.0f - depth.x), exp_approx(0.0f - depth.y), exp_approx(0.0f - depth.z)), kept);
  }
  return {kept, source * make3(1.0f - kept.x, 1.0f - kept.y, 1.0f - kept.z)};
}

SHARED real3 weather_source(const AirView& air, real mu) {
  return ufloat3_of(air.weather_glow) * forward_phase(kFogAsymmetry, mu) + ufloat3_of(air.weather_light);
}

/// The way to a surface: from height z of W along d; fog begins after `free` metres.
SHARED AirEffect air_to_surface(const AirView& air, real z, real3 d, real distance, real free = real(0.0f)) {
  real height = z - air.base_z;
  real3 depth = ufloat3_of(air.rayleigh) * layer_path(height, d.z, distance, air.rayleigh_height) +
                ufloat3_of(air.aerosol) * layer_path(height, d.z, distance, air.aerosol_height);
  real mu = dot3(d, ufloat3_of(air.to_sun));
  real3 glow = ufloat3_of(air.glow) * forward_phase(kAirAsymmetry, mu);
  real3 source =
      around_horizon(ufloat3_of(air.horizon[0]), ufloat3_of(air.horizon[1]), ufloat3_of(air.horizon[2]), ufloat3_of(air.horizon[3]),
                     ufloat3_of(air.horizon[4]), ufloat3_of(air.horizon[5]), ufloat3_of(air.horizon[6]), d);
  source = source * make3(glow.x + 1.0f, glow.y + 1.0f, glow.z + 1.0f);
  if (air.weather > 0.0f) {
    // Both media are taken as evenly mixed along the way.
    real fog = air.weather * layer_path(height + d.z * free, d.z, distance - free, air.weather_height);
    source = lerp3(source, weather_source(air, mu), fog_share(fog, depth.y));
    depth = make3(depth.x + fog, depth.y + fog, depth.z + fog);
  }
  return air_effect(depth, source);
}

/// The way to the sky, whose table holds the clear air already, over `distance` (kFarAir, or to far ground).
SHARED AirEffect air_to_sky(const AirView& air, real z, real3 d, real distance, real free = real(0.0f)) {
  real fog = air.weather * layer_path(z - air.base_z + d.z * free, d.z, distance - free, air.weather_height);
  return air_effect(make3(fog, fog, fog), weather_source(air, dot3(d, ufloat3_of(air.to_sun))));
}
