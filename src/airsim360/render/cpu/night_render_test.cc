// Lamps, beams and lit windows belong to the night: by day they leave every byte as it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "airsim360/base/parallel.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

using namespace test;

Frame Picture(const std::shared_ptr<const Scene>& scene, const Environment& environment, Tier tier) {
  const auto renderer = MakeCpuRenderer(std::make_shared<const RayTracer>(scene), {.tier = tier, .environment = environment});
  RenderRequest request = MakeRequest(Equirectangular{160, 80}, BodyPose({0, -6, 2}, 1.5, 0, 0) * CameraInBody(), tier);
  request.products.radiance = true;
  Frame frame;
  renderer->Render(request, frame);
  return frame;
}

TEST(NightRender, LampsThatAreOffLeaveEveryByteOfADayAsItIs) {
  const Environment clear{.cloud_cover = 0, .cirrus_cover = 0};  // four skies
  for (const Tier tier : {Tier::kFast, Tier::kHigh}) {
    const Frame with = Picture(MakeNightStreet(true), clear, tier), without = Picture(MakeNightStreet(false), clear, tier);
    EXPECT_EQ(with.rgb, without.rgb);
    EXPECT_EQ(with.entity, without.entity);
  }
}

TEST(NightRender, WindowsDifferByNightAndOneOrManyThreadsGiveTheSameBytes) {
  Environment night = ParseEnvironmentPreset("night");
  const Frame many = Picture(MakeNightStreet(true), night, Tier::kFast);
  {
    const ThreadLimit limit(1);
    EXPECT_EQ(Picture(MakeNightStreet(true), night, Tier::kFast).rgb, many.rgb);
  }
  // The windows before the camera: dark ones, and lit ones of more than one brightness and hue.
  int dark = 0, lit = 0;
  float dimmest = 1e9f, brightest = 0, warmest = 0, coolest = 1e9f;
  for (int y = 24; y < 44; ++y) {
    for (int x = 55; x < 95; ++x) {
      const Rgb32f c = many.radiance(x, y);
      const float light = 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
      if (light < 2 * kNit) ++dark;
      if (light < 4 * kNit) continue;
      ++lit;
      dimmest = std::min(dimmest, light), brightest = std::max(brightest, light);
      warmest = std::max(warmest, c.r / c.b), coolest = std::min(coolest, c.r / c.b);
    }
  }
  EXPECT_GT(dark, 20);
  EXPECT_GT(lit, 30);
  EXPECT_GT(brightest, 3 * dimmest);
  EXPECT_GT(warmest, 2 * coolest);
}

}  // namespace
}  // namespace airsim360
