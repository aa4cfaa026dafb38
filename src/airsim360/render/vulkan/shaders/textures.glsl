// Filtered look-ups of textures: render/shared/shading_texture.h for one lane.

float FoldCoordinate(float x, uint wrap) {
  if (wrap == 0) return x - floor(x);
  if (wrap == 2) return clamp01(x);
  const float twice = (x * 0.5 - floor(x * 0.5)) * 2.0;
  return twice > 1.0 ? 2.0 - twice : twice;
}

vec3 Texel(Uints texels, int i, bool encoded) {
  const uint t = texels.v[i];
  const vec3 c = vec3(float(t & 255u), float((t >> 8) & 255u), float((t >> 16) & 255u)) * kByteStep;
  if (!encoded) return c;
  return vec3(srgb_decode_approx(c.x), srgb_decode_approx(c.y), srgb_decode_approx(c.z));
}

/// Bilinear in one level; u, v in [0, 1].
vec3 SampleLevel(uint id, int level, float u, float v) {
  const float w = view.textures.v[id].width[level], h = view.textures.v[id].height[level];
  Uints texels = view.textures.v[id].texels[level];
  const bool encoded = view.textures.v[id].srgb > 0.5;
  const bool clamp_u = view.textures.v[id].wrap_u != 0, clamp_v = view.textures.v[id].wrap_v != 0;
  const float x = u * w - 0.5, y = v * h - 0.5, x0 = floor(x), y0 = floor(y);
  const float left = x0 < 0.0 ? (clamp_u ? 0.0 : w - 1.0) : min(x0, w - 1.0);
  const float right = x0 + 1.0 > w - 0.5 ? (clamp_u ? w - 1.0 : 0.0) : x0 + 1.0;
  const float top = y0 < 0.0 ? (clamp_v ? 0.0 : h - 1.0) : min(y0, h - 1.0);
  const float bottom = y0 + 1.0 > h - 0.5 ? (clamp_v ? h - 1.0 : 0.0) : y0 + 1.0;
  const int row0 = int(top) * int(w), row1 = int(bottom) * int(w), l = int(left), r = int(right);
  const float fx = x - x0, fy = y - y0;
  vec3 upper = vec3(0.0);
  [[dont_unroll]] for (int k = 0; k < 2; ++k) {
    const int row = k == 0 ? row0 : row1;
    const vec3 c = lerp3(Texel(texels, row + l, encoded), Texel(texels, row + r, encoded), fx);
    if (k == 1) return lerp3(upper, c, fy);
    upper = c;
  }
  return upper;
}

/// `footprint_log2`: of the pixel's size in uv units; `trilinear` mixes two levels, else the nearer is taken.
vec3 SampleTexture(uint id, float u, float v, float footprint_log2, bool trilinear) {
  const float last = view.textures.v[id].last_level;
  const float level = min(last, max(0.0, footprint_log2 + view.textures.v[id].size_log2));
  const float lower = trilinear ? floor(level) : floor(level + 0.5);
  const float fraction = level - lower;
  u = FoldCoordinate(u, view.textures.v[id].wrap_u);
  v = FoldCoordinate(v, view.textures.v[id].wrap_v);
  vec3 fine = vec3(0.0);
  [[dont_unroll]] for (int k = 0; k < 2; ++k) {
    const vec3 c = SampleLevel(id, min(int(lower) + k, int(last)), u, v);
    if (k == 1) return lerp3(fine, c, fraction);
    fine = c;
    if (!trilinear || !(fraction > 0.0)) break;
  }
  return fine;
}

/// The noise texture, which is number 1 and repeats.
vec3 SampleNoise(float u, float v) {
  return SampleLevel(1, 0, FoldCoordinate(u, view.textures.v[1].wrap_u), FoldCoordinate(v, view.textures.v[1].wrap_v));
}
