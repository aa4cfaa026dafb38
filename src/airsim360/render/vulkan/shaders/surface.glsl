// From a hit to a surface: render/shading/surface_kernel.cc and surface_detail.h for one lane.

struct Ray {
  vec3 origin, direction;
  float distance_, width;
  vec2 bary;
  uint instance, primitive, key;
};

struct Shaded {
  vec3 p, n, g;
  vec3 color, emission;
  float metallic, roughness, transmission, coat, coat_roughness, kind;
  vec3 r;       // reflected direction
  bool mirror;  // reflects sharply enough for a traced ray
  vec3 l;       // towards the sun
  float sunlit; // 1 if the sun can matter; then the share of it that is seen
  float contact;
  bool traced, clear;
  vec3 reflected, behind;
  vec3 lamp_front, lamp_back, lamp_shine;  // of lamps: irradiance, and what the skin reflects
};

vec3 Row3(float m[9], vec3 a) { return normalize3(Turn(m, a)); }

struct TileCorners {
  float u[3], v[3], weight[3], gain;
};

TileCorners ChooseCorners(GpuMaterial m, float u, float v, float footprint) {
  TileCorners c;
  for (int k = 0; k < 3; ++k) c.u[k] = u, c.v[k] = v, c.weight[k] = k == 0 ? 1.0 : 0.0;
  c.gain = 1.0;
  if (!(m.blend > 0.5)) return c;
  const float cell = 1.0 / 0.75;
  const float q = (u - 0.57735027 * v) * cell, r = 1.15470054 * v * cell;
  const float q0 = floor(q), r0 = floor(r), a = q - q0, b = r - r0;
  const bool lower = a + b < 1.0;
  float w[3] = float[3](lower ? 1.0 - a - b : a + b - 1.0, lower ? a : 1.0 - b, lower ? b : 1.0 - a);
  const float far = lower ? 0.0 : 1.0;
  const float cq[3] = float[3](q0 + far, q0 + 1.0, q0), cr[3] = float[3](r0 + far, r0, r0 + 1.0);
  const bool coarse = footprint > -2.0;
  const float best = max(w[0], max(w[1], w[2]));
  float sum = 0.0, squares = 0.0;
  for (int k = 0; k < 3; ++k) {
    const float s = w[k] / best, s2 = s * s, s4 = s2 * s2;
    w[k] = coarse && s < 1.0 ? 0.0 : (s4 < 0.02 ? 0.0 : s4);
    sum += w[k];
  }
  for (int k = 0; k < 3; ++k) {
    w[k] = w[k] / sum;
    squares += w[k] * w[k];
    const float h = hash_cell(cq[k], cr[k]);
    c.u[k] = u + h;
    c.v[k] = v + hash_again(h, 97.3);
    c.weight[k] = w[k];
  }
  c.gain = 1.0 / sqrt(squares);
  return c;
}

/// Mix of the copies of one texture; `gain` spreads it about `mean` in every channel.
vec3 SampleTiles(bool mixes, uint id, TileCorners c, float footprint, bool trilinear, vec3 mean, float gain) {
  vec3 sum = vec3(0.0);
  [[dont_unroll]] for (int k = 0; k < 3; ++k) {
    if (k > 0 && !(c.weight[k] > 0.0)) continue;
    const vec3 one = SampleTexture(id, c.u[k], c.v[k], footprint, trilinear);
    if (!mixes) return one;
    sum += (one - mean) * c.weight[k];
  }
  const vec3 mixed = mean + sum * gain;
  return vec3(clamp01(mixed.x), clamp01(mixed.y), clamp01(mixed.z));
}

/// The textures of a material: base colour, roughness and metal, normal, emission.
struct Sampled {
  vec3 texel[4];
};
Sampled SampleAll(GpuMaterial m, TileCorners corners, float tu, float tv, float footprint) {
  const uint ids[4] = uint[4](m.base_texture, m.roughness_texture, m.normal_texture, m.emission_texture);
  const vec3 means[4] = vec3[4](Vec(m.mean), vec3(1.0, 0.5, 1.0), vec3(0.5, 0.5, 0.9), vec3(0.0));
  Sampled out_texels;
  [[dont_unroll]] for (int k = 0; k < 4; ++k) {
    if (k == 3) corners.u[0] = tu, corners.v[0] = tv;
    vec3 c = vec3(1.0);
    if (ids[k] != 0) c = SampleTiles(m.blend > 0.5 && k < 3, ids[k], corners, footprint, k == 0 || k == 3, means[k],
                                     k == 1 ? 1.0 : corners.gain);
    out_texels.texel[k] = c;
  }
  return out_texels;
}

struct Noises {
  vec3 wide, mid, fine;
  float detail, wall;
};
Noises LookUpNoises(bool wants_fine, float wall, vec3 p, vec3 n, float width) {
  const float px = p.x + 0.41 * p.z * n.x, py = p.y + 0.37 * p.z;
  Noises o;
  o.detail = min(1.0, 0.5 / max(width, 1e-3));
  o.fine = vec3(0.5);
  o.wall = wall;
  float bend_x = 0.0, bend_y = 0.0, x = px * (1.0 / 311.0), y = py * (1.0 / 311.0);
  [[dont_unroll]] for (int k = 0; k < 3; ++k) {
    const vec3 noise = SampleNoise(x, y);
    if (k == 0) {
      // The wider noise bends the finer ones, so that their periods do not line up.
      o.wide = noise;
      bend_x = (noise.y - 0.5) * 0.9, bend_y = (noise.z - 0.5) * 0.9;
      x = px * (1.0 / 47.0) + 0.37 + bend_x, y = py * (1.0 / 47.0) + bend_y;
    } else if (k == 1) {
      o.mid = noise;
      if (!(wants_fine || wall > 0.0) || !(width < 5.0)) break;
      x = (px * 0.83 + py * 0.56) * (1.0 / 11.3) + (o.mid.y - 0.5) * 0.6 + bend_x;
      y = (py * 0.83 - px * 0.56) * (1.0 / 11.3) + (o.mid.z - 0.5) * 0.6;
      if (wall > 0.0) x = (p.y * n.x - p.x * n.y) * (1.0 / 4.7), y = p.z * (1.0 / 67.0);
    } else {
      o.fine = noise;
    }
  }
  return o;
}

vec3 MacroTint(GpuMaterial m, Noises s, float width) {
  const float fade = min(1.0, 6.0 / max(width, 1e-3)), amount = m.macro_variation * 2.0;
  const float light = (s.wide.x - 0.5) * 1.1 + (s.mid.x - 0.5) * 0.9 * fade;
  const float warm = (s.wide.y - 0.5) * 0.35 + (s.mid.y - 0.5) * 0.2 * fade;
  return max(vec3(1.0 + amount * (light + warm), 1.0 + amount * light, 1.0 + amount * (light - warm)), vec3(0.35));
}

vec3 UnitTint(GpuMaterial m, float u, float v, float footprint) {
  if (!(m.unit_columns > 0.5)) return vec3(1.0);
  const float row = floor(v * m.unit_rows);
  const float column = floor(u * m.unit_columns + 0.5 * (row - 2.0 * floor(row * 0.5)));
  const float h = hash_cell(column, row), h2 = hash_again(h, 61.7);
  const float keep = clamp01(1.3 - exp2_approx(footprint) * max(m.unit_columns, m.unit_rows) * 0.7);
  const float light = 1.0 + (h - 0.5) * 0.24 * keep, warm = (h2 - 0.5) * 0.07 * keep;
  return vec3(light + warm, light, light - warm);
}

void WearGround(GpuMaterial m, Noises s, vec3 p, float u, float width, inout vec3 color, inout float roughness) {
  const int ground = int(m.ground + 0.5);
  if (ground == 1 || ground == 2) {
    float gain = 1.0, tar = 0.0, polish = 0.0;
    asphalt_wear(p.x, p.y, u * m.tile, ground == 2 ? 1.0 : 0.0, s.wide, s.mid, s.fine, s.detail, width, gain, tar, polish);
    color = asphalt_marks(color * gain, p.x, p.y, s.wide, s.mid, s.fine, s.detail, width);
    color = lerp3(color, vec3(0.034, 0.034, 0.035), tar);
    roughness = lerp1(roughness - polish, 0.45, tar);
  } else if (ground == 3) {
    color *= paving_wear(s.wide, s.mid, s.fine, s.detail);
    color = paving_marks(color, p.x, p.y, s.wide, s.mid, s.fine, s.detail, width);
  } else if (ground == 4) {
    color = lawn_life(color, p.x, p.y, s.wide, s.mid, s.fine, s.detail, width);
  } else if (ground == 5 || ground == 6) {
    color = loose_ground(color, s.wide, s.mid, s.fine, s.detail, ground == 5 ? 0.35 : 1.0);
  } else if (ground == 7 || ground == 8) {
    color *= roof_wear(p.x, s.wide, s.mid, s.fine, s.detail, width, ground == 8 ? 1.0 : 0.0);
  }
}

vec3 GlassNormal(float h1, vec3 n, vec3 p) {
  const float h2 = h1 * 61.7 - floor(h1 * 61.7);
  const float side = sqrt(max(n.x * n.x + n.y * n.y, 1e-8));
  if (!(side > 0.3)) return n;
  const vec3 across = vec3(-n.y, n.x, 0.0) * (1.0 / side);
  const float along = (p.x * across.x + p.y * across.y) * 2.1 + h1 * 40.0;
  const float bend = sin_approx(along) * 0.0045, rise = sin_approx(p.z * 1.9 + h2 * 40.0) * 0.0045;
  return normalize3(n + across * ((h1 - 0.5) * 0.018 + bend) + vec3(0.0, 0.0, (h2 - 0.5) * 0.018 + rise));
}

vec3 Waves(vec3 p, float footprint, inout float lost) {
  const vec3 gust = SampleNoise(p.x * (1.0 / 173.0), p.y * (1.0 / 131.0));
  const float wind = max(0.75 + 2.6 * (gust.x - 0.5), 0.22);
  const vec3 n = water_normal(p.x + 5.0 * (gust.y - 0.5), p.y + 5.0 * (gust.z - 0.5), footprint, lost);
  lost = lost * wind * wind;
  return normalize3(vec3(n.x * wind, n.y * wind, n.z));
}

/// The sun's centre, or for samples beside the pixel's centre a point of its disc.
vec3 TowardsSun(uint key) {
  const vec3 s = Vec(view.to_sun);
  if (key == 0) return normalize3(s);
  uint h = (key ^ (key >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  h = h ^ (h >> 16);
  const float a = float((h >> 8) & 0xfffu) * (1.0 / 4096.0), b = float((h >> 20) & 0xfffu) * (1.0 / 4096.0);
  const float radius = sqrt(a) * 0.00462, angle = b * (2.0 * SHADE_PI);
  const float flat2 = s.x * s.x + s.y * s.y;
  const vec3 e1 = flat2 > 1e-6 ? vec3(-s.y, s.x, 0.0) / sqrt(flat2) : vec3(1.0, 0.0, 0.0);
  return normalize3(e1 * (radius * sin_approx(angle + 0.5 * SHADE_PI)) + cross(s, e1) * (radius * sin_approx(angle)) + s);
}

float FoldPicture(float x, float half_) {
  return abs(x) > half_ ? (x > 0.0 ? 2.0 * half_ - x : -2.0 * half_ - x) : x;
}

/// What weather changes about a surface.
struct Skin {
  vec3 color;
  float metallic, roughness, coat, coat_roughness, transmission, kind;
  vec3 n, emission;
};

/// Film of water with puddles, then snow over it (LieWeather of surface_detail.h).
void LieWeather(GpuMaterial m, Noises s, vec3 p, vec3 facing, float width, float u, inout Skin k) {
  const vec3 above = vec3(0.0, 0.0, 1.0);
  const float open =
      view.open_sky > 0.0 ? clamp01(luminance(SampleProbes(p, facing, above, above).front) * (1.0 / view.open_sky)) : 0.0;
  const bool leaf = k.kind == kFoliage, solid = k.kind != kGlass && k.kind != kWater;
  const float up = leaf ? abs(facing.z) : facing.z;
  const int ground = int(m.ground + 0.5);
  const bool grass = ground == 4 || ground == 6;
  const float lane = (abs(abs(u * m.tile) - 1.72) - 0.78) * (1.0 / 0.32);
  const float track = ground == 2 ? exp_approx(-lane * lane) : 0.0;
  if (view.wetness > 0.0) {
    const float exposed = smooth01(clamp01((open - 0.12) * 5.0)) * (0.12 + 0.88 * clamp01(up * 2.0 + 0.2));
    const float film = solid ? clamp01(view.wetness * exposed * (1.15 + 1.2 * (s.mid.y - 0.5))) : 0.0;
    const float soak = film * porosity(k.roughness, k.metallic);
    k.color = lerp3(k.color, vec3(wet_albedo(k.color.x), wet_albedo(k.color.y), wet_albedo(k.color.z)), soak);
    // Puddles on level ground, the first of them in the wheel tracks.
    const float level = grass || facing.z < 0.97 || leaf ? 0.0 : 1.0;
    const float relief = 0.55 * s.mid.x + 0.30 * s.fine.y + 0.15 * s.wide.y - 0.035 * track;
    const float puddle = puddle_cover(relief, view.wetness * exposed) * level;
    float ring_x = 0.0, ring_y = 0.0;
    if (view.drops > 0.0 && puddle > 0.0) {
      drop_rings(p.x, p.y, view.drops, ring_x, ring_y);
      const float near = clamp01(0.06 / max(width, 1e-3));
      ring_x *= near, ring_y *= near;
    }
    // The film follows the relief less than the stone does; standing water not at all.
    k.n = normalize3(lerp3(k.n, facing, max(puddle, leaf ? 0.0 : film * 0.55)));
    k.n = normalize3(k.n + vec3(ring_x * puddle, ring_y * puddle, 0.0));
    const float sheen = film * (leaf || grass ? 0.35 : 0.75) * (1.0 - 0.5 * k.metallic);
    const float water = max(sheen, puddle);
    if (water > k.coat) k.coat_roughness = lerp1(0.34 - 0.14 * film, 0.03, puddle);
    k.coat = max(k.coat, water);
  }
  if (view.lying_snow > 0.0) {
    const float exposed =
        smooth01(clamp01((open - 0.15) * 3.4)) * (1.0 - 0.62 * track) * (m.ground > 0.5 && !grass ? 0.85 : 1.0);
    const float relief = 0.45 * s.mid.z + 0.55 * s.fine.x;
    const float cover =
        solid || (k.kind == kGlass && up > 0.25) ? snow_cover(view.lying_snow, up, relief, exposed) : 0.0;
    const vec3 white = vec3(0.83, 0.85, 0.88) * (0.97 + 0.25 * (s.fine.z - 0.5));
    // Some slush stays dark at the edge.
    k.color = lerp3(k.color, white, cover);
    k.metallic *= 1.0 - cover;
    k.roughness = lerp1(k.roughness, 0.75, cover);
    k.coat *= 1.0 - cover;
    k.transmission *= 1.0 - 0.8 * cover;
    k.emission *= 1.0 - cover;
    const vec3 soft = normalize3(facing + vec3(s.fine.x - 0.5, s.fine.y - 0.5, 0.0) * 0.30);
    if (!leaf) k.n = normalize3(lerp3(k.n, soft, cover));
    if (cover > 0.5 && !leaf) k.kind = 0.0;
  }
}

/// Emission as the instance colours it, the beam throws it along the ray's way back, and the window shares it out.
vec3 Thrown(GpuMaterial m, GpuTriangle t, float matrix[9], uint instance, float pane, vec3 d, vec3 emission) {
  if (view.has_glows != 0) emission *= Load3(view.glows, instance);
  if (m.beam == 0.0) return emission;
  if (m.beam == 1e6) return window_light(pane, t.area) * luminance(emission);  // kWindowBeam
  const vec3 axis = Row3(matrix, vec3(0.0, m.beam > 0.0 ? -1.0 : 1.0, m.beam > 10.0 ? -0.06 : 0.0));  // kLowBeam, kBeamDrop
  const float sharp = abs(m.beam);
  return emission * beam_shape(sharp, -sharp * dot(axis, d), -d.z);
}

Shaded Prepare(Ray ray) {
  const uint instance = ray.instance;
  GpuInstance placed = push.frame.v.instances.v[instance];
  GpuMesh mesh = push.frame.v.meshes.v[placed.mesh];
  const uint triangle = (mesh.flags & kSorted) != 0 ? mesh.triangle_of.v[ray.primitive] : ray.primitive;
  const GpuShaded own = view.instances.v[instance];
  const GpuTriangle t = view.triangles.v[own.first_triangle + triangle];
  const GpuMaterial m = view.materials.v[t.material & ~kMirroredUv];

  // Normals: cofactors of where the instance is now. Of bent meshes those of this instant.
  const vec3 r0 = vec3(placed.A[0], placed.A[1], placed.A[2]), r1 = vec3(placed.A[3], placed.A[4], placed.A[5]),
             r2 = vec3(placed.A[6], placed.A[7], placed.A[8]);
  vec3 c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
  const float det = dot(r0, c0);
  const float side = (det < 0.0 ? -1.0 : 1.0) / pow(max(abs(det), 1e-30), 2.0 / 3.0);
  c0 *= side, c1 *= side, c2 *= side;
  const float matrix[9] = float[9](c0.x, c0.y, c0.z, c1.x, c1.y, c1.z, c2.x, c2.y, c2.z);

  Shaded s;
  const vec3 d = ray.direction;
  const vec3 p = ray.origin + d * ray.distance_;
  const float u = ray.bary.x, v = ray.bary.y, w = 1.0 - u - v;
  vec3 g, smooth_;
  if (uvec2(placed.positions) == uvec2(mesh.positions)) {
    g = Row3(matrix, UnpackDirection(t.geometric_normal));
    smooth_ = Row3(matrix, UnpackDirection(t.normals[0]) * w + UnpackDirection(t.normals[1]) * u +
                               UnpackDirection(t.normals[2]) * v);
  } else {
    const uvec3 c = Corners(mesh, ray.primitive);
    const vec3 a = Load3(placed.positions, c.x);
    g = Row3(matrix, cross(Load3(placed.positions, c.y) - a, Load3(placed.positions, c.z) - a));
    smooth_ = g;
    if (placed.normals != 0) {
      // Means of the faces around, behind the positions.
      smooth_ = Row3(matrix, normalize3(Load3(placed.positions, placed.normals + c.x)) * w +
                                 normalize3(Load3(placed.positions, placed.normals + c.y)) * u +
                                 normalize3(Load3(placed.positions, placed.normals + c.z)) * v);
    }
  }
  const float front = dot(g, d) > 0.0 ? -1.0 : 1.0;
  const vec3 facing = g * front;
  vec3 n = (dot(smooth_, g) > 0.0 ? smooth_ : -smooth_) * front;

  float tu = t.uv[0] * w + t.uv[2] * u + t.uv[4] * v;
  float tv = t.uv[1] * w + t.uv[3] * u + t.uv[5] * v;
  const float slant = max(abs(dot(facing, d)), 0.03);
  const float footprint =
      log2_approx(max(ray.width, 1e-9)) - 0.75 * log2_approx(slant) + (t.texels_log2 + own.texels_log2);
  const float pane = HashOf(t.pane ^ own.hash);

  vec3 color = vec3(m.base[0] * own.tint[0], m.base[1] * own.tint[1], m.base[2] * own.tint[2]);
  const vec3 tint = color;
  color *= VertexColors(own, triangle, ray.bary);
  float metallic = m.metallic, roughness = m.roughness;
  vec3 emission = Vec(m.emission);

  // Rooms behind panes.
  const bool window = t.window != 0;
  vec3 daylight = vec3(0.0), lamplight = vec3(0.0);
  float room_front = 0.0;
  if (window) {
    const GpuPane q = view.panes.v[t.window - 1];
    const float a = q.a[0] * w + q.a[1] * u + q.a[2] * v, b = q.b[0] * w + q.b[1] * u + q.b[2] * v;
    const float room = HashOf((q.hash ^ own.hash) * 0x85ebca6bu + 77u);
    const bool lit = hash_again(room, 811.3) < view.lit_rooms || emission.x > 0.0;
    const vec3 light = view.evening > 0.0 ? evening_light(room, t.area) : day_light(room);
    float back_a = a, back_b = b;
    interior_room(a, b, q.half_a, q.half_b, dot(d, Row3(matrix, UnpackDirection(q.right))),
                  dot(d, Row3(matrix, UnpackDirection(q.up))), -dot(d, facing), room, lit ? light : vec3(0.0), daylight,
                  lamplight, room_front,
                  back_a, back_b);
    tu += (FoldPicture(back_a, q.half_a) - a) * q.u_per_a;
    tv += (min(max(back_b, -q.half_b), q.half_b) - b) * q.v_per_b;
  }

  // Textures.
  const TileCorners corners = ChooseCorners(m, tu, tv, footprint);
  const Sampled sampled = SampleAll(m, corners, tu, tv, footprint);
  color *= sampled.texel[0];
  roughness *= sampled.texel[1].y, metallic *= sampled.texel[1].z;
  emission *= sampled.texel[3];
  if (emission != vec3(0.0)) emission = Thrown(m, t, matrix, ray.instance, pane, d, emission);
  const bool wear = m.ground > 0.5;
  Noises noises;
  const bool weather = view.wetness > 0.0 || view.lying_snow > 0.0;
  if (m.macro_variation != 0.0 || wear || weather) noises = LookUpNoises(wear || weather, wall_share(m.macro_variation, m.ground, n.z), p, n, ray.width);
  if (m.macro_variation != 0.0)
    color *= MacroTint(m, noises, ray.width) * wall_wear(noises.wide, noises.mid, noises.fine, ray.width, noises.wall);
  color *= UnitTint(m, tu, tv, footprint);
  if (wear) WearGround(m, noises, p, tu, ray.width, color, roughness);
  if (m.kind == kFoliage) {
    const float amount = clamp01((m.transmission - 0.4) * 5.0), h2 = hash_again(pane, 61.7);
    const float light = 1.0 + (pane - 0.5) * 0.44 * amount, yellow = (h2 - 0.42) * 0.34 * amount;
    color = vec3(color.x * light * (1.0 + yellow), color.y * light, color.z * light * (1.0 - yellow * 0.6));
  }
  color = min(color, vec3(1.0));
  roughness = min(max(roughness, 0.03), 1.0);

  // Normal: map, panes, waves.
  if (m.normal_texture != 0) {
    const vec3 bend = sampled.texel[2] * 2.0 - 1.0;
    const float length_ = min(sqrt(dot(bend, bend)), 1.0);
    const vec3 t0 = Row3(matrix, UnpackDirection(t.tangent));
    const vec3 along = normalize3(t0 - n * dot(n, t0));
    const vec3 beside = cross(n, along) * ((t.material & kMirroredUv) != 0 ? -1.0 : 1.0);
    const vec3 bent = normalize3(along * (bend.x * m.normal_scale) + beside * (bend.y * m.normal_scale) + n * max(bend.z, 0.05));
    const float variance = (1.0 - length_) / max(length_, 0.2) * m.normal_scale * m.normal_scale;
    const float alpha = roughness * roughness;
    roughness = max(sqrt(sqrt(min(alpha * alpha + 2.0 * variance * variance + variance * 0.5, 1.0))), roughness);
    n = bent;
  }
  if (m.kind == kGlass) {
    n = GlassNormal(pane, n, p);
    roughness = min(roughness, 0.08);
    if (!window) {
      const float blind = clamp01((0.30 - pane) * 40.0) * clamp01((t.area - 0.7) * 4.0) * clamp01((0.3 - abs(facing.z)) * 8.0);
      const float shade = blind * 0.16 * (0.6 + 1.3 * pane);
      color = color * (1.0 - shade) + vec3(shade, shade * 0.97, shade * 0.88);
      // No two blinds or curtains have the same colour.
      if (m.transmission < 0.01 && luminance(color) > 0.10) {
        const float warm = 0.16 * (hash_again(pane, 61.7) - 0.5), light = 0.58 + 0.74 * pane;
        color = vec3(color.x * light * (1.0 + warm), color.y * light, color.z * light * (1.0 - warm));
      }
    }
  }
  if (window) {
    const float most = max(tint.x, max(tint.y, max(tint.z, 1e-3)));
    const vec3 glass = lerp3(vec3(0.86, 0.87, 0.86), tint * (0.8 / most), 0.5);
    if (m.base_texture == 0) {
      color = daylight * glass + tint * 0.15;
      emission = lamplight * glass * view.lamplight;
    } else if (room_front > 0.5) {
      color = daylight * 1.6;
      // By night what is displayed stands in the light of the shop alone.
      emission = emission * 0.25 + daylight * (view.evening > 0.0 ? 1.5 * view.lamplight : 0.5);
    }
  }
  if (m.kind == kWater && facing.z > 0.5) {
    float lost = 0.0;
    n = Waves(p, ray.width / sqrt(slant), lost);
    roughness = min(sqrt(sqrt(2.0 * lost + 1e-5)), 0.5);
  }
  Skin skin = Skin(color, metallic, roughness, m.clear_coat, m.clear_coat_roughness, m.transmission, m.kind, n, emission);
  if (weather) LieWeather(m, noises, p, facing, ray.width, tu, skin);
  n = skin.n;
  const float towards = dot(n, d);
  if (towards > -0.02) n = normalize3(n - d * (towards + 0.02));

  s.p = p, s.n = n, s.g = facing, s.color = skin.color;
  s.emission = front > 0.0 ? skin.emission : vec3(0.0);
  s.metallic = skin.metallic, s.roughness = skin.roughness, s.transmission = skin.transmission;
  s.coat = skin.coat, s.coat_roughness = skin.coat_roughness, s.kind = skin.kind;
  vec3 r = reflect3(d, n);
  const float below = dot(r, facing);
  if (below < 0.01) r = normalize3(r + facing * (0.02 - below));
  s.r = r;
  s.mirror = s.kind == kGlass || s.kind == kWater || (s.roughness < 0.12 && s.metallic > 0.3) ||
             (s.coat > 0.25 && s.coat_roughness < 0.12);
  s.l = TowardsSun(ray.key);
  // Leaves from behind, too, but nothing where the two normals disagree about the side.
  const float above = dot(n, s.l);
  const bool lit = above * dot(facing, s.l) > 0.0 && (above > 0.0 || s.kind == kFoliage);
  s.sunlit = lit && view.to_sun[2] > -0.02 && view.has_sky != 0 ? 1.0 : 0.0;
  s.contact = 1.0;
  s.traced = s.clear = false;
  s.reflected = s.behind = vec3(0.0);
  s.lamp_front = s.lamp_back = s.lamp_shine = vec3(0.0);
  return s;
}
