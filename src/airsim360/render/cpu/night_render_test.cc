// Lamps, beams and lit windows belong to the night: by day they leave every byte as it is.
#include <gtest/gtest.h>

#include <memory>

#include "airsim360/base/parallel.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

using namespace test;

Frame Picture(const std::shared_ptr<const Scene>& scene, const Environment& environment, Tier tier) {
  const auto renderer = MakeCpuRenderer(std::make_shared<const RayTracer>(scene), {.tier = tier, .environment = environment});
  Frame frame;
  renderer->Render(MakeRequest(Equirectangular{160, 80}, BodyPose({0, -6, 2}, 1.5, 0, 0) * CameraInBody(), tier), frame);
  return frame;
}

TEST(NightRender, LampsThatAreOffLeaveEveryByteOfADayAsItIs) {
  for (const Tier tier : {Tier::kFast, Tier::kHigh}) {
    const Frame with = Picture(MakeNightStreet(true), {}, tier), without = Picture(MakeNightStreet(false), {}, tier);
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
  // The windows before the camera: dark ones, and lit ones of more than one hue.
  int dark = 0, warm = 0, other = 0;
  for (int y = 20; y < 40; ++y) {
    for (int x = 50; x < 110; ++x) {
      const Rgb8 c = many.rgb(x, y);
      if (c.r < 30) ++dark;
      else if (c.r > c.b + 60) ++warm;
      else ++other;
    }
  }
  EXPECT_GT(dark, 20);
  EXPECT_GT(warm, 20);
  EXPECT_GT(other, 5);
}

}  // namespace
}  // namespace airsim360
