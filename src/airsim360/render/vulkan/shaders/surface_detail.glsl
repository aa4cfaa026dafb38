// Look-ups of what render/shared/shading_surface.h makes surfaces of: render/shading/surface_detail.h for one lane.

vec3 Row3(float m[9], vec3 a) { return normalize3(Turn(m, a)); }

TileCorners ChooseCorners(GpuMaterial m, float u, float v, float footprint) {
  if (!(m.blend > 0.5)) return plain_tile(u, v);
  return mixed_tile(true, u, v, footprint);
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

/// The textures of a material: base colour with the tone of every slab or brick, roughness and metal, normal, emission.
struct Sampled {
  vec3 texel[4];
};
Sampled SampleAll(GpuMaterial m, TileCorners corners, float tu, float tv, float footprint, Stretch stretch) {
  const uint ids[4] = uint[4](m.base_texture, m.roughness_texture, m.normal_texture, m.emission_texture);
  const vec3 means[4] = vec3[4](Vec(m.mean), mean_roughness(), mean_normal(), vec3(0.0));
  const vec2 middle = vec2(corners.u[0], corners.v[0]);
  Sampled out_texels;
  [[dont_unroll]] for (int k = 0; k < 4; ++k) {
    // Base colours of slanted pixels are means of several places.
    const float taps = k == 0 ? stretch.taps : 1.0;
    vec3 sum = vec3(0.0);
    [[dont_unroll]] for (float i = 0.0; i < taps; i += 1.0) {
      const vec2 away = k == 0 ? vec2(stretch.u, stretch.v) * tap_at(i, taps) : vec2(0.0), at = k == 3 ? vec2(tu, tv) : middle + away;
      corners.u[0] = at.x, corners.v[0] = at.y;
      vec3 c = vec3(1.0);
      if (ids[k] != 0) c = SampleTiles(m.blend > 0.5 && k < 3, ids[k], corners, k == 0 ? stretch.footprint : footprint,
                                       k == 0 || k == 3, means[k], k == 1 ? 1.0 : corners.gain);
      if (k == 0) c *= unit_tint(m.unit_columns, m.unit_rows, tu + away.x, tv + away.y, stretch.footprint);
      sum += c;
    }
    out_texels.texel[k] = sum * (1.0 / taps);
  }
  return out_texels;
}

/// `wants_fine`: something but a wall asks for the finest noise.
Noises LookUpNoises(bool wants_fine, float wall, vec3 p, vec3 n, float width) {
  const PlanePoint plane = noise_plane(p, n);
  Noises o;
  o.detail = noise_detail(width);
  o.fine = vec3(0.5);
  o.wall = wall;
  PlanePoint at = wide_noise_at(plane);
  [[dont_unroll]] for (int k = 0; k < 3; ++k) {
    const vec3 noise = SampleNoise(at.x, at.y);
    if (k == 0) {
      o.wide = noise;
      at = mid_noise_at(plane, o.wide);
    } else if (k == 1) {
      o.mid = noise;
      if (!(wants_fine || wall > 0.0) || !shows_fine_noise(width)) break;
      at = fine_noise_at(plane, wall > 0.0, p, n, o.wide, o.mid);
    } else {
      o.fine = noise;
    }
  }
  return o;
}

/// Film of water with puddles, then snow over it.
void LieWeather(GpuMaterial m, Noises s, vec3 p, vec3 facing, float width, float u, inout Skin k) {
  const vec3 above = vec3(0.0, 0.0, 1.0);
  float open = 0.0;
  if (view.open_sky > 0.0)
    open = clamp01(luminance(SampleProbes(p, facing, above, above).front) * (1.0 / view.open_sky)) * (1.0 - roof_share(p));
  const Bed bed = bed_of(k, m.ground, facing, u * m.tile);
  if (view.wetness > 0.0) wet_skin(bed, s, p, facing, width, open, view.wetness, view.drops, k);
  if (view.lying_snow > 0.0) snowy_skin(bed, s, facing, open, view.lying_snow, k);
}

/// Emission as the instance colours it, the beam throws it along the ray's way back, and the window shares it out.
vec3 Thrown(GpuMaterial m, GpuTriangle t, float matrix[9], uint instance, float pane, vec3 d, vec3 emission) {
  if (view.has_glows != 0) emission *= Load3(view.glows, instance);
  if (m.beam == 0.0) return emission;
  if (m.beam == kWindowBeam) return window_light(pane, t.area) * luminance(emission);
  const vec3 axis = Row3(matrix, beam_axis(m.beam));
  const float sharp = abs(m.beam);
  return emission * beam_shape(sharp, -sharp * dot(axis, d), -d.z);
}
