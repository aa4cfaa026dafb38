// No seam: where the panorama closes, and where six pictures of a cube would meet, neighbouring pixels differ as
// much as anywhere else.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

constexpr int kWidth = 64, kFrames = 256;

class Seam : public testing::TestWithParam<Tier> {};

TEST_P(Seam, HasTheContrastOfAnyOtherColumn) {
  const auto tracer = std::make_shared<const RayTracer>(test::MakeOpenSquare());
  const auto renderer = MakeCpuRenderer(tracer, {.tier = GetParam()});
  // The columns pass over the whole scene in steps that are no whole columns.
  std::vector<double> contrast(kWidth);
  double mean = 0;
  Frame frame;
  for (int k = 0; k < kFrames; ++k) {
    const double yaw = 2 * std::numbers::pi * (k + static_cast<double>(k) / kFrames) / kWidth;
    renderer->Render(MakeRequest(Equirectangular{kWidth, kWidth / 2}, BodyPose({0.3, 0.2, 1.7}, yaw, 0, 0) * CameraInBody(), GetParam()),
                     frame);
    for (int y = 0; y < frame.rgb.height(); ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double step = std::abs(frame.rgb(x, y).g - frame.rgb((x + 1) % kWidth, y).g);
        contrast[x] += step, mean += step / kWidth;
      }
    }
  }
  EXPECT_NEAR(contrast[kWidth - 1] / mean, 1, 0.02);
  for (const int edge : {1, 3, 5, 7})  // upright edges of the cube
    EXPECT_NEAR(contrast[edge * kWidth / 8 - 1] / mean, 1, 0.02) << edge * 45 << " degrees";
}

INSTANTIATE_TEST_SUITE_P(Tiers, Seam, testing::Values(Tier::kFast, Tier::kHigh),
                         [](const auto& info) { return kTierNames[static_cast<int>(info.param)]; });

}  // namespace
}  // namespace airsim360
