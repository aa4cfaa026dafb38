// Rain and snow in the air before the picture: render/shading/precipitation_kernel.cc for one lane.

/// Share of the light along a ray that drops and flakes hide; they add view.drop_light of it.
float Hidden(vec3 o, vec3 d, float reach, float spread) {
  float hidden = 0.0;
  if (view.rain > 0.0) {
    // Rain leans with the wind: in the leaning frame drops fall straight down.
    const float x = o.x - o.z * 0.12, keep = min(view.rain * 0.09, 0.95);
    const vec3 s = vec3(d.x - d.z * 0.12, d.y, d.z);
    const float near = drops_cover(0.12, x, o.y, o.z, s, reach, spread, 0.40, 0.48, 0.30, 0.0016, keep, 5.0, 3.0);
    const float far = drops_cover(0.12, x, o.y, o.z, s, reach, spread, 1.1, 0.8, 0.45, 0.0045, keep, 15.0, 41.0);
    hidden = (1.0 - (1.0 - near) * (1.0 - far)) * 0.12;
  }
  if (view.snow > 0.0) {
    const float keep = min(view.snow * 0.28, 0.95);
    const float near = drops_cover(0.0, o.x, o.y, o.z, d, reach, spread, 0.30, 0.13, 0.0, 0.0040, keep, 4.5, 5.0);
    const float far = drops_cover(0.0, o.x, o.y, o.z, d, reach, spread, 0.75, 0.24, 0.0, 0.0085, keep, 11.0, 53.0);
    hidden += (1.0 - hidden) * (1.0 - (1.0 - near) * (1.0 - far));
  }
  return hidden;
}

vec3 BehindDrops(vec3 light, vec3 o, vec3 d, float reach, float spread) {
  if (view.rain + view.snow <= 0.0) return light;
  return lerp3(light, Vec(view.drop_light), Hidden(o, d, reach, spread));
}
