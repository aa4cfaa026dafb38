// What surface.glsl adds to plain texture look-ups: render/shading/surface_detail.h for one lane.

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
    // Of the weights, not of `s`: hardware need not make 1 of a number over itself.
    w[k] = coarse && w[k] < best ? 0.0 : (s4 < 0.02 ? 0.0 : s4);
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
      view.open_sky > 0.0 ? clamp01(luminance(SampleProbes(p, facing, above, above).front) * (1.0 / view.open_sky)) * (1.0 - roof_share(p))
                          : 0.0;
  const bool leaf = k.kind == kFoliage, solid = k.kind != kGlass && k.kind != kWater;
  const int ground = int(m.ground + 0.5);
  const bool grass = ground == 4 || ground == 6;
  const float up = leaf ? max(abs(facing.z), grass ? 0.8 : 0.0) : facing.z;
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
