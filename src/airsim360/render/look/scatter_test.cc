// What the lens scatters: the point-spread function on the sphere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/math/vector.h"
#include "airsim360/render/look/scatter.h"
#include "airsim360/render/look/test_point_spread.h"

namespace airsim360 {
namespace {

using namespace internal;

Vec3d CellDirection(const LightCells& cells, int x, int y) {
  const double theta = 2 * kPi * (x + 0.5) / cells.width, phi = kPi * (0.5 - (y + 0.5) / cells.height);
  return {std::cos(phi) * std::cos(theta), std::cos(phi) * std::sin(theta), std::sin(phi)};
}

double Energy(const LightCells& cells, int plane) {
  double sum = 0;
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x) sum += cells.At(plane, x, y) * cells.CellAngle(y);
  return sum;
}

struct Place {
  const char* name;
  int x, y;
};
class ScatterTest : public testing::TestWithParam<Place> {};

TEST_P(ScatterTest, APointOfLightSpreadsByTheAnalyticFunctionAndKeepsItsEnergy) {
  constexpr int kWidth = 1024, kHeight = 512;
  constexpr double kAngle = 2;
  LightCells light(true, kWidth, kHeight, 2 * kPi / kWidth, kPi / kHeight), out;
  const Place at = GetParam();
  light.At(1, at.x, at.y) = static_cast<float>(1 / light.CellAngle(at.y));
  const ScatterMixture mixture = MakeScatterMixture(kAngle, kPi / kHeight);
  Scatter(mixture, light, out);
  EXPECT_NEAR(Energy(out, 1) + mixture.kept, 1, 2e-4);
  EXPECT_NEAR(Energy(out, 0), 0, 1e-5);
  EXPECT_NEAR(Energy(out, 2), 0, 1e-5);
  // Means over rings of half a degree about the source, and the worst single cell.
  const Vec3d source = CellDirection(light, at.x, at.y);
  double worst = 0;
  for (const double theta_deg : {1.5, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 40.0, 70.0, 120.0}) {
    double sum = 0, weight = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double theta = std::acos(std::clamp(Dot(source, CellDirection(light, x, y)), -1.0, 1.0));
        if (std::abs(theta / kDegree - theta_deg) > 0.18) continue;
        const double expected = PointSpread(kAngle, theta);
        worst = std::max(worst, std::abs(out.At(1, x, y) / expected - 1));
        sum += out.At(1, x, y) / expected * light.CellAngle(y);
        weight += light.CellAngle(y);
        x += theta_deg > 15 ? 15 : 0;  // fewer of wide rings
      }
    }
    ASSERT_GT(weight, 0) << theta_deg;
    EXPECT_NEAR(sum / weight, 1, 0.02) << at.name << ' ' << theta_deg;
  }
  EXPECT_LT(worst, 0.06) << at.name;
}

INSTANTIATE_TEST_SUITE_P(Everywhere, ScatterTest,
                         testing::Values(Place{"middle", 512, 255}, Place{"seam", 0, 200}, Place{"pole", 300, 0},
                                         Place{"near_pole", 700, 505}, Place{"high", 1023, 60}),
                         [](const auto& info) { return info.param.name; });

TEST(ScatterTest, APlaneKeepsItsEnergyBetweenMirrors) {
  LightCells light(false, 64, 40, 0.01, 0.01), out;
  light.At(0, 2, 3) = 5, light.At(2, 60, 39) = 2;
  const ScatterMixture mixture = MakeScatterMixture(2, 0.01);
  Scatter(mixture, light, out);
  EXPECT_NEAR(Energy(out, 0) / Energy(light, 0) + mixture.kept, 1, 1e-4);
  EXPECT_NEAR(Energy(out, 2) / Energy(light, 2) + mixture.kept, 1, 1e-4);
  EXPECT_GT(out.At(0, 2, 4), out.At(0, 2, 6));
}

}  // namespace
}  // namespace airsim360
