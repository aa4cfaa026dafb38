// Texture look-up for the shading kernels (only for *_kernel.cc files): filtered across all lanes of a
// vector.
#pragma once

#include "airsim360/render/shading/shading_data.h"
#include "airsim360/render/shading/shading_simd.h"

namespace airsim360::internal::AIRSIM360_ISA {

#define KERNEL static inline __attribute__((always_inline, unused))

using Lanes = float[kLanes];

/// Which level of which texture every lane reads.
struct alignas(64) LevelLanes {
  const uint32_t* texels[kLanes];
  alignas(64) Lanes width, height, clamp_u, clamp_v;
};

KERNEL real Unpack(ireal texel, int shift) { return to_real((texel >> shift) & 255) * (1.0f / 255.0f); }

/// Colour channels, decoded to linear values.
KERNEL real3 Decode(const int32_t* texels, mask_t encoded) {
  const ireal t(texels, stdx::vector_aligned);
  const real3 c = make3(Unpack(t, 0), Unpack(t, 8), Unpack(t, 16));
  if (!stdx::any_of(encoded)) return c;
  return sel3(encoded, make3(srgb_decode_approx(c.x), srgb_decode_approx(c.y), srgb_decode_approx(c.z)), c);
}

/// Bilinear in one level of w x h texels; u, v already brought into [0, 1]; `texels(lane)` is where the
/// level of a lane begins.
template <class Texels>
KERNEL real3 SampleLevel(Texels texels, real w, real h, mask_t clamp_u, mask_t clamp_v, real u, real v,
                         mask_t encoded) {
  const real x = u * w - 0.5f, y = v * h - 0.5f;
  const real x0 = rfloor(x), y0 = rfloor(y);
  const real fx = x - x0, fy = y - y0;
  // Neighbours beyond the border: the other side, or the border itself where the texture clamps.
  const real zero = real(0.0f);
  const real left = sel(x0 < 0.0f, sel(clamp_u, zero, w - 1.0f), rmin(x0, w - 1.0f));
  const real right = sel(x0 + 1.0f > w - 0.5f, sel(clamp_u, w - 1.0f, zero), x0 + 1.0f);
  const real top = sel(y0 < 0.0f, sel(clamp_v, zero, h - 1.0f), rmin(y0, h - 1.0f));
  const real bottom = sel(y0 + 1.0f > h - 0.5f, sel(clamp_v, h - 1.0f, zero), y0 + 1.0f);

  alignas(64) int32_t index[4][kLanes], texel[4][kLanes];
  const ireal row0 = to_int(top) * to_int(w), row1 = to_int(bottom) * to_int(w), l = to_int(left),
              r = to_int(right);
  (row0 + l).copy_to(index[0], stdx::vector_aligned);
  (row0 + r).copy_to(index[1], stdx::vector_aligned);
  (row1 + l).copy_to(index[2], stdx::vector_aligned);
  (row1 + r).copy_to(index[3], stdx::vector_aligned);
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < kLanes; ++i) texel[k][i] = static_cast<int32_t>(texels(i)[index[k][i]]);
  }
  const real3 upper = lerp3(Decode(texel[0], encoded), Decode(texel[1], encoded), fx);
  const real3 lower = lerp3(Decode(texel[2], encoded), Decode(texel[3], encoded), fx);
  return lerp3(upper, lower, fy);
}

/// Coordinates folded into [0, 1] by the wrap mode: 0 repeat, 1 mirror, 2 clamp.
KERNEL real FoldCoordinate(real x, real wrap) {
  const real repeated = x - rfloor(x);
  const real twice = (x * 0.5f - rfloor(x * 0.5f)) * 2.0f;
  return sel(wrap < 0.5f, repeated, sel(wrap < 1.5f, sel(twice > 1.0f, 2.0f - twice, twice), clamp01(x)));
}

/// One level of one texture for all lanes.
KERNEL real3 SampleUniform(const TextureRecord& t, const TextureLevel& level, real u, real v) {
  const auto texels = [&](int) __attribute__((always_inline)) { return level.texels; };
  return SampleLevel(texels, real(level.width), real(level.height), mask_t(t.wrap_u != 0),
                     mask_t(t.wrap_v != 0), u, v, mask_t(t.srgb > 0.5f));
}

/// The finest level of the noise texture, which repeats.
static __attribute__((noinline)) real3 SampleNoise(const ShadeView& view, real u, real v) {
  const TextureRecord& t = view.textures[view.macro_texture];
  return SampleUniform(t, t.levels[0], FoldCoordinate(u, real(static_cast<float>(t.wrap_u))),
                       FoldCoordinate(v, real(static_cast<float>(t.wrap_v))));
}

/// All lanes in one texture; as SampleTexture.
KERNEL real3 SampleOneTexture(const TextureRecord& t, real lower, real fraction, real u, real v,
                              bool trilinear) {
  const int k = static_cast<int>(lower[0]);
  const real3 c = SampleUniform(t, t.levels[k], u, v);
  if (!trilinear || !stdx::any_of(fraction > 0.0f)) return c;
  return lerp3(c, SampleUniform(t, t.levels[k < static_cast<int>(t.last_level) ? k + 1 : k], u, v), fraction);
}

/// Filtered look-up of one texture per lane. `footprint_log2` is log2 of the pixel's size in uv units; with
/// `trilinear` two levels are mixed, else the nearer is taken.
static __attribute__((noinline)) real3 SampleTexture(const TextureRecord* textures, const int32_t* id, real u,
                                                     real v, real footprint_log2, bool trilinear) {
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
  // Neighbours mostly read the same level of the same texture.
  if (stdx::all_of(ireal(id, stdx::vector_aligned) == id[0]) && stdx::all_of(lower == real(lower[0])))
    return SampleOneTexture(textures[id[0]], lower, fraction, u, v, trilinear);
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
  const mask_t encoded = load(srgb) > 0.5f, clamp_u = load(fine.clamp_u) > 0.5f,
               clamp_v = load(fine.clamp_v) > 0.5f;
  const auto sample = [&](const LevelLanes& lanes) __attribute__((always_inline)) {
    return SampleLevel(
        [&](int i) __attribute__((always_inline)) { return lanes.texels[i]; }, load(lanes.width),
        load(lanes.height), clamp_u, clamp_v, u, v, encoded);
  };
  const real3 c = sample(fine);
  if (!trilinear || !stdx::any_of(fraction > 0.0f)) return c;
  return lerp3(c, sample(coarse), fraction);
}

}  // namespace airsim360::internal::AIRSIM360_ISA
