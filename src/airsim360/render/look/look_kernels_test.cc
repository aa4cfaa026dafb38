// Kernels of the photo look by instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/base/kernel_isa.h"
#include "airsim360/base/random.h"
#include "airsim360/image/color.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/look/develop_kernels.h"
#include "airsim360/render/look/scatter_kernels.h"

namespace airsim360 {
namespace {

using namespace internal;

TEST(LookKernels, AllInstructionSetsGiveTheSameBits) {
  const KernelIsa best = CurrentKernelIsa();
  const auto noise = [](size_t n, uint64_t key) {
    std::vector<float> v(n);
    RngStream random(1, "kernels", key);
    for (float& x : v) x = static_cast<float>(random.Uniform());
    return v;
  };
  const auto solve = [&](auto fourier, auto solver) {
    constexpr int kLength = 32, kRows = 32;
    std::vector<float> planes[4], cosines, sines;
    for (uint64_t k = 0; k < 4; ++k) planes[k] = noise(kLength * kRows, k);
    for (int k = 0; k < kLength / 2; ++k)
      cosines.push_back(static_cast<float>(std::cos(2 * kPi * k / kLength))),
          sines.push_back(static_cast<float>(std::sin(2 * kPi * k / kLength)));
    const std::vector<float> area = noise(kRows, 5), flux = noise(kRows + 1, 6), across = noise(kRows, 7), eigen = noise(kLength, 8);
    const float t[2] = {0.1f, 3}, weight[2] = {0.4f, 0.6f};
    const ScatterRows rows{planes[0].data(), planes[1].data(), kLength, kLength, cosines.data(), sines.data()};
    fourier(rows, 16, false);
    solver({kRows,
            kLength,
            area.data(),
            flux.data(),
            across.data(),
            eigen.data(),
            2,
            t,
            weight,
            {planes[0].data(), planes[1].data(), planes[2].data(), planes[3].data()}},
           16);
    fourier(rows, 0, true);
    planes[0].insert(planes[0].end(), planes[1].begin(), planes[1].end());
    return planes[0];
  };
  const auto develop = [&](auto expose, auto tone, auto sharpen) {
    constexpr int kWide = 48;
    alignas(64) float memory[30][kWide + 2 * kRowPad];
    for (uint64_t i = 0; i < 30; ++i) std::ranges::copy(noise(kWide + 2 * kRowPad, 20 + i), memory[i]);
    const auto row = [&](int i) { return memory[i] + kRowPad; };
    const auto color = [&](int i) { return ColorRow{row(i), row(i + 1), row(i + 2)}; };
    expose({kWide, 0.7f, 0.01f, 0.001f, 77u, 0.8f}, color(0));
    std::vector<float> curve = noise(kCurveSize + 1, 60);
    const ConstColorRow rows[3] = {{row(0), row(1), row(2)}, {row(3), row(4), row(5)}, {row(6), row(7), row(8)}};
    tone({kWide, 0.18f, {1, 0.9f, 1.1f}, 0.5f, curve.data(), 1.05f}, rows, color(9), color(12), row(15));
    const float* luminance[5] = {row(15), row(16), row(17), row(18), row(19)};
    std::vector<Rgb8> out(kWide);
    sharpen(kWide, 0.4f, {row(12), row(13), row(14)}, luminance, row(20), out.data());
    return out;
  };
  const auto base = solve(isa_sse42::FourierRows, isa_sse42::SolveColumns);
  const auto picture = develop(isa_sse42::ExposeRow, isa_sse42::ToneRow, isa_sse42::SharpenRow);
  if (best != KernelIsa::kSse42) {
    EXPECT_EQ(base, solve(isa_avx2::FourierRows, isa_avx2::SolveColumns));
    EXPECT_EQ(picture, develop(isa_avx2::ExposeRow, isa_avx2::ToneRow, isa_avx2::SharpenRow));
  }
  if (best == KernelIsa::kAvx512) {
    EXPECT_EQ(base, solve(isa_avx512::FourierRows, isa_avx512::SolveColumns));
    EXPECT_EQ(picture, develop(isa_avx512::ExposeRow, isa_avx512::ToneRow, isa_avx512::SharpenRow));
  }
}

}  // namespace
}  // namespace airsim360
