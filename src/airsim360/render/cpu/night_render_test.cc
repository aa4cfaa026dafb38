// Lamps, beams and lit windows belong to the night: by day they leave every byte as it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

TEST(NightRender, TheLightOfAHeadLampGoesWhereTheLampGoes) {
  constexpr uint32_t kLitLens = 26;  // at (3, 0), looking away from the camera
  auto moved = std::make_shared<SceneState>();
  moved->moved = {{kLitLens, PlaceUpright({-3, 0, 0.7f}, 3.14159f), false}};
  const auto scene = MakeNightStreet(true);
  for (const Tier tier : {Tier::kFast, Tier::kHigh}) {
    const auto make = [&] {
      return MakeCpuRenderer(std::make_shared<const RayTracer>(scene), {.tier = tier, .environment = ParseEnvironmentPreset("night")});
    };
    RenderRequest request = MakeRequest(Equirectangular{160, 80}, BodyPose({0, -6, 2}, 1.5, 0, 0) * CameraInBody(), tier);
    request.products.radiance = true;
    // Light of the ground before the place on the left, and on the right.
    const auto sides = [&](const Frame& frame) { return std::array{frame.radiance(68, 46).g, frame.radiance(88, 46).g}; };
    Frame before, there, back;
    const auto renderer = make();
    renderer->Render(request, before);
    request.state = moved;
    renderer->Render(request, there);
    const auto [left, right] = sides(before);
    const auto [left_then, right_then] = sides(there);
    EXPECT_GT(right, 5 * left);
    EXPECT_GT(left_then, 5 * right_then);
    EXPECT_NEAR(left_then / right, 1, 0.1);
    {
      const ThreadLimit limit(1);
      Frame alone;
      make()->Render(request, alone);
      EXPECT_EQ(alone.rgb, there.rgb);
    }
    request.state = std::make_shared<SceneState>();
    renderer->Render(request, back);
    EXPECT_EQ(back.rgb, before.rgb);
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
