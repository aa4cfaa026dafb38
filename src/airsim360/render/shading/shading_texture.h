// Texture look-up for the shading kernels (only for *_kernel.cc files): filtered across all lanes of a
// vector.
#pragma once

#include "airsim360/render/shading/shading_data.h"
#include "airsim360/render/shading/shading_simd.h"

namespace airsim360::internal::AIRSIM360_ISA {

#define KERNEL static inline __attribute__((always_inline, unused))

using Lanes = float[kLanes];

/// Colour channels of a lookup, decoded to linear values.
struct TexelColor {
  real3 rgb;
  real a;
};

/// Which level of which texture every lane reads.
struct alignas(64) LevelLanes {
  const uint32_t* texels[kLanes];
  alignas(64) Lanes width, height, clamp_u, clamp_v;
};

KERNEL real Unpack(ireal texel, int shift) { return to_real((texel >> shift) & 255) * (1.0f / 255.0f); }

KERNEL TexelColor Decode(const int32_t* texels, real srgb) {
  const ireal t(texels, stdx::vector_aligned);
  TexelColor c;
  c.rgb = make3(Unpack(t, 0), Unpack(t, 8), Unpack(t, 16));
  c.a = to_real((t >> 24) & 255) * (1.0f / 255.0f);
  const mask_t encoded = srgb > 0.5f;
  if (stdx::any_of(encoded)) {
    c.rgb = sel3(encoded,
                 make3(srgb_decode_approx(c.rgb.x), srgb_decode_approx(c.rgb.y), srgb_decode_approx(c.rgb.z)),
                 c.rgb);
  }
  return c;
}

KERNEL TexelColor MixColor(const TexelColor& a, const TexelColor& b, real t) {
  return {lerp3(a.rgb, b.rgb, t), lerp1(a.a, b.a, t)};
}

/// Bilinear in one level; u, v already brought into [0, 1].
KERNEL TexelColor SampleLevel(const LevelLanes& level, real u, real v, real srgb) {
  const real w = load(level.width), h = load(level.height);
  const real x = u * w - 0.5f, y = v * h - 0.5f;
  const real x0 = rfloor(x), y0 = rfloor(y);
  const real fx = x - x0, fy = y - y0;
  // Neighbours beyond the border: the other side, or the border itself where the texture clamps.
  const mask_t cu = load(level.clamp_u) > 0.5f, cv = load(level.clamp_v) > 0.5f;
  const real left = sel(x0 < 0.0f, sel(cu, real(0.0f), w - 1.0f), rmin(x0, w - 1.0f));
  const real right = sel(x0 + 1.0f > w - 0.5f, sel(cu, w - 1.0f, real(0.0f)), x0 + 1.0f);
  const real top = sel(y0 < 0.0f, sel(cv, real(0.0f), h - 1.0f), rmin(y0, h - 1.0f));
  const real bottom = sel(y0 + 1.0f > h - 0.5f, sel(cv, h - 1.0f, real(0.0f)), y0 + 1.0f);

  alignas(64) int32_t index[4][kLanes], texel[4][kLanes];
  const ireal row0 = to_int(top) * to_int(w), row1 = to_int(bottom) * to_int(w), l = to_int(left),
              r = to_int(right);
  (row0 + l).copy_to(index[0], stdx::vector_aligned);
  (row0 + r).copy_to(index[1], stdx::vector_aligned);
  (row1 + l).copy_to(index[2], stdx::vector_aligned);
  (row1 + r).copy_to(index[3], stdx::vector_aligned);
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < kLanes; ++i) texel[k][i] = static_cast<int32_t>(level.texels[i][index[k][i]]);
  }
  const TexelColor upper = MixColor(Decode(texel[0], srgb), Decode(texel[1], srgb), fx);
  const TexelColor lower = MixColor(Decode(texel[2], srgb), Decode(texel[3], srgb), fx);
  return MixColor(upper, lower, fy);
}

/// Coordinates folded into [0, 1] by the wrap mode: 0 repeat, 1 mirror, 2 clamp.
KERNEL real FoldCoordinate(real x, real wrap) {
  const real repeated = x - rfloor(x);
  const real twice = (x * 0.5f - rfloor(x * 0.5f)) * 2.0f;
  return sel(wrap < 0.5f, repeated, sel(wrap < 1.5f, sel(twice > 1.0f, 2.0f - twice, twice), clamp01(x)));
}

/// Filtered look-up of one texture per lane. `footprint_log2` is log2 of the pixel's size in uv units; with
/// `trilinear` two levels are mixed, else the nearer is taken.
static __attribute__((noinline)) TexelColor SampleTexture(const TextureRecord* textures, const int32_t* id,
                                                          real u, real v, real footprint_log2,
                                                          bool trilinear) {
  alignas(64) Lanes lod, size, last, srgb, wrap_u, wrap_v;
  for (int i = 0; i < kLanes; ++i) {
    const TextureRecord& t = textures[id[i]];
    size[i] = t.size_log2;
    last[i] = t.last_level;
    srgb[i] = t.srgb;
    wrap_u[i] = t.wrap_u;
    wrap_v[i] = t.wrap_v;
  }
  const real level = rmin(load(last), rmax(real(0.0f), footprint_log2 + load(size)));
  const real lower = trilinear ? rfloor(level) : rfloor(level + 0.5f);
  const real fraction = level - lower;
  u = FoldCoordinate(u, load(wrap_u));
  v = FoldCoordinate(v, load(wrap_v));
  store(lod, lower);

  LevelLanes fine, coarse;
  for (int i = 0; i < kLanes; ++i) {
    const TextureRecord& t = textures[id[i]];
    const int k = static_cast<int>(lod[i]);
    const TextureLevel& a = t.levels[k];
    const TextureLevel& b = t.levels[k < static_cast<int>(t.last_level) ? k + 1 : k];
    fine.texels[i] = a.texels, fine.width[i] = a.width, fine.height[i] = a.height;
    coarse.texels[i] = b.texels, coarse.width[i] = b.width, coarse.height[i] = b.height;
    fine.clamp_u[i] = coarse.clamp_u[i] = t.wrap_u != 0;
    fine.clamp_v[i] = coarse.clamp_v[i] = t.wrap_v != 0;
  }
  const TexelColor c = SampleLevel(fine, u, v, load(srgb));
  if (!trilinear || !stdx::any_of(fraction > 0.0f)) return c;
  return MixColor(c, SampleLevel(coarse, u, v, load(srgb)), fraction);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
