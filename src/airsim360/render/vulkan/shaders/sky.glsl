// Light from tables: sky, probes, air, shadows of clouds (render/shared/shading_ambient.h, shading_air_view.h).

vec3 SampleSky(GpuSky table, vec3 d, bool full_sphere) {
  float column = atan2_approx(d.y, d.x) * (table.width / (2.0 * SHADE_PI)) - 0.5;
  column = column < 0.0 ? column + table.width : column;
  float e = asin_approx(min(max(d.z, -1.0), 1.0)) * (2.0 / SHADE_PI);
  float t = 0.5 + 0.5 * e;
  if (!full_sphere) t = sky_row(max(e, 0.0));
  const float row = clamp01(t) * (table.height - 1.0);
  const float x = min(table.width - 1.0, max(0.0, floor(column)));
  const float y = min(table.height - 2.0, max(0.0, floor(row)));
  const uint i = uint(int(y) * table.stride + int(x)) * 4, below = uint(table.stride) * 4;
  const float fx = column - x, fy = row - y;
  Floats f = table.texels;
  const vec3 a = vec3(f.v[i], f.v[i + 1], f.v[i + 2]), b = vec3(f.v[i + 4], f.v[i + 5], f.v[i + 6]);
  const uint j = i + below;
  const vec3 c = vec3(f.v[j], f.v[j + 1], f.v[j + 2]), e2 = vec3(f.v[j + 4], f.v[j + 5], f.v[j + 6]);
  return lerp3(lerp3(a, b, fx), lerp3(c, e2, fx), fy);
}

/// 0: the sky; 1 ... 3: blurred; 4: what lies below the horizon.
GpuSky TableOf(int k) {
  if (k == 0) return view.sky;
  if (k == 4) return view.below;
  return view.blurred[k - 1];
}

float CloudShadow(vec3 p) {
  if (view.has_clouds == 0) return 1.0;
  const float size = float(view.cloud_size), above = p.z - view.cloud_plane_z;
  const float x = shadow_column(p.x, above, view.cloud_slant[0], view.cloud_origin[0], view.cloud_cells_per_metre, size);
  const float y = shadow_column(p.y, above, view.cloud_slant[1], view.cloud_origin[1], view.cloud_cells_per_metre, size);
  const float x0 = floor(x), y0 = floor(y), fx = x - x0, fy = y - y0;
  const int i = int(y0) * view.cloud_size + int(x0);
  Floats q = view.cloud_texels;
  const float low = q.v[i] + (q.v[i + 1] - q.v[i]) * fx;
  const int j = i + view.cloud_size;
  const float high = q.v[j] + (q.v[j + 1] - q.v[j]) * fx;
  return low + (high - low) * fy;
}

/// Sky, and ground below the horizon, blurred as by a surface of this roughness.
vec3 BlurredSky(vec3 d, float roughness) {
  const vec3 shares = blur_shares(roughness);
  vec3 c = vec3(0.0);
  [[dont_unroll]] for (int k = 0; k < 4; ++k) {
    const float share = k == 0 ? 1.0 : shares[k - 1];
    if (!(share > 0.0)) break;
    vec3 table = SampleSky(TableOf(k), d, k > 0);
    if (k == 0 && !(d.z > 0.0)) table = lerp3(table, Vec(view.ground), ground_share(d.z));
    c = lerp3(c, table, share);
  }
  return c;
}

/// Irradiance on the front, on the back, and about the reflected direction.
struct Ambient {
  vec3 front, back, reflected;
};

vec3 Coefficient(int k) {
  return vec3(view.sky_irradiance[3 * k], view.sky_irradiance[3 * k + 1], view.sky_irradiance[3 * k + 2]);
}
vec3 UniformFrom(vec3 a) {
  const vec3 e = sh9_irradiance(Coefficient(0), Coefficient(1), Coefficient(2), Coefficient(3), Coefficient(4),
                                Coefficient(5), Coefficient(6), Coefficient(7), Coefficient(8), a);
  const float has_sky = view.has_sky != 0 ? 1.0 : 0.0;
  return max(e + Vec(view.ground) * ((0.5 - 0.5 * a.z) * SHADE_PI * has_sky) + Vec(view.mean_ambient) * SHADE_PI,
             vec3(0.0));
}

/// The eight probes around a point of a surface.
struct ProbeCell {
  uint lowest;  // where the numbers of the lowest corner begin in view.probes
  vec3 inside;  // place between its corners, 0 … 1
};
ProbeCell ProbeCellAt(vec3 p, vec3 normal) {
  const float cells = view.probe_cells_per_metre;
  const vec3 q = p + normal * (kProbeBias / cells);
  const float x = min(view.probe_max[0] + kProbeReach, max(0.0, (q.x - view.probe_origin[0]) * cells));
  const float y = min(view.probe_max[1] + kProbeReach, max(0.0, (q.y - view.probe_origin[1]) * cells));
  const float h = min(view.height_last, max(0.0, (q.z - view.height_origin) * view.height_scale));
  const float z = view.layer_of_height.v[int(floor(h + 0.5))];
  const float x0 = min(floor(x), view.probe_max[0]), y0 = min(floor(y), view.probe_max[1]),
              z0 = min(floor(z), view.probe_max[2]);
  return ProbeCell(uint(int(z0) * view.probe_stride_z + int(y0) * view.probe_stride_y + int(x0)) * 16,
                   vec3(x - x0, y - y0, z - z0));
}

Ambient SampleProbes(vec3 p, vec3 g, vec3 n, vec3 r) {
  Ambient out_light;
  if (view.has_probes == 0) {
    out_light.front = UniformFrom(n), out_light.back = UniformFrom(-n), out_light.reflected = UniformFrom(r);
    return out_light;
  }
  const ProbeCell cell = ProbeCellAt(p, g);
  const vec3 f = cell.inside;
  float t[16];
  for (int j = 0; j < 16; ++j) t[j] = 0.0;
  for (int k = 0; k < 8; ++k) {
    const float w = ((k & 1) != 0 ? f.x : 1.0 - f.x) * ((k & 2) != 0 ? f.y : 1.0 - f.y) * ((k & 4) != 0 ? f.z : 1.0 - f.z);
    const uint at = cell.lowest + ((k & 1) != 0 ? 16u : 0u) + ((k & 2) != 0 ? uint(view.probe_stride_y) * 16u : 0u) +
                    ((k & 4) != 0 ? uint(view.probe_stride_z) * 16u : 0u);
    for (int j = 0; j < 16; ++j) t[j] += view.probes.v[at + j] * w;
  }
  const float scale = 1.0 / t[3];
  const vec3 even0 = vec3(t[0], t[1], t[2]) * scale, square = vec3(t[7], t[11], t[15]) * scale;
  const vec3 tx = vec3(t[4], t[5], t[6]) * scale, ty = vec3(t[8], t[9], t[10]) * scale,
             tz = vec3(t[12], t[13], t[14]) * scale;
  const vec3 even = even0 + square * (n.z * n.z), bent = tx * n.x + ty * n.y + tz * n.z;
  out_light.front = max(even + bent, vec3(0.0));
  out_light.back = max(even - bent, vec3(0.0));
  out_light.reflected = max(even0 + tx * r.x + ty * r.y + tz * r.z + square * (r.z * r.z), vec3(0.0));
  return out_light;
}

struct AirEffect {
  vec3 kept, added;
};
AirEffect EffectOf(vec3 depth, vec3 source) {
  AirEffect a;
  a.kept = vec3(exp_approx(-depth.x), exp_approx(-depth.y), exp_approx(-depth.z));
  a.added = source * (vec3(1.0) - a.kept);
  return a;
}
vec3 WeatherSource(float mu) { return Vec(view.weather_glow) * forward_phase(kFogAsymmetry, mu) + Vec(view.weather_light); }
vec3 Horizon(int k) { return vec3(view.horizon[3 * k], view.horizon[3 * k + 1], view.horizon[3 * k + 2]); }

/// Metres of a way that are free of fog.
float FreeOfFog(vec3 o, vec3 d, float distance_) { return view.weather > 0.0 ? roofed_way(o, d, distance_) : 0.0; }

AirEffect AirToSurface(vec3 o, vec3 d, float distance_) {
  const float height = o.z - view.base_z;
  vec3 depth = Vec(view.rayleigh) * layer_path(height, d.z, distance_, view.rayleigh_height) +
               Vec(view.aerosol) * layer_path(height, d.z, distance_, view.aerosol_height);
  const float mu = dot(d, Vec(view.air_to_sun));
  const vec3 glow = Vec(view.glow) * forward_phase(kAirAsymmetry, mu);
  vec3 source = around_horizon(Horizon(0), Horizon(1), Horizon(2), Horizon(3), Horizon(4), Horizon(5), Horizon(6), d) *
                (glow + 1.0);
  if (view.weather > 0.0) {
    const float free = FreeOfFog(o, d, distance_);
    const float fog = view.weather * layer_path(height + d.z * free, d.z, distance_ - free, view.weather_height);
    source = lerp3(source, WeatherSource(mu), fog_share(fog, depth.y));
    depth += fog;
  }
  return EffectOf(depth, source);
}
AirEffect AirToSky(vec3 o, vec3 d, float distance_) {
  const float free = FreeOfFog(o, d, distance_);
  const float fog = view.weather * layer_path(o.z - view.base_z + d.z * free, d.z, distance_ - free, view.weather_height);
  return EffectOf(vec3(fog), WeatherSource(dot(d, Vec(view.air_to_sun))));
}

/// What a ray that met nothing sees.
vec3 LookUpSky(vec3 o, vec3 d, bool sun_disc) {
  if (view.has_sky == 0) return vec3(0.0);
  const vec3 up = vec3(d.xy, abs(d.z));
  const bool down = d.z < 0.0, ground = down && view.has_below == 0;
  vec3 c = Vec(view.ground);
  if (!ground) c = SampleSky(TableOf(down ? 4 : 0), up, false);
  if (ground || (!down && view.weather > 0.0)) {
    AirEffect air;
    if (ground) air = AirToSurface(o, d, ground_distance(o.z - view.ground_z, d.z));
    else air = AirToSky(o, up, kFarAir);
    c = c * air.kept + air.added;
  }
  if (sun_disc) {
    const vec3 off = d - Vec(view.to_sun);
    const float x2 = dot(off, off) * (1.0 / (SUN_RADIUS * SUN_RADIUS));
    if (x2 < 1.0 && view.moon_gain > 0.0)
      c += Vec(view.sun_radiance) * (moon_face(off * (1.0 / SUN_RADIUS), Vec(view.to_sun), Vec(view.moon_light)) * (view.moon_gain * view.sun_seen));
    else if (x2 < 1.0) c += Vec(view.sun_radiance) * (sun_limb(x2) * (SUN_LIMB_GAIN * view.sun_seen));
  }
  return c;
}
