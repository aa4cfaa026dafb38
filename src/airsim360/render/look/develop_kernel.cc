// Kernel: the passes between light and picture.
#include "airsim360/render/look/develop_kernels.h"
#include "airsim360/render/shared/lane_gather.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

// A step of sharpening at the most, so that edges get no halos.
constexpr float kMostSharpening = 0.12f;
// Of sigma 1.3 pixels.
constexpr float kBlur[3] = {0.3065f, 0.2280f, 0.1188f};

KERNEL real Take(const float* p) { return real(p, stdx::element_aligned); }

// About normal with variance 1: the sum of four bytes (Irwin-Hall), at most 3.45.
KERNEL real NormalOf(ureal bits) {
  const ureal even = bits & 0x00ff00ffu, odd = (bits >> 8) & 0x00ff00ffu;
  const ureal pairs = even + odd;
  const ureal sum = (pairs & 0xffffu) + (pairs >> 16);
  return (to_real(stdx::static_simd_cast<ireal>(sum)) - 510.0f) * (1.0f / 147.8003f);
}

}  // namespace

void AddRow(const Rgb32f* light, int width, float most, float weight, float* sum) {
  const float* from = &light[0].r;
  const int count = 3 * width;
  int i = 0;
  for (; i + kLanes <= count; i += kLanes)
    (Take(sum + i) + rmin(rmax(Take(from + i), real(0.0f)), real(most)) * weight).copy_to(sum + i, stdx::element_aligned);
  for (; i < count; ++i) {
    const float x = from[i] > 0 ? from[i] : 0;
    sum[i] += (x < most ? x : most) * weight;
  }
}

void LoadRow(const Rgb32f* light, int width, int first, float kept, ConstColorRow scattered, ColorRow out) {
  const auto part = [&](const Rgb32f* from, int begin, int end) __attribute__((always_inline)) {
    int x = begin;
    // The fourth number of a quad is the next pixel's, which the last one lacks.
    for (; x + kLanes < end; x += kLanes) {
      const real4 c = GatherQuads([&](int lane) __attribute__((always_inline)) { return &from[x - begin + lane].r; });
      (rmax(c.x, real(0.0f)) * kept + Take(scattered.r + x)).copy_to(out.r + x, stdx::element_aligned);
      (rmax(c.y, real(0.0f)) * kept + Take(scattered.g + x)).copy_to(out.g + x, stdx::element_aligned);
      (rmax(c.z, real(0.0f)) * kept + Take(scattered.b + x)).copy_to(out.b + x, stdx::element_aligned);
    }
    for (; x < end; ++x) {
      const Rgb32f c = from[x - begin];
      out.r[x] = (c.r > 0 ? c.r : 0) * kept + scattered.r[x];
      out.g[x] = (c.g > 0 ? c.g : 0) * kept + scattered.g[x];
      out.b[x] = (c.b > 0 ? c.b : 0) * kept + scattered.b[x];
    }
  };
  part(light + first, 0, width - first);
  part(light, width - first, width);
}

void SpreadRow(const float* __restrict__ from, int cells, int width, float* __restrict__ out) {
  if (width == cells) {
    for (int i = 0; i < cells; ++i) out[i] = from[i];
    return;
  }
  for (int x = 0; x < width; x += kLanes) {
    const int i = x / 2;
    alignas(64) float pair[kLanes];
    for (int k = 0; k < kLanes / 2; ++k) {
      pair[2 * k] = 0.75f * from[i + k] + 0.25f * from[i + k - 1];
      pair[2 * k + 1] = 0.75f * from[i + k] + 0.25f * from[i + k + 1];
    }
    store(out + x, load(pair));
  }
}

void ExposeRow(const ExposeRowTask& task, ColorRow row) {
  // Half of the noise is common to the channels, as after demosaicing.
  constexpr float kHalf = 0.70710678f;
  alignas(64) static constexpr float kOrder[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const real order = load(kOrder);
  const bool noisy = task.slope > 0 || task.floor > 0;
  for (int x = 0; x < task.width; x += kLanes) {
    real c[3] = {load(row.r + x) * task.exposure, load(row.g + x) * task.exposure, load(row.b + x) * task.exposure};
    if (noisy) {
      const ireal column = to_int((order + (static_cast<float>(x) + 0.5f)) * task.grain);
      ureal bits = hash_bits(stdx::static_simd_cast<ureal>(column) * 0x9e3779b1u + task.key);
      const real common = NormalOf(bits);
      for (int k = 0; k < 3; ++k) {
        bits = hash_bits(bits + 0x9e3779b9u);
        const real own = NormalOf(bits);
        c[k] = c[k] + rroot(c[k] * task.slope + task.floor) * ((common + own) * kHalf);
      }
    }
    store3(row.r + x, row.g + x, row.b + x, {c[0], c[1], c[2]});
  }
}

void ToneRow(const ToneRowTask& task, const ConstColorRow* rows, ColorRow scratch, ColorRow out, float* luminance) {
  const float side = task.side, own = 1 - 2 * task.side;
  const float* const from[3][3] = {{rows[0].r, rows[1].r, rows[2].r}, {rows[0].g, rows[1].g, rows[2].g}, {rows[0].b, rows[1].b, rows[2].b}};
  float* const column[3] = {scratch.r, scratch.g, scratch.b};
  for (int k = 0; k < 3 && side > 0; ++k) {
    for (int x = -kRowPad; x < task.width + kRowPad; x += kLanes)
      store(column[k] + x, (load(from[k][0] + x) + load(from[k][2] + x)) * side + load(from[k][1] + x) * own);
  }
  for (int x = 0; x < task.width; x += kLanes) {
    real c[3];
    for (int k = 0; k < 3; ++k) {
      const real light =
          side > 0 ? (Take(column[k] + x - 1) + Take(column[k] + x + 1)) * side + load(column[k] + x) * own : load(from[k][1] + x);
      const real share = rmin(rmax(light * (task.gain[k] * task.clip_inverse), real(0.0f)), real(1.0f));
      c[k] = GatherFloats(task.curve, to_int(rroot(share) * static_cast<float>(kCurveSize) + 0.5f));
    }
    const real l = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
    for (int k = 0; k < 3; ++k) c[k] = l + (c[k] - l) * task.saturation;
    store3(out.r + x, out.g + x, out.b + x, {c[0], c[1], c[2]});
    store(luminance + x, l);
  }
}

void SharpenRow(int width, float amount, ConstColorRow encoded, const float* const* luminance, float* scratch, Rgb8* out) {
  for (int x = -kRowPad; x < width + kRowPad && amount > 0; x += kLanes) {
    store(scratch + x, load(luminance[2] + x) * kBlur[0] + (load(luminance[1] + x) + load(luminance[3] + x)) * kBlur[1] +
                           (load(luminance[0] + x) + load(luminance[4] + x)) * kBlur[2]);
  }
  for (int x = 0; x < width; x += kLanes) {
    real3 c = load3(encoded.r + x, encoded.g + x, encoded.b + x);
    if (amount > 0) {
      const real blurred = load(scratch + x) * kBlur[0] + (Take(scratch + x - 1) + Take(scratch + x + 1)) * kBlur[1] +
                           (Take(scratch + x - 2) + Take(scratch + x + 2)) * kBlur[2];
      const real step = rmin(rmax(load(luminance[2] + x) - blurred, real(-kMostSharpening)), real(kMostSharpening)) * amount;
      c = make3(c.x + step, c.y + step, c.z + step);
    }
    alignas(64) int32_t codes[3][kLanes];
    const real channels[3] = {c.x, c.y, c.z};
    for (int k = 0; k < 3; ++k)
      to_int(rmin(rmax(channels[k], real(0.0f)), real(1.0f)) * 255.0f + 0.5f).copy_to(codes[k], stdx::vector_aligned);
    const int count = width - x < kLanes ? width - x : kLanes;
    for (int i = 0; i < count; ++i)
      out[x + i] = {static_cast<uint8_t>(codes[0][i]), static_cast<uint8_t>(codes[1][i]), static_cast<uint8_t>(codes[2][i])};
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
