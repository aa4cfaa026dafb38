// Chi-square of the samplers that all else is built on; those of BSDFs, sky, sun and lamps are tested beside them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "airsim360/base/random.h"
#include "airsim360/render/reference/path_sampler.h"
#include "airsim360/render/reference/test_statistics.h"
#include "airsim360/render/shading/sampling.h"

namespace airsim360::internal {
namespace {

// Of all tests of this file together.
constexpr double kAlpha = 0.01;
constexpr int kTests = 11;
const double kSignificance = test::Sidak(kAlpha, kTests);

// Chance that points are even over the unit square: 32 x 32 cells.
double ChiSquareOfSquare(int count, const std::function<Vec2f(int)>& point) {
  constexpr int kCells = 32;
  std::array<int, kCells * kCells> seen{};
  for (int i = 0; i < count; ++i) {
    const Vec2f p = point(i);
    EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
    ++seen[static_cast<int>(p.y * kCells) * kCells + static_cast<int>(p.x * kCells)];
  }
  const double expected = static_cast<double>(count) / (kCells * kCells);
  double statistic = 0;
  for (const int n : seen) statistic += (n - expected) * (n - expected) / expected;
  return test::ChiSquareTail(statistic, kCells * kCells - 1);
}

constexpr int kCount = 100000;

TEST(Samplers, AnyPairOfAnySampleIsEvenOverPixels) {
  for (const uint32_t index : {0u, 1u, 37u}) {
    for (const uint32_t pair : {0u, 5u}) {
      const double chance =
          ChiSquareOfSquare(kCount, [&](int pixel) { return PathSampler(3, static_cast<uint64_t>(pixel)).Pair(index, pair); });
      EXPECT_GT(chance, kSignificance) << index << ' ' << pair;
    }
  }
}

TEST(Samplers, PairsOfAPixelDoNotKnowEachOther) {
  const double chance = ChiSquareOfSquare(kCount, [](int pixel) -> Vec2f {
    const PathSampler sampler(3, static_cast<uint64_t>(pixel));
    return {sampler.Pair(2, 0).x, sampler.Pair(2, 1).x};
  });
  EXPECT_GT(chance, kSignificance);
}

TEST(Samplers, AllSamplesOfOnePixelAreStratified) {
  // 1024 samples, 32 x 32 cells: exactly one each, which no random sequence would give.
  const PathSampler sampler(3, 77);
  EXPECT_GT(ChiSquareOfSquare(1024, [&](int i) { return sampler.Pair(static_cast<uint32_t>(i), 4); }), 1 - 1e-9);
}

TEST(Samplers, SharedDirectionsOfTierHighAreEvenOverSeeds) {
  for (const uint32_t index : {0u, 13u}) {
    RngStream random(5, "seeds");
    const double chance = ChiSquareOfSquare(kCount, [&](int) { return SobolPoint(index, static_cast<uint32_t>(random.Bits())); });
    EXPECT_GT(chance, kSignificance) << index;
  }
}

TEST(Samplers, AmbientDirectionsAreSpreadAsTheCosine) {
  RngStream random(1, "cosine");
  const auto unit = [&] { return static_cast<float>(random.Bits() >> 40) * 0x1p-24f; };
  const Vec3f n = Normalized(Vec3f{0.3f, -0.5f, 0.7f});
  const double chance = test::ChiSquareOfDirections(
      [&](Vec3f& d) {
        const float u = unit();
        d = Normalized(SpherePoint({u, unit()}) + n);
        return true;
      },
      [&](Vec3f d) { return std::max(0.0f, Dot(d, n)) / std::numbers::pi_v<float>; }, 200000);
  EXPECT_GT(chance, kSignificance);
}

TEST(Samplers, PointsOfTheSunsDiscAreEvenOverIt) {
  RngStream random(2, "disc");
  const auto unit = [&] { return static_cast<float>(random.Bits() >> 40) * 0x1p-24f; };
  const Vec3f to_sun = Normalized(Vec3f{0.5f, 0.2f, 0.6f});
  const Vec3f right = Normalized(Cross({0, 0, 1}, to_sun)), up = Cross(to_sun, right);
  constexpr double kRadius = 0.00462;  // of 0.53 degrees
  const SunDisc disc(to_sun);
  double farthest = 0;
  // Even over a disc: the square of the radius and the angle are even.
  const double chance = ChiSquareOfSquare(kCount, [&](int) -> Vec2f {
    const float u = unit();
    const Vec3f d = disc.At({u, unit()});
    const double x = Dot(d, right) / Dot(d, to_sun) / kRadius, y = Dot(d, up) / Dot(d, to_sun) / kRadius;
    farthest = std::max(farthest, x * x + y * y);
    return {std::min(0.9999999f, static_cast<float>(x * x + y * y)),
            std::min(0.9999999f, static_cast<float>(std::atan2(y, x) / (2 * std::numbers::pi) + 0.5))};
  });
  EXPECT_GT(chance, kSignificance);
  EXPECT_NEAR(farthest, 1, 0.001);
}

}  // namespace
}  // namespace airsim360::internal
