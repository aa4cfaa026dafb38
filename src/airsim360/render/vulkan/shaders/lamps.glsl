// Light of the lamps around a surface: render/shading/lights of one cell (render/lights/lamp_kernel.cc) for one lane.

struct LampEffect {
  vec3 direction, front, back, shine;
  float distance_, brought;
};

LampEffect EffectOfLamp(GpuLamp lamp, Ray ray, Shaded s) {
  LampEffect e;
  const bool leaf = s.kind == kFoliage;
  const bool shiny = !s.mirror && !leaf && (s.roughness < 0.6 || s.metallic > 0.2);
  const vec3 to = Vec(lamp.center) - s.p;
  const float distance_ = sqrt(max(dot(to, to), 1e-8));
  const vec3 w = to * (1.0 / distance_);
  const float light =
      lamp_irradiance(lamp.body, -dot(Vec(lamp.facing), w), lamp.soft, lamp.radius, distance_, lamp.reach);
  const vec3 color = Vec(lamp.color) * light;
  const float n_dot_l = dot(s.n, w);
  e.front = color * (leaf || dot(s.g, w) > 0.0 ? max(n_dot_l, 0.0) : 0.0);
  e.back = leaf ? color * max(-n_dot_l, 0.0) : vec3(0.0);
  e.shine = vec3(0.0);
  e.brought = luminance(e.front) + luminance(e.back);
  if (shiny) {
    const vec3 h = normalize3(w - ray.direction), f0 = lerp3(vec3(0.04), s.color, s.metallic);
    const float alpha = min(max(s.roughness * s.roughness, 0.006) + 0.5 * lamp.radius / distance_, 1.0);
    const vec3 f = specular_brdf(f0, alpha, max(n_dot_l, 1e-3), max(-dot(s.n, ray.direction), 0.02),
                                 max(dot(s.n, h), 0.0), clamp01(dot(w, h)));
    e.shine = min(f * e.front, vec3(400.0));
    e.brought += luminance(e.shine);
  }
  e.direction = w;
  e.distance_ = distance_ - lamp.radius * 1.02;
  return e;
}

/// Adds to front, back and shine of `s` what the lamps of its cell bring; `rays` of the strongest are looked at.
void LightByLamps(Ray ray, inout Shaded s, int rays) {
  if (view.has_lamps == 0) return;
  const vec3 at = (s.p - Vec(view.lamp_origin)) * view.lamp_cells_per_metre;
  const ivec3 n = ivec3(view.lamp_n[0], view.lamp_n[1], view.lamp_n[2]);
  if (!(all(greaterThanEqual(at, vec3(0.0))) && all(lessThan(at, vec3(n))))) return;
  const ivec3 i = ivec3(at);
  const uint cell = view.lamp_cell_of.v[(i.z * n.y + i.y) * n.x + i.x];
  if (cell == 0) return;
  const vec3 f = at - vec3(i);
  const uint header = view.lamp_cells.v[16 * cell];
  const int count = int(header & 255u);

  // Corners that are not in solids.
  float weight[8];
  float sum = 0.0;
  for (int k = 0; k < 8; ++k) {
    const float w = ((k & 1) != 0 ? f.x : 1.0 - f.x) * ((k & 2) != 0 ? f.y : 1.0 - f.y) * ((k & 4) != 0 ? f.z : 1.0 - f.z);
    weight[k] = (header >> (8 + k) & 1u) != 0 ? w + 1e-4 : 0.0;
    sum += weight[k];
  }
  const float scale = sum > 0.0 ? 1.0 / sum : 0.0;

  // All of them as the corners see them; the three that bring most.
  int best[3] = int[3](-1, -1, -1);
  float rank[3] = float[3](0.0, 0.0, 0.0), guess[3] = float[3](0.0, 0.0, 0.0);
  float total = 0.0;
  for (int k = 0; k < count; ++k) {
    const uint entry = view.lamp_cells.v[16 * cell + 1 + k], seen = entry >> 24;
    const LampEffect e = EffectOfLamp(view.lamps.v[entry & 0xffffffu], ray, s);
    float g = 0.0;
    for (int c = 0; c < 8; ++c) g += float((seen >> c) & 1u) * weight[c] * scale;
    s.lamp_front += e.front * g, s.lamp_back += e.back * g, s.lamp_shine += e.shine * g;
    const float r = e.brought * (0.15 + 0.85 * g);
    total += r;
    int place = 3;
    while (place > 0 && r > rank[place - 1]) --place;
    for (int j = 2; j > place; --j) rank[j] = rank[j - 1], best[j] = best[j - 1], guess[j] = guess[j - 1];
    if (place < 3) rank[place] = r, best[place] = int(entry & 0xffffffu), guess[place] = g;
  }
  for (int k = 0; k < 3; ++k) {
    if (!(rank[k] > 0.01 * total)) rank[k] = 0.0, best[k] = -1;
  }
  for (int k = 0; k < rays; ++k) {
    if (best[k] < 0) continue;
    const float share = min(2.0 * (rank[k] - rank[2]) / rank[k], 1.0);
    if (share == 0.0) continue;
    const LampEffect e = EffectOfLamp(view.lamps.v[best[k]], ray, s);
    const float lift = RayOffset(s.p, ray.distance_);
    const float seen = e.distance_ <= lift
                           ? 1.0
                           : Seen(s.p + s.g * (dot(s.g, e.direction) < 0.0 ? -lift : lift), e.direction, e.distance_);
    const float more = (seen - guess[k]) * share;
    s.lamp_front += e.front * more, s.lamp_back += e.back * more, s.lamp_shine += e.shine * more;
  }
}
