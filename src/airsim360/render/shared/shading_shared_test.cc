#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#define AIRSIM360_ISA isa_test
#include "airsim360/base/random.h"
#include "airsim360/render/shared/precipitation_scalar.h"
#include "airsim360/render/shared/precipitation_simd.h"
#include "airsim360/render/sky/sky_table.h"
#include "airsim360/scene/material.h"

#define SHARED static inline __attribute__((unused))
#define INOUT(T) T&
#define IN(T) const T&
// The whole way of a skin through panes and weather, for C++ of either kind.
#define WEATHERED_SKIN                                                                            \
  SHARED Skin weathered(real a, real b, real c) {                                                 \
    const real3 n = normalize3(make3(a - 0.5f, b - 0.5f, c + 0.1f)), p = make3(a, b, c) * 40.0f;  \
    const Noises s{make3(a, b, c), make3(b, c, a), make3(c, a, b), b, c};                         \
    Skin k{make3(a, b, c), c, a, real(0.1f), b, real(0.0f), rfloor(c * 3.9f), n, make3(c, b, a)}; \
    glaze(a < 0.5f, b, c * 2.0f, p, n, k);                                                        \
    const Bed bed = bed_of(k, rfloor(a * 8.9f), n, b * 4.0f);                                     \
    wet_skin(bed, s, p, n, b * 0.02f, a, 0.8f, 0.7f, k);                                          \
    snowy_skin(bed, s, n, c, 0.6f, k);                                                            \
    wear_ground(bed.ground, s, p, b * 4.0f, c * 0.02f, k.color, k.roughness);                     \
    return k;                                                                                     \
  }                                                                                               \
  SHARED real weathered_sum(real a, real b, real c) {                                             \
    const Skin k = weathered(a, b, c);                                                            \
    return luminance(k.color + k.n + k.emission) + k.metallic + k.roughness + k.coat + k.kind;    \
  }
// clang-format off
namespace airsim360::internal::scalar {
#include "airsim360/render/shared/shading_marks.h"
#include "airsim360/render/shared/shading_surface.h"
WEATHERED_SKIN
}
namespace airsim360::internal::isa_test {
#include "airsim360/render/shared/shading_marks.h"
#include "airsim360/render/shared/shading_surface.h"
WEATHERED_SKIN
}
// clang-format on
#undef SHARED
#undef INOUT
#undef IN

namespace airsim360 {
namespace {

namespace scalar = internal::scalar;
namespace wide = internal::isa_test;
constexpr double kPi = 3.14159265358979;

// What shaders know of materials by numbers of their own.
static_assert(SURFACE_LOW_BEAM == kLowBeam);
static_assert(GROUND_ASPHALT == static_cast<float>(GroundWear::kAsphalt) &&
              GROUND_CARRIAGEWAY == static_cast<float>(GroundWear::kCarriageway));
static_assert(GROUND_PAVING == static_cast<float>(GroundWear::kPaving) && GROUND_LAWN == static_cast<float>(GroundWear::kLawn));
static_assert(GROUND_GRAVEL == static_cast<float>(GroundWear::kGravel) && GROUND_SOIL == static_cast<float>(GroundWear::kSoil));
static_assert(GROUND_ROOF == static_cast<float>(GroundWear::kRoof) && GROUND_ROOF_ROLLS == static_cast<float>(GroundWear::kRoofRolls));

Vec3f RandomUp(RngStream& random) {
  const double z = random.Uniform(0.05, 1.0), a = random.Uniform(0, 2 * kPi), s = std::sqrt(1 - z * z);
  return {static_cast<float>(s * std::cos(a)), static_cast<float>(s * std::sin(a)), static_cast<float>(z)};
}

Vec3f Specular(Vec3f f0, float alpha, Vec3f l, Vec3f v) {
  const Vec3f h = Normalized(l + v);
  return scalar::specular_brdf(f0, alpha, l.z, v.z, h.z, Dot(v, h));
}

// Midpoint rule over the hemisphere, uniform in cos theta.
template <class F>
double Hemisphere(F f, int n = 256) {
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double z = (i + 0.5) / n, a = (j + 0.5) / n * 2 * kPi, s = std::sqrt(1 - z * z);
      sum += f(Vec3f{static_cast<float>(s * std::cos(a)), static_cast<float>(s * std::sin(a)), static_cast<float>(z)}) * 2 * kPi / (n * n);
    }
  }
  return sum;
}

TEST(ShadingShared, WhiteLambertInUniformLightIsWhite) {
  const double out = Hemisphere([](Vec3f l) { return scalar::diffuse({1, 1, 1}, {l.z, l.z, l.z}).x; });
  EXPECT_NEAR(out, 1, 0.001);
}

TEST(ShadingShared, WhiteMirrorlikeSurfacesNeverReflectMoreThanArrives) {
  for (float roughness : {0.2f, 0.4f, 0.7f, 1.0f}) {
    for (float z : {0.1f, 0.5f, 1.0f}) {
      const Vec3f v{std::sqrt(1 - z * z), 0, z};
      const double out = Hemisphere([&](Vec3f l) { return Specular({1, 1, 1}, roughness * roughness, l, v).x * l.z; }, 512);
      EXPECT_LE(out, 1.005) << roughness << ' ' << z;
      EXPECT_GT(out, 0.25) << roughness << ' ' << z;
    }
  }
}

TEST(ShadingShared, EnvironmentBrdfAgreesWithTheIntegralOfTheSpecularBrdf) {
  for (float roughness : {0.3f, 0.6f, 0.9f}) {
    for (float z : {0.3f, 0.6f, 0.95f}) {
      const Vec3f v{std::sqrt(1 - z * z), 0, z};
      const double truth = Hemisphere([&](Vec3f l) { return Specular({0.5f, 0.5f, 0.5f}, roughness * roughness, l, v).x * l.z; }, 512);
      EXPECT_NEAR(scalar::environment_brdf({0.5f, 0.5f, 0.5f}, roughness, z).x, truth, 0.08) << roughness << ' ' << z;
    }
  }
}

TEST(ShadingShared, SpecularReflectionIsReciprocal) {
  RngStream random(1, "reciprocity");
  for (int i = 0; i < 100000; ++i) {
    const Vec3f a = RandomUp(random), b = RandomUp(random);
    const auto alpha = static_cast<float>(random.Uniform(0.05, 1));
    const float ab = Specular({0.04f, 0.5f, 0.9f}, alpha, a, b).y, ba = Specular({0.04f, 0.5f, 0.9f}, alpha, b, a).y;
    ASSERT_NEAR(ab, ba, 1e-5f * (1 + ab));
  }
}

TEST(ShadingShared, FresnelHasItsLimits) {
  EXPECT_NEAR(scalar::fresnel_dielectric(1.5f, 1), 0.04f, 1e-6f);
  EXPECT_NEAR(scalar::fresnel_dielectric(1.33f, 1), 0.02006f, 1e-4f);
  EXPECT_NEAR(scalar::fresnel_dielectric(1.5f, 1e-4f), 1, 2e-3f);
  EXPECT_NEAR(scalar::fresnel_schlick(0.04f, 1), 0.04f, 1e-7f);
  EXPECT_NEAR(scalar::fresnel_schlick(0.04f, 0), 1, 1e-7f);
}

TEST(ShadingShared, LeavesDoNotGiveBackMoreThanTheyGet) {
  const Vec3f lit = scalar::leaf_diffuse({0.5f, 0.5f, 0.5f}, 0.8f, -1);
  EXPECT_LT(lit.y * kPi, 0.5f);
  EXPECT_GT(lit.y, 0);
  EXPECT_FLOAT_EQ(scalar::leaf_diffuse({0.5f, 0.5f, 0.5f}, 0, -1).y, 0);
}

TEST(ShadingShared, ToneCurveGrowsWithLightAndKeepsGreyGrey) {
  float last = -1;
  for (double x = 1e-4; x < 1e4; x *= 1.02) {
    const auto v = static_cast<float>(x);
    const Vec3f c = scalar::tone_curve({v, v, v});
    EXPECT_GE(c.y, last) << x;
    EXPECT_NEAR(c.x, c.y, 1e-5f);
    EXPECT_LE(c.y, 1);
    last = c.y;
  }
  EXPECT_GT(last, 0.99f);
  EXPECT_LT(scalar::tone_curve({1e-4f, 1e-4f, 1e-4f}).y, 1e-3f);
}

TEST(ShadingShared, ToneCurveKeepsTheHueOfPureColoursHoweverBrightAndLeavesAllOthersAsTheyAre) {
  for (const float bright : {30.0f, 300.0f, 3000.0f}) {
    const Vec3f red = scalar::tone_curve(Vec3f{1, 0.02f, 0.01f} * bright), green = scalar::tone_curve(Vec3f{0.03f, 1, 0.05f} * bright);
    EXPECT_GT(red.x, 0.95f) << bright;
    EXPECT_LT(std::max(red.y, red.z), 0.1f) << bright;
    EXPECT_GT(green.y, 0.85f) << bright;
    EXPECT_LT(std::max(green.x, green.z), 0.1f) << bright;
    const Vec3f amber = scalar::tone_curve(Vec3f{1, 0.12f, 0} * bright);
    EXPECT_GT(amber.x, amber.y);
    EXPECT_LT(amber.z, 0.3f * amber.y) << bright;
    // White, sodium light and the sun on the horizon burn out as on film.
    EXPECT_GT(scalar::tone_curve(Vec3f{1, 0.3f, 0.2f} * bright).y, 0.85f) << bright;
  }
  // Nothing changes up to white, and where the second channel is a fifth of the first or more.
  RngStream rng(1, "tones");
  for (int i = 0; i < 4000; ++i) {
    const auto value = [&](double most) { return static_cast<float>(most * rng.Uniform(0, 1) * rng.Uniform(0, 1)); };
    const float most = i % 2 == 0 ? 3.0f : 500.0f,
                second = i % 2 == 0 ? value(3) : most * (0.21f + 0.79f * static_cast<float>(rng.Uniform(0, 1)));
    Vec3f c{most, second, std::min(second, value(most))};
    for (int k = i % 3; k > 0; --k) c = {c.y, c.z, c.x};
    EXPECT_EQ(scalar::keep_hue(c), c);
  }
}

TEST(ShadingShared, AgxGrowsWithLightKeepsGreyGreyAndMiddleGreyInPlace) {
  float last = -1;
  for (double x = 1e-5; x < 1e3; x *= 1.02) {
    const auto v = static_cast<float>(x);
    const Vec3f c = scalar::agx_curve({v, v, v});
    EXPECT_GE(c.y, last) << x;
    EXPECT_NEAR(c.x, c.y, 2e-4f) << x;
    EXPECT_NEAR(c.z, c.y, 2e-4f) << x;
    last = c.y;
  }
  EXPECT_NEAR(last, 1, 1e-3f);
  EXPECT_NEAR(scalar::agx_curve({0.18f, 0.18f, 0.18f}).y, 0.18f, 1e-3f);
  EXPECT_LT(scalar::agx_curve({1e-6f, 1e-6f, 1e-6f}).y, 1e-5f);
}

TEST(ShadingShared, AgxContrastHasItsSlopeAtMiddleGreyAndEndsInTheCorners) {
  EXPECT_NEAR((scalar::agx_contrast(0.607f) - scalar::agx_contrast(0.605f)) / 0.002f, 2.4f, 0.01f);
  EXPECT_NEAR(scalar::agx_contrast(0), 0, 1e-4f);
  EXPECT_NEAR(scalar::agx_contrast(1), 1, 1e-4f);
}

TEST(ShadingShared, AgxFadesBrightColoursToWhite) {
  // Pure red keeps its hue in the middle and loses saturation towards the top.
  const auto saturation = [](float v) {
    const Vec3f c = scalar::agx_curve({v, 0.02f * v, 0.02f * v});
    EXPECT_GE(c.x, c.y);
    return (c.x - c.y) / c.x;
  };
  EXPECT_GT(saturation(0.3f), 0.7f);
  EXPECT_LT(saturation(300), 0.1f);
}

TEST(ShadingShared, TheLinearCurveIsInvertible) {
  const Vec3f c = scalar::linear_curve({0.25f, 1.5f, -1});
  EXPECT_EQ(c, (Vec3f{0.25f, 1, 0}));
}

TEST(ShadingShared, OwnTranscendentalsAgreeWithTheLibrary) {
  for (double x = -30; x < 30; x += 0.01) {
    const auto f = static_cast<float>(x);
    EXPECT_NEAR(scalar::exp_approx(f) / std::exp(static_cast<double>(f)), 1, 4e-6) << x;
    EXPECT_NEAR(scalar::sin_approx(f), std::sin(static_cast<double>(f)), 5e-6) << x;
    EXPECT_NEAR(scalar::log2_approx(std::exp(f)), std::log2(static_cast<double>(std::exp(f))), 6e-6) << x;
    EXPECT_NEAR(scalar::atan2_approx(std::sin(f), std::cos(f)), std::atan2(std::sin(f), std::cos(f)), 3e-6) << x;
  }
  for (double x = -1; x <= 1; x += 0.001) EXPECT_NEAR(scalar::asin_approx(static_cast<float>(x)), std::asin(x), 4e-4) << x;
  for (int i = 0; i <= 255; ++i) {
    const double s = i / 255.0, linear = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(scalar::srgb_decode_approx(static_cast<float>(s)), linear, 0.001);
    EXPECT_NEAR(scalar::srgb_encode(static_cast<float>(linear)), s, 7e-5);
  }
}

TEST(ShadingShared, WaterIsFlatFarAwayAndLosesItsSlopeToRoughness) {
  float lost = 0;
  EXPECT_NEAR(scalar::water_normal(3, 4, 100, lost).z, 1, 1e-6f);
  EXPECT_NEAR(lost, 7 * 0.000145f, 1e-6f);
  EXPECT_LT(scalar::water_normal(3, 4, 0, lost).z, 0.99999f);
  EXPECT_NEAR(lost, 0, 1e-7f);
}

// Calls a function with lanes of the same arguments that the scalar one gets.
template <class Wide, class Scalar>
void ExpectSame(const char* name, Wide wide_function, Scalar scalar_function, double low, double high) {
  RngStream random(2, name);
  for (int round = 0; round < 500; ++round) {
    alignas(64) float a[wide::kLanes], b[wide::kLanes], c[wide::kLanes], out[wide::kLanes];
    for (int i = 0; i < wide::kLanes; ++i) {
      a[i] = static_cast<float>(random.Uniform(low, high));
      b[i] = static_cast<float>(random.Uniform(low, high));
      c[i] = static_cast<float>(random.Uniform(low, high));
    }
    wide::store(out, wide_function(wide::load(a), wide::load(b), wide::load(c)));
    for (int i = 0; i < wide::kLanes; ++i) {
      const float expected = scalar_function(a[i], b[i], c[i]);
      ASSERT_NEAR(out[i], expected, 1e-6f * (1e-3f + std::fabs(expected))) << name << ' ' << a[i] << ' ' << b[i] << ' ' << c[i];
    }
  }
}

TEST(ShadingShared, ScalarAndSimdAgree) {
#define SAME(low, high, expression)                  \
  ExpectSame(                                        \
      #expression,                                   \
      [](wide::real a, wide::real b, wide::real c) { \
        using namespace wide;                        \
        (void)a, (void)b, (void)c;                   \
        return expression;                           \
      },                                             \
      [](float a, float b, float c) {                \
        using namespace scalar;                      \
        (void)a, (void)b, (void)c;                   \
        return expression;                           \
      },                                             \
      low, high)
  SAME(-20, 20, exp_approx(a) + sin_approx(b * 50.0f) + atan2_approx(b, c));
  SAME(0.001, 50, log2_approx(a) + pow_approx(b, c * 0.1f) + pow_display(c, b * 0.03f));
  SAME(0.001, 1, srgb_encode(a) + srgb_decode_approx(b) + asin_approx(c));
  SAME(0, 4, luminance(tone_curve(make3(a, b, c))));
  SAME(0, 40, luminance(keep_hue(make3(a, b * 0.1f, c * 0.2f))));
  SAME(0, 20, luminance(agx_curve(make3(a, b, c))) + linear_curve(make3(a, b, c)).x);
  SAME(0.02, 1, luminance(specular_brdf(make3(a, b, c), a, b, c, a, b)));
  SAME(0.02, 1, luminance(environment_brdf(make3(a, b, c), b, c)));
  SAME(0.02, 1, fresnel_dielectric(a + 1.0f, b) + fresnel_schlick(b, c));
  SAME(-1, 1, leaf_diffuse(make3(a, b, c), b, c).x);
  SAME(-1, 1, dot3(octahedral_decode(a, b), make3(a, b, c)));
  SAME(-1, 1, layer_path(a * 100.0f, b, c * 1000.0f, 160.0f) + forward_phase(0.76f, a));
  // A roof of 2 m over half of the lattice.
  std::vector<float> heights(16 * 16);
  for (size_t i = 0; i < heights.size(); ++i) heights[i] = i % 16 < 8 ? 2.0f : -1e30f;
  static internal::RoofView roofs;
  roofs = {heights.data(), 16, -1.6f, -1.6f, 5.0f, 0.12f};
  SAME(-1, 1, roofed_way(roofs, make3(a, b, c), make3(b, c, a), 7.0f) + roof_share(roofs, make3(a, b, c)));
  SAME(-1, 1, drops_cover(roofs, 0.12f, a * 9.0f, b, c, make3(a, b, c), 6.0f, 0.003f, 0.4f, 0.5f, 0.2f, 0.01f, 0.9f, 5.0f, 3.0f));
  SAME(0, 2, water_normal(a * 100.0f, b * 100.0f, c, a).x + a);
  SAME(0, 1, hash_cell(a * 1000.0f, b * 1000.0f) + wet_albedo(c));
  SAME(-1, 1, snow_cover(a, b, c, a) + puddle_cover(b, c));
  SAME(0, 1, paving_marks(make3(a, b, c), a * 90.0f, b * 70.0f, make3(b, c, a), make3(c, a, b), make3(a, c, b), a, b * 0.01f).y);
  SAME(0, 1, asphalt_marks(make3(a, b, c), a * 90.0f, b * 70.0f, make3(b, c, a), make3(c, a, b), make3(a, c, b), a, b * 0.01f).z);
  SAME(0, 1, weathered_sum(a, b, c));
  SAME(-1, 1, mixed_tile(c > 0.0f, a * 9.0f, b * 9.0f, c * 4.0f).gain + mixed_tile(c > 0.0f, a * 9.0f, b * 9.0f, c * 4.0f).u[1]);
  SAME(0, 1, luminance(macro_tint(a, Noises{make3(a, b, c), make3(b, c, a), make3(c, a, b), a, b}, c)));
  SAME(0, 1, luminance(unit_tint(a * 8.0f, b * 9.0f, b * 40.0f, c * 40.0f, a - 3.0f) + leaf_tint(a > 0.5f, b, c, make3(a, b, c))));
  SAME(0, 1, look_inside(a, b, a + 0.5f, b + 0.5f, c - 0.5f, a - 0.5f, b, c, make3(a, b, c), a, b).lamplight.y);
  SAME(0, 1, bend_normal(make3(a, b, 0.9f + 0.1f * c), make3(a, c, b + 0.1f), make3(b, a, c), a - 0.5f, b, c).y);
  SAME(-1, 1, windy_water(make3(a, b, c) * 90.0f, make3(b, c, a), 0.01f + a * a, b).y);
  SAME(-1, 1, glass_normal(a * a, make3(a, b, c), make3(c, a, b)).z);
  SAME(-1, 1, precipitation_hides(roofs, 4.0f, 2.0f, make3(a * 9.0f, b, c), make3(a, b, c), a * 3.0f + 9.0f, 0.003f));
  SAME(0, 1, sky_row(a) + luminance(blur_shares(b)) + open_share(a, b) + sun_limb(c) + contact_share(a, b + 0.1f) + fog_share(a, b));
  SAME(-1, 1, dot3(leave_above(normalize3(make3(a, b, c)), make3(b, c, a)), cosine_direction(make3(a, c, b), make3(c, b, a))));
  SAME(0.05, 1, luminance(lamp_highlight(lamp_skin(make3(a, b, c), b), c, a * 0.1f, b * 9.0f, a, b, c, a)) + plane_stretch(a, b - c));
#undef SAME
}

TEST(ShadingSurface, CopiesOfATileAddUpToOneAndKeepTheContrast) {
  RngStream random(3, "tiles");
  for (int i = 0; i < 10000; ++i) {
    const auto u = static_cast<float>(random.Uniform(-50, 50)), v = static_cast<float>(random.Uniform(-50, 50));
    const scalar::TileCorners c = scalar::mixed_tile(true, u, v, -6);
    ASSERT_NEAR(c.weight[0] + c.weight[1] + c.weight[2], 1, 1e-6);
    const float squares = c.weight[0] * c.weight[0] + c.weight[1] * c.weight[1] + c.weight[2] * c.weight[2];
    ASSERT_NEAR(c.gain * c.gain * squares, 1, 1e-5);
    // Far away one copy is left.
    ASSERT_FLOAT_EQ(scalar::mixed_tile(true, u, v, -1).gain, 1);
  }
}

TEST(ShadingSurface, SnowWhitensLevelGroundAndNoOverhang) {
  const Vec3f half{0.5f, 0.5f, 0.5f};
  const scalar::Noises noises{half, half, half, 1, 0};
  const auto snowed = [&](Vec3f facing, float open) {
    scalar::Skin skin{{0.1f, 0.1f, 0.1f}, 0, 0.9f, 0, 0, 0, 0, facing, {}};
    scalar::snowy_skin(scalar::bed_of(skin, 0, facing, 0), noises, facing, open, 1, skin);
    return skin.color.y;
  };
  EXPECT_GT(snowed({0, 0, 1}, 1), 0.75f);
  EXPECT_FLOAT_EQ(snowed({0, 0, -1}, 1), 0.1f);
  EXPECT_FLOAT_EQ(snowed({1, 0, 0}, 1), 0.1f);
  EXPECT_FLOAT_EQ(snowed({0, 0, 1}, 0.1f), 0.1f);  // under a canopy
}

TEST(ShadingSurface, MoreRainHidesMoreAndNoneHidesNothing) {
  const internal::RoofView open{nullptr, 0, 0, 0, 0, 0};
  double last = 0;
  for (const float rate : {0.0f, 1.0f, 4.0f, 9.0f}) {
    RngStream random(4, "rain");
    double hidden = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3f d = RandomUp(random), o{static_cast<float>(random.Uniform(-90, 90)), static_cast<float>(random.Uniform(-90, 90)), 2};
      hidden += scalar::precipitation_hides(open, rate, 0, o, d, 100, 0.003f);
    }
    if (rate == 0) {
      EXPECT_EQ(hidden, 0);
    } else {
      EXPECT_GT(hidden, 1.2 * last) << rate;
    }
    last = hidden;
  }
}

TEST(ShadingShared, ProbesCountAsRaysByNightAlone) {
  constexpr float kLuxOfSky = 20.0f / 133300;
  EXPECT_EQ(scalar::probe_rays(20000 * kLuxOfSky), 0);
  EXPECT_EQ(scalar::probe_rays(4 * kLuxOfSky), 0);
  EXPECT_NEAR(scalar::probe_rays(2 * kLuxOfSky), 2, 0.01);
  EXPECT_EQ(scalar::probe_rays(0.3f * kLuxOfSky), 4);
}

// Mean of what `marks` makes of `color` over 12 x 12 m of average noise, seen with pixels of `width`.
template <typename Marks>
double MeanOver(Marks marks, Vec3f color, float width) {
  const Vec3f middle{0.5f, 0.5f, 0.5f};
  RngStream random(5, "marks");
  double sum = 0;
  constexpr int kPlaces = 40000;
  for (int i = 0; i < kPlaces; ++i) {
    const auto at = [&] { return static_cast<float>(random.Uniform(-6, 6)); };
    sum += marks(color, at(), at(), middle, middle, middle, 1.0f, width).y;
  }
  return sum / kPlaces;
}

TEST(GroundMarks, AreOfTheSameMeanFromNearAndFar) {
  for (float y : {0.10f, 0.30f}) {
    const Vec3f color{y, y, y};
    EXPECT_NEAR(MeanOver(scalar::paving_marks, color, 0.05f), MeanOver(scalar::paving_marks, color, 0.001f), 0.03 * y);
    EXPECT_NEAR(MeanOver(scalar::asphalt_marks, color, 0.05f), MeanOver(scalar::asphalt_marks, color, 0.001f), 0.06 * y);
  }
}

TEST(GroundMarks, SpotsCoverTheShareThatTheirRadiiGive) {
  // Radii r = a + (b - a) h^2 with h uniform: the mean of r^2 is a^2 + 2 a (b - a) / 3 + (b - a)^2 / 5. Squeezing keeps the area.
  constexpr float kCell = 0.5f, kLeast = 0.05f, kMost = 0.09f, kShare = 0.4f;
  RngStream random(6, "spots");
  double sum = 0;
  constexpr int kPlaces = 200000;
  for (int i = 0; i < kPlaces; ++i) {
    float tone = 0, rim = 0;
    sum += scalar::ground_spot(static_cast<float>(random.Uniform(0, 400)), static_cast<float>(random.Uniform(0, 400)), kCell, kShare,
                               kLeast, kMost, 0, 1e-4f, tone, rim);
  }
  const double d = kMost - kLeast, area = kPi * (kLeast * kLeast + 2 * kLeast * d / 3 + d * d / 5);
  EXPECT_NEAR(sum / kPlaces, kShare * area / (kCell * kCell), 0.004);
}

TEST(GroundMarks, WearTakesPaintToTheColourOfTheRoadAndLeavesAsphaltNearIt) {
  const Vec3f paint{0.55f, 0.55f, 0.55f}, road{0.09f, 0.09f, 0.09f}, worn{0.5f, 0.5f, 0.5f}, torn{0.75f, 0.5f, 0.85f},
      kept{0.3f, 0.3f, 0.3f};
  const auto y = [&](Vec3f color, Vec3f noise, float x) {
    return scalar::asphalt_marks(color, x, 3.3f, worn, noise, noise, 1.0f, 0.001f).y;
  };
  double gone = 0, left = 0, bare = 0;
  for (int i = 0; i < 500; ++i) {
    const float x = 0.013f * static_cast<float>(i);
    gone += y(paint, torn, x) / 500, left += y(paint, kept, x) / 500, bare += y(road, kept, x) / 500;
  }
  EXPECT_LT(gone, 0.25);
  EXPECT_GT(left, 0.40);
  EXPECT_NEAR(bare, 0.09, 0.02);
}

TEST(ShadingShared, CompilesAsGlsl) {
  if (std::system("command -v glslangValidator > /dev/null 2>&1") != 0) GTEST_SKIP() << "glslangValidator is not installed";
  // A compute shader that uses the functions, pasted together from our headers.
  const auto read = [](const std::string& name) {
    std::ifstream file("src/airsim360/render/shared/" + name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  };
  const std::string shared = read("shading_shared.h") + read("shading_air.h");
  if (shared.empty()) GTEST_SKIP() << "not run from the repository's root";
  const std::string stem = (std::filesystem::temp_directory_path() / ("airsim360_glsl_" + std::to_string(getpid()))).string();
  {
    std::ofstream out(stem + ".comp");
    out << "#version 450\nlayout(local_size_x = 1) in;\nlayout(binding = 0) buffer Values { float v[]; };\n"
        << read("shading_constants.h") << read("shading_glsl.h") << shared << read("shading_sky.h")
        << "#define ROOFS\n#define ROOFS_ARGUMENT\n#define ROOFS_TEXELS_PER_METRE 4.0\nbool roof_hides(vec3 p) { return p.z < 2.0; }\n"
        << read("shading_precipitation.h") << read("shading_tone.h") << read("shading_interior.h") << read("shading_wet_snow.h")
        << read("shading_moon.h") << read("shading_ground.h") << read("shading_marks.h") << "#define in in_\n"
        << read("shading_bsdf.h") << "#undef in\n"
        << read("shading_surface.h")
        << "void main() { float lost = 0.0; vec3 n = water_normal(v[0], v[1], v[2], lost);\n"
           "  vec3 c = specular_brdf(n, v[1], v[2], v[3], v[4], v[5]) + environment_brdf(n, v[0], v[1]) + "
           "leaf_diffuse(n, v[0], v[1]);\n"
           "  v[0] = srgb_encode(luminance(tone_curve(c) + agx_curve(c))) + asin_approx(v[3]) + "
           "fresnel_dielectric(1.5, v[4]) + lost +\n"
           "  layer_path(v[0], v[1], v[2], 160.0) + around_horizon(n, n, n, n, n, n, n, c).x + "
           "shadow_column(v[0], v[1], "
           "0.5, 3.0, 0.1, 64.0) +\n  roofed_way(n, c, v[2]) + roof_share(n) + drops_cover(0.1, v[0], v[1], v[2], c, v[3], 0.1, 0.4, 0.5, 0.2, 0.01, 0.5, "
           "5.0, 1.0) + forward_phase(0.7, v[1]);\n"
           "  vec3 day, lamp; float front, a, b;\n"
           "  interior_room(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7],\n"
           "                day_light(v[7]) + evening_light(v[7], v[8]) + window_light(v[7], v[8]) * beam_shape(v[0], v[1], v[2]), "
           "day, lamp, front, a, b);\n"
           "  float sx, sy, tar, polish, gain; drop_rings(v[0], v[1], v[2], sx, sy);\n"
           "  asphalt_wear(v[0], v[1], v[2], v[3], n, c, day, v[4], v[5], gain, tar, polish);\n"
           "  v[1] = lawn_life(day, a, b, n, c, lamp, v[2], v[3]).x + puddle_cover(v[0], v[1]) + moon_face(n, c, day) + sx + gain + "
           "snow_cover(v[0], v[1], v[2], v[3]) + roof_wear(v[0], n, c, day, v[1], v[2], v[3]) + paving_marks(c, a, b, n, c, day, v[1], v[2]).x + "
           "asphalt_marks(c, a, b, n, c, day, v[1], v[2]).x;\n"
           "  Noises noises = Noises(c, day, n, v[2], v[3]); Skin skin = Skin(c, a, b, a, b, a, b, n, c);\n"
           "  glaze(a < b, a, b, n, c, skin); snowy_skin(bed_of(skin, a, n, b), noises, n, a, b, skin);\n"
           "  wet_skin(bed_of(skin, a, n, b), noises, n, c, a, b, a, b, skin); wear_ground(a, noises, n, a, b, skin.color, skin.roughness);\n"
           "  v[2] = skin.coat + mixed_tile(a < b, a, b, v[3]).gain + precipitation_hides(v[1], v[2], n, c, a, b); }\n";
  }
  const int status = std::system(("glslangValidator -V " + stem + ".comp -o " + stem + ".spv > " + stem + ".log 2>&1").c_str());
  std::ifstream log(stem + ".log");
  std::ostringstream message;
  message << log.rdbuf();
  EXPECT_EQ(status, 0) << message.str();
  for (const char* end : {".comp", ".spv", ".log"}) std::filesystem::remove(stem + end);
}

}  // namespace
}  // namespace airsim360
