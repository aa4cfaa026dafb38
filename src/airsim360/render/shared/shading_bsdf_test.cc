#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/render/reference/test_statistics.h"
#include "airsim360/render/shared/shading_scalar.h"

namespace airsim360 {
namespace {

using internal::kFoliage;
using internal::kGlass;
using internal::kWater;
using internal::scalar::Bsdf;
using internal::scalar::bsdf_evaluate;
using internal::scalar::bsdf_lobes;
using internal::scalar::bsdf_make;
using internal::scalar::bsdf_sample;
using internal::scalar::bsdf_side;
using internal::scalar::bsdf_straight;

constexpr float kStandard = 0;
constexpr Vec3f kUp{0, 0, 1};
// The fits of albedo are within 0.007.
constexpr float kMost = 1.008f;

struct Surface {
  const char* name;
  Bsdf bsdf;
};

Bsdf Standard(Vec3f base, float metallic, float roughness, float coat = 0) {
  return bsdf_make(kStandard, base, metallic, roughness, 0, coat, 0.3f);
}

std::vector<Surface> Surfaces() {
  return {{"matte", Standard({0.8f, 0.5f, 0.2f}, 0, 1)},
          {"satin", Standard({0.8f, 0.5f, 0.2f}, 0, 0.4f)},
          {"metal", Standard({0.9f, 0.7f, 0.3f}, 1, 0.5f)},
          {"rough metal", Standard({0.9f, 0.7f, 0.3f}, 1, 1)},
          {"half metal", Standard({0.9f, 0.7f, 0.3f}, 0.5f, 0.3f)},
          {"car paint", Standard({0.5f, 0.02f, 0.02f}, 0.3f, 0.5f, 1)},
          {"half coated", Standard({0.5f, 0.3f, 0.1f}, 0, 0.7f, 0.5f)},
          {"leaf", bsdf_make(kFoliage, {0.1f, 0.3f, 0.05f}, 0, 0.5f, 0.8f, 0, 0.03f)},
          {"pane", bsdf_make(kGlass, {0.3f, 0.3f, 0.3f}, 0, 0.2f, 0.7f, 0, 0.03f)},
          {"water", bsdf_make(kWater, {0.02f, 0.05f, 0.06f}, 0, 0.25f, 0, 0, 0.03f)}};
}

Vec3f Slanted(float z, float azimuth = 0.3f) {
  const float s = std::sqrt(1 - z * z);
  return {s * std::cos(azimuth), s * std::sin(azimuth), z};
}

Vec3f Evaluate(const Bsdf& b, Vec3f v, Vec3f l, float& pdf) {
  const auto seen = bsdf_side(b, v.z);
  return bsdf_evaluate(b, seen, bsdf_lobes(b, seen), kUp, v, l, pdf);
}

// Light that a surface shows towards v under light of 1 from everywhere: mean weight of stratified samples,
// all directions.
Vec3f Furnace(const Bsdf& b, Vec3f v, int n = 128) {
  const auto seen = bsdf_side(b, v.z);
  const auto p = bsdf_lobes(b, seen);
  RngStream random(5, "furnace");
  Vec3d sum;
  const auto inside = [&](int i) { return static_cast<float>((i + random.Uniform()) / n); };
  for (int i = 0; i < n * n; ++i) {
    // The choice of lobe goes through (i * golden ratio) so that all strata see all lobes.
    const double golden = i * 0.61803398874989485;
    float event = 0, pdf = 0;
    const Vec3f l = bsdf_sample(b, p, kUp, v, static_cast<float>(golden - std::floor(golden)) * 0.9999999f,
                                std::min(inside(i % n), 0.9999999f), std::min(inside(i / n), 0.9999999f), event);
    if (event == 0) continue;
    if (event == 2) {
      sum += VecCast<double>(bsdf_straight(b, seen) * (1 / p.straight));
      continue;
    }
    const Vec3f f = bsdf_evaluate(b, seen, p, kUp, v, l, pdf);
    if (pdf > 0) sum += VecCast<double>(f * (1 / pdf));
  }
  return VecCast<float>(sum * (1.0 / (n * n)));
}

TEST(Bsdf, IsReciprocal) {
  RngStream random(1, "reciprocity");
  for (const Surface& s : Surfaces()) {
    for (int i = 0; i < 10000; ++i) {
      const Vec3f v = Slanted(static_cast<float>(random.Uniform(0.02, 1)), 0);
      Vec3f l = Slanted(static_cast<float>(random.Uniform(0.02, 1)), static_cast<float>(random.Uniform(0, 6.28)));
      const bool through = i % 2 == 1;
      if (through) l = -l;
      float pdf = 0;
      const Vec3f there = Evaluate(s.bsdf, v, l, pdf) * (1 / std::fabs(l.z));
      // The other way light comes from v; the normal is on the side of the one who looks.
      const float side = through ? -1.0f : 1.0f;
      const auto seen = bsdf_side(s.bsdf, std::fabs(l.z));
      const Vec3f back = bsdf_evaluate(s.bsdf, seen, bsdf_lobes(s.bsdf, seen), kUp * side, l, v, pdf) * (1 / v.z);
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(there[k], back[k], 1e-5f * std::max(there[k], 1e-3f)) << s.name << ' ' << v.z << ' ' << l.z;
    }
  }
}

TEST(Bsdf, GivesBackNoMoreThanItGets) {
  for (const Surface& s : Surfaces()) {
    for (float z : {0.05f, 0.2f, 0.5f, 1.0f}) {
      const Vec3f e = Furnace(s.bsdf, Slanted(z));
      for (int k = 0; k < 3; ++k) EXPECT_LE(e[k], kMost) << s.name << ' ' << z;
    }
  }
}

TEST(Bsdf, WhiteBodiesInEvenLightAreWhiteWithinOnePerCent) {
  for (float roughness : {0.03f, 0.2f, 0.5f, 0.8f, 1.0f}) {
    for (float z : {0.1f, 0.3f, 0.6f, 1.0f})
      EXPECT_NEAR(Furnace(Standard({1, 1, 1}, 0, roughness), Slanted(z)).y, 1, 0.01) << roughness << ' ' << z;
  }
}

TEST(Bsdf, WhiteMetalsLoseLessThanATenthOfTheLight) {
  for (float roughness : {0.05f, 0.3f, 0.5f, 0.7f, 1.0f}) {
    for (float z : {0.1f, 0.3f, 0.6f, 1.0f}) {
      const float e = Furnace(Standard({1, 1, 1}, 1, roughness), Slanted(z)).y;
      EXPECT_LE(e, kMost) << roughness << ' ' << z;
      EXPECT_GE(e, roughness < 0.3f ? 0.85f : 0.9f) << roughness << ' ' << z;
      EXPECT_NEAR(e, 1, roughness < 0.5f ? 0.15f : 0.01f) << roughness << ' ' << z;
    }
  }
}

TEST(Bsdf, CoatedWhiteBodiesLoseLittle) {
  for (float roughness : {0.3f, 0.6f, 1.0f}) {
    for (float z : {0.2f, 0.5f, 1.0f}) {
      const float e = Furnace(Standard({1, 1, 1}, 0, roughness, 1), Slanted(z)).y;
      EXPECT_LE(e, kMost) << roughness << ' ' << z;
      EXPECT_GE(e, 0.92f) << roughness << ' ' << z;
    }
  }
}

TEST(Bsdf, PanesAndWaterLetInWhatTheyDoNotReflect) {
  for (float z : {0.1f, 0.3f, 0.6f, 1.0f}) {
    EXPECT_NEAR(Furnace(bsdf_make(kGlass, {1, 1, 1}, 0, 0.03f, 1, 0, 0.03f), Slanted(z)).y, 1, 0.01) << z;
    EXPECT_NEAR(Furnace(bsdf_make(kGlass, {1, 1, 1}, 0, 0.03f, 0, 0, 0.03f), Slanted(z)).y, 1, 0.01) << z;
    EXPECT_NEAR(Furnace(bsdf_make(kWater, {1, 1, 1}, 0, 0.1f, 0, 0, 0.03f), Slanted(z)).y, 1, 0.01) << z;
  }
}

TEST(Bsdf, AmbientFormulaIsTheIntegralOfTheBsdf) {
  for (const Surface& s : Surfaces()) {
    if (s.bsdf.straight.x > 0) continue;
    for (float z : {0.2f, 0.5f, 0.9f}) {
      const auto seen = bsdf_side(s.bsdf, z);
      const Vec3f formula = internal::scalar::bsdf_reflected(seen) + (s.bsdf.body + s.bsdf.through) * internal::scalar::bsdf_entering(seen);
      const Vec3f e = Furnace(s.bsdf, Slanted(z));
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(e[k], formula[k], s.bsdf.coat > 0 ? 0.04f : 0.015f) << s.name << ' ' << z;
    }
  }
}

TEST(Bsdf, SamplesHaveTheirDensity) {
  // Surfaces by slants of view; all tests together at 1 %.
  const std::vector<Surface> surfaces = Surfaces();
  const std::vector<float> slants{0.15f, 0.5f, 0.95f};
  const double significance = test::Sidak(0.01, static_cast<int64_t>(surfaces.size() * slants.size()));
  for (const Surface& s : surfaces) {
    for (float z : slants) {
      const Vec3f v = Slanted(z, 2.0f);
      const auto seen = bsdf_side(s.bsdf, z);
      const auto p = bsdf_lobes(s.bsdf, seen);
      RngStream random(7, s.name, static_cast<uint64_t>(z * 100));
      const auto unit = [&] { return static_cast<float>(random.Bits() >> 40) * 0x1p-24f; };
      const double chance = test::ChiSquareOfDirections(
          [&](Vec3f& d) {
            float event = 0;
            const float a = unit(), b = unit(), c = unit();
            d = bsdf_sample(s.bsdf, p, kUp, v, a, b, c, event);
            return event == 1;
          },
          [&](Vec3f d) {
            float pdf = 0;
            bsdf_evaluate(s.bsdf, seen, p, kUp, v, d, pdf);
            return pdf;
          },
          40000, {.across = 16, .up = 16, .fine = 24});
      EXPECT_GT(chance, significance) << s.name << ' ' << z;
    }
  }
}

TEST(Bsdf, NarrowestLobesStaySane) {
  const Bsdf b = Standard({1, 1, 1}, 1, 0.0f);
  for (float z : {0.02f, 0.3f, 1.0f}) {
    const Vec3f e = Furnace(b, Slanted(z), 64);
    EXPECT_TRUE(std::isfinite(e.y)) << z;
    EXPECT_NEAR(e.y, 1, 0.01) << z;
  }
}

TEST(Bsdf, LeavesLetLightThrough) {
  const Bsdf leaf = bsdf_make(kFoliage, {0.1f, 0.3f, 0.05f}, 0, 0.5f, 0.8f, 0, 0.03f);
  float pdf = 0;
  const Vec3f through = Evaluate(leaf, kUp, -kUp, pdf);
  EXPECT_GT(through.y, 0.5f * 0.3f * 0.8f / 3.14159f);
  EXPECT_GT(pdf, 0);
  EXPECT_EQ(Evaluate(Standard({1, 1, 1}, 0, 0.5f), kUp, -kUp, pdf).y, 0);
  EXPECT_EQ(pdf, 0);
}

}  // namespace
}  // namespace airsim360
