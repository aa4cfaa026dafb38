// Rain and snow in the air before the picture: render/shading/precipitation_kernel.cc for one lane.

/// Share of the light along a ray that drops and flakes hide; they add view.drop_light of it.
float Hidden(vec3 o, vec3 d, float reach, float spread) { return precipitation_hides(view.rain, view.snow, o, d, reach, spread); }

vec3 BehindDrops(vec3 light, vec3 o, vec3 d, float reach, float spread) {
  if (view.rain + view.snow <= 0.0) return light;
  return lerp3(light, Vec(view.drop_light), Hidden(o, d, reach, spread));
}
