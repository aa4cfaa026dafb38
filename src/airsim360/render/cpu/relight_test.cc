// A renderer that follows the weather against one that is made for it.
#include <gtest/gtest.h>

#include <memory>

#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/relightable.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

using namespace test;

Image<Rgb8> Picture(Renderer& renderer, Tier tier) {
  Frame frame;
  const RigidTransform X_WC = BodyPose({0.3, -0.2, 2}, 0.3, 0.2, 0.1) * CameraInBody();
  renderer.Render(MakeRequest(Equirectangular{96, 48}, X_WC, tier), frame);
  return frame.rgb;
}

// Each differs from the one before in other things: nothing of the light, the air alone, the sky, the clouds, the sun, the air before
// clouds; then back. Skies with clouds take seconds, so that few have some.
std::vector<Environment> Weathers() {
  Environment clear;
  clear.cloud_cover = clear.cirrus_cover = 0;
  std::vector<Environment> weathers(8, clear);
  weathers[1].wetness = 1, weathers[1].snow_depth = 0.4;
  weathers[2].visibility_m = 120;
  weathers[3].visibility_m = 60, weathers[3].rain_mm_h = 12;
  weathers[4].cloud_cover = 1, weathers[4].snowfall_mm_h = 3;
  weathers[5] = Environment{.sun_elevation_deg = -3};
  weathers[6] = weathers[5], weathers[6].visibility_m = 120;
  return weathers;
}

TEST(Relight, APictureDoesNotKnowWhichWayItsWeatherCame) {
  const auto tracer = std::make_shared<const RayTracer>(MakeOpenSquare());
  for (const Tier tier : {Tier::kFast, Tier::kHigh}) {
    const auto follows = MakeCpuRenderer(tracer, {.tier = tier});
    int number = 0;
    std::vector<Environment> weathers = Weathers();
    // Skies do not depend on the tier: the snowy ground, the rain and the way back.
    if (tier == Tier::kHigh) weathers = {weathers[1], weathers[3], weathers[0]};
    for (const Environment& weather : weathers) {
      ASSERT_TRUE(dynamic_cast<Relightable&>(*follows).SetEnvironment(weather));
      const auto made = MakeCpuRenderer(tracer, {.tier = tier, .environment = weather});
      EXPECT_EQ(Picture(*follows, tier), Picture(*made, tier)) << "weather " << number;
      ++number;
    }
  }
}

}  // namespace
}  // namespace airsim360
