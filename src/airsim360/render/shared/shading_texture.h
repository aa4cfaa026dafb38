// Texture look-up for the shading kernels (only for *_kernel.cc files): filtered across all lanes of a
// vector.
#pragma once

#include <cstddef>

#include "airsim360/render/shared/lane_gather.h"
#include "airsim360/render/shared/shading_data.h"

namespace airsim360::internal::AIRSIM360_ISA {

#define KERNEL static inline __attribute__((always_inline, unused))

using Lanes = float[kLanes];

/// The level of a texture that every lane reads.
struct alignas(64) LevelLanes {
  const uint32_t* texels[kLanes];
  real width, height;
};

KERNEL real Unpack(ireal texel, int shift) { return to_real((texel >> shift) & 255) * (1.0f / 255.0f); }

/// Colour channels, decoded to linear values.
KERNEL real3 Decode(ireal t, mask_t encoded) {
  const real3 c = make3(Unpack(t, 0), Unpack(t, 8), Unpack(t, 16));
  if (!stdx::any_of(encoded)) return c;
  return sel3(encoded, make3(srgb_decode_approx(c.x), srgb_decode_approx(c.y), srgb_decode_approx(c.z)), c);
}

/// Bilinear in one level of w x h texels; u, v already brought into [0, 1]; `texels(index)` fetches the
/// texels of all lanes.
template <class Texels>
KERNEL real3 SampleLevel(Texels texels, real w, real h, mask_t clamp_u, mask_t clamp_v, real u, real v, mask_t encoded) {
  const real x = u * w - 0.5f, y = v * h - 0.5f;
  const real x0 = rfloor(x), y0 = rfloor(y);
  const real fx = x - x0, fy = y - y0;
  // Neighbours beyond the border: the other side, or the border itself where the texture clamps.
  const real zero = real(0.0f);
  const real left = sel(x0 < 0.0f, sel(clamp_u, zero, w - 1.0f), rmin(x0, w - 1.0f));
  const real right = sel(x0 + 1.0f > w - 0.5f, sel(clamp_u, w - 1.0f, zero), x0 + 1.0f);
  const real top = sel(y0 < 0.0f, sel(clamp_v, zero, h - 1.0f), rmin(y0, h - 1.0f));
  const real bottom = sel(y0 + 1.0f > h - 0.5f, sel(clamp_v, h - 1.0f, zero), y0 + 1.0f);

  const ireal row0 = to_int(top) * to_int(w), row1 = to_int(bottom) * to_int(w), l = to_int(left), r = to_int(right);
  const real3 upper = lerp3(Decode(texels(row0 + l), encoded), Decode(texels(row0 + r), encoded), fx);
  const real3 lower = lerp3(Decode(texels(row1 + l), encoded), Decode(texels(row1 + r), encoded), fx);
  return lerp3(upper, lower, fy);
}

/// Coordinates folded into [0, 1] by the wrap mode: 0 repeat, 1 mirror, 2 clamp.
KERNEL real FoldCoordinate(real x, real wrap) {
  const real repeated = x - rfloor(x);
  const real twice = (x * 0.5f - rfloor(x * 0.5f)) * 2.0f;
  return sel(wrap < 0.5f, repeated, sel(wrap < 1.5f, sel(twice > 1.0f, 2.0f - twice, twice), clamp01(x)));
}

/// The same for one wrap mode.
KERNEL real FoldUniform(real x, uint8_t wrap) { return wrap == 0 ? x - rfloor(x) : FoldCoordinate(x, real(static_cast<float>(wrap))); }

/// One level of one texture for all lanes.
KERNEL real3 SampleUniform(const TextureRecord& t, const TextureLevel& level, real u, real v) {
  const auto texels = [&](ireal index) __attribute__((always_inline)) { return GatherWords(level.texels, index); };
  return SampleLevel(texels, real(level.width), real(level.height), mask_t(t.wrap_u != 0), mask_t(t.wrap_v != 0), u, v,
                     mask_t(t.srgb > 0.5f));
}

/// The finest level of the noise texture, which repeats.
static __attribute__((noinline)) real3 SampleNoise(const ShadeView& view, real u, real v) {
  const TextureRecord& t = view.textures[view.macro_texture];
  return SampleUniform(t, t.levels[0], FoldUniform(u, t.wrap_u), FoldUniform(v, t.wrap_v));
}

/// Two neighbouring levels of one texture.
KERNEL real3 SampleOneTexture(const TextureRecord& t, int k, real fraction, real u, real v, bool trilinear) {
  u = FoldUniform(u, t.wrap_u);
  v = FoldUniform(v, t.wrap_v);
  const real3 c = SampleUniform(t, t.levels[k], u, v);
  if (!trilinear || !stdx::any_of(fraction > 0.0f)) return c;
  return lerp3(c, SampleUniform(t, t.levels[k < static_cast<int>(t.last_level) ? k + 1 : k], u, v), fraction);
}

/// Of every lane's texture the level `level`.
KERNEL LevelLanes TakeLevels(const TextureRecord* textures, const int32_t* id, real level) {
  static_assert(sizeof(TextureLevel) == 16 && offsetof(TextureLevel, width) == 8 && offsetof(TextureLevel, height) == 12);
  alignas(64) int32_t k[kLanes];
  to_int(level).copy_to(k, stdx::vector_aligned);
  KeepInMemory(k);
  const TextureLevel* at[kLanes];
  LevelLanes out;
  for (int i = 0; i < kLanes; ++i) {
    at[i] = &textures[id[i]].levels[k[i]];
    out.texels[i] = at[i]->texels;
  }
  const real4 words = GatherQuads([&](int i) __attribute__((always_inline)) { return reinterpret_cast<const float*>(at[i]); });
  out.width = words.z;
  out.height = words.w;
  return out;
}

/// Filtered look-up of one texture per lane. `footprint_log2` is log2 of the pixel's size in uv units; with
/// `trilinear` two levels are mixed, else the nearer is taken.
static __attribute__((noinline)) real3 SampleTexture(const TextureRecord* textures, const int32_t* id, real u, real v, real footprint_log2,
                                                     bool trilinear) {
  static_assert(offsetof(TextureRecord, size_log2) == offsetof(TextureRecord, last_level) + 4 &&
                offsetof(TextureRecord, srgb) == offsetof(TextureRecord, last_level) + 8 &&
                offsetof(TextureRecord, wrap_u) == offsetof(TextureRecord, last_level) + 12 &&
                offsetof(TextureRecord, wrap_v) == offsetof(TextureRecord, last_level) + 13);
  real lower;
  const auto choose = [&](real size, real last) __attribute__((always_inline)) {
    const real level = rmin(last, rmax(real(0.0f), footprint_log2 + size));
    lower = trilinear ? rfloor(level) : rfloor(level + 0.5f);
    return level - lower;
  };
  // Neighbours mostly read the same level of the same texture.
  if (stdx::all_of(ireal(id, stdx::vector_aligned) == id[0])) {
    const TextureRecord& t = textures[id[0]];
    const real fraction = choose(real(t.size_log2), real(t.last_level));
    if (stdx::all_of(lower == real(lower[0]))) return SampleOneTexture(t, static_cast<int>(lower[0]), fraction, u, v, trilinear);
  }
  // Last level, size, encoding, wrap modes.
  const real4 words = GatherQuads([&](int i) __attribute__((always_inline)) { return &textures[id[i]].last_level; });
  const real fraction = choose(words.y, words.x);
  const ireal wraps = bits_of(words.w);
  const real wrap_u = to_real(wraps & 255), wrap_v = to_real((wraps >> 8) & 255);
  u = FoldCoordinate(u, wrap_u);
  v = FoldCoordinate(v, wrap_v);
  const mask_t encoded = words.z > 0.5f, clamp_u = wrap_u > 0.5f, clamp_v = wrap_v > 0.5f;
  const auto sample = [&](real level) __attribute__((always_inline)) {
    const LevelLanes lanes = TakeLevels(textures, id, level);
    return SampleLevel(
        [&](ireal index) __attribute__((always_inline)) { return GatherWordsAt(lanes.texels, index); }, lanes.width, lanes.height, clamp_u,
        clamp_v, u, v, encoded);
  };
  const real3 c = sample(lower);
  if (!trilinear || !stdx::any_of(fraction > 0.0f)) return c;
  return lerp3(c, sample(rmin(lower + 1.0f, words.x)), fraction);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
