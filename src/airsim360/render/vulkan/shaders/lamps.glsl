// Light of the lamps around a surface: render/shading/lights of one cell (render/lights/lamp_kernel.cc) for one lane.

struct LampEffect {
  vec3 direction, front, back, shine;
  float distance_, brought;
};

LampEffect EffectOfLamp(GpuLamp lamp, Ray ray, Shaded s) {
  LampEffect e;
  const bool leaf = s.kind == kFoliage;
  const bool shiny = !s.mirror && lamp_shines(s.kind, s.roughness, s.metallic);
  const vec3 to = Vec(lamp.center) - s.p;
  const float distance_ = lamp_distance(to);
  const vec3 w = to * (1.0 / distance_);
  const vec3 beam = Vec(lamp.beam);
  const float light =
      lamp_irradiance(lamp.body, -dot(Vec(lamp.facing), w), lamp.soft, lamp.radius, distance_, lamp.reach) *
      beam_shape(sqrt(dot(beam, beam)), -dot(beam, w), -w.z);
  const vec3 color = Vec(lamp.color) * light;
  const float n_dot_l = dot(s.n, w);
  e.front = color * (leaf || dot(s.g, w) > 0.0 ? max(n_dot_l, 0.0) : 0.0);
  e.back = leaf ? color * max(-n_dot_l, 0.0) : vec3(0.0);
  e.shine = vec3(0.0);
  e.brought = luminance(e.front) + luminance(e.back);
  if (shiny) {
    const vec3 h = normalize3(w - ray.direction), f0 = lamp_skin(s.color, s.metallic);
    const vec3 f = lamp_highlight(f0, s.roughness * s.roughness, lamp.radius, distance_, n_dot_l,
                                  max(-dot(s.n, ray.direction), kViewCosine), max(dot(s.n, h), 0.0), clamp01(dot(w, h)));
    e.shine = min(f * e.front, vec3(kBrightestGlint));
    e.brought += luminance(e.shine);
  }
  e.direction = w;
  e.distance_ = distance_ - lamp.radius * kLampEnd;
  return e;
}

/// The strongest lamps: those that deserve a ray, and how far its answer replaces the guess of the cell's corners.
struct LampChoice {
  int lamp[3];
  float rank[3], guess[3];
};

/// Adds to front, back and shine of `s` what the lamps of its cell bring, as the corners of the cell see them.
LampChoice LightByLamps(Ray ray, inout Shaded s) {
  LampChoice best;
  for (int k = 0; k < 3; ++k) best.lamp[k] = -1, best.rank[k] = best.guess[k] = 0.0;
  if (view.has_lamps == 0) return best;
  const vec3 at = (s.p - Vec(view.lamp_origin)) * view.lamp_cells_per_metre;
  const ivec3 n = ivec3(view.lamp_n[0], view.lamp_n[1], view.lamp_n[2]);
  if (!(all(greaterThanEqual(at, vec3(0.0))) && all(lessThan(at, vec3(n))))) return best;
  const ivec3 i = ivec3(at);
  const uint cell = view.lamp_cell_of.v[(i.z * n.y + i.y) * n.x + i.x];
  if (cell == 0) return best;
  const vec3 f = at - vec3(i);
  const uint header = view.lamp_cells.v[16 * cell];
  const int count = int(header & 255u);

  // Corners that are not in solids.
  float weight[8];
  float sum = 0.0;
  for (int k = 0; k < 8; ++k) {
    const float w = ((k & 1) != 0 ? f.x : 1.0 - f.x) * ((k & 2) != 0 ? f.y : 1.0 - f.y) * ((k & 4) != 0 ? f.z : 1.0 - f.z);
    weight[k] = (header >> (8 + k) & 1u) != 0 ? w + kCornerWeight : 0.0;
    sum += weight[k];
  }
  const float scale = sum > 0.0 ? 1.0 / sum : 0.0;

  // All of them as the corners see them; the three that bring most.
  float total = 0.0;
  for (int k = 0; k < count; ++k) {
    const uint entry = view.lamp_cells.v[16 * cell + 1 + k], seen = entry >> 24;
    const LampEffect e = EffectOfLamp(view.lamps.v[entry & 0xffffffu], ray, s);
    float g = 0.0;
    for (int c = 0; c < 8; ++c) g += float((seen >> c) & 1u) * weight[c] * scale;
    s.lamp_front += e.front * g, s.lamp_back += e.back * g, s.lamp_shine += e.shine * g;
    const float r = e.brought * (kUnseenLamp + (1.0 - kUnseenLamp) * g);
    total += r;
    int place = 3;
    while (place > 0 && r > best.rank[place - 1]) --place;
    for (int j = 2; j > place; --j)
      best.rank[j] = best.rank[j - 1], best.lamp[j] = best.lamp[j - 1], best.guess[j] = best.guess[j - 1];
    if (place < 3) best.rank[place] = r, best.lamp[place] = int(entry & 0xffffffu), best.guess[place] = g;
  }
  for (int k = 0; k < 3; ++k) {
    if (!(best.rank[k] > kFaintLamp * total)) best.rank[k] = 0.0, best.lamp[k] = -1;
  }
  return best;
}

/// How far the ray to lamp k counts; 0 = not at all.
float ShareOf(LampChoice best, int k) {
  return best.lamp[k] < 0 ? 0.0 : min(2.0 * (best.rank[k] - best.rank[2]) / best.rank[k], 1.0);
}
