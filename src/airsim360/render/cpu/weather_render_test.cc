// Pictures under weather: what must hold of every panorama.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "airsim360/base/parallel.h"
#include "airsim360/render/frame/test_room.h"
#include "airsim360/render/renderer.h"

namespace airsim360 {
namespace {

using namespace test;

std::unique_ptr<Renderer> Under(const Environment& environment) {
  static const auto tracer = std::make_shared<const RayTracer>(MakeOpenSquare());
  return MakeCpuRenderer(tracer, {.tier = Tier::kFast, .environment = environment});
}

// Rain, snow and fog at once, clouds that throw shadows.
Environment Foul() {
  Environment environment;
  environment.rain_mm_h = 20, environment.snowfall_mm_h = 2, environment.visibility_m = 120;
  return environment;
}

Image<Rgb8> Picture(Renderer& renderer, int width, const RigidTransform& X_WC) {
  Frame frame;
  renderer.Render(MakeRequest(Equirectangular{width, width / 2}, X_WC, Tier::kFast), frame);
  return frame.rgb;
}

double Mean(const Image<Rgb8>& image) {
  double sum = 0;
  for (const Rgb8 p : image.pixels()) sum += (p.r + p.g + p.b) / 3.0 / static_cast<double>(image.size());
  return sum;
}

const RigidTransform kPose = BodyPose({0.3, -0.2, 2}, 0.3, 0.2, 0.1) * CameraInBody();

// What two tests look at.
Renderer& UnderFoul() {
  static const auto renderer = Under(Foul());
  return *renderer;
}

TEST(WeatherRender, TurningTheRigRollsRainSnowAndFogByteForByte) {
  Renderer& renderer = UnderFoul();
  constexpr int kWidth = 200;
  const Image<Rgb8> still = Picture(renderer, kWidth, kPose);
  for (int k : {1, 37, kWidth - 1}) {
    RigidTransform X = kPose;
    X.R = ToMatrix(ToQuaternion(X.R * RotationY(2 * std::numbers::pi * k / kWidth)));
    const Image<Rgb8> turned = Picture(renderer, kWidth, X);
    int different = 0;
    for (int y = 0; y < still.height(); ++y) {
      for (int x = 0; x < kWidth; ++x) different += !(turned(x, y) == still((x + k) % kWidth, y));
    }
    EXPECT_EQ(different, 0) << k;
  }
}

TEST(WeatherRender, OneAndManyThreadsGiveTheSameBytes) {
  const Image<Rgb8> many = Picture(UnderFoul(), 160, kPose);
  const ThreadLimit limit(1);
  EXPECT_EQ(Picture(UnderFoul(), 160, kPose), many);
}

TEST(WeatherRender, DropsShowAndStandStillWhenNothingMoves) {
  Environment dry = Foul();
  dry.cloud_cover = dry.cirrus_cover = 0;  // three skies
  dry.rain_mm_h = dry.snowfall_mm_h = 0;
  Environment wet = dry;
  wet.rain_mm_h = 20;
  const Image<Rgb8> without = Picture(*Under(dry), 400, kPose), with = Picture(*Under(wet), 400, kPose),
                    again = Picture(*Under(wet), 400, kPose);
  EXPECT_EQ(with, again);
  int streaked = 0;
  for (size_t i = 0; i < with.size(); ++i) {
    streaked += std::abs(with.pixels()[i].g - without.pixels()[i].g) > 3;
  }
  EXPECT_GT(streaked, 400);
  EXPECT_LT(streaked, 60000);
}

TEST(WeatherRender, NightIsDarkerThanDuskIsDarkerThanDayAndNoneIsBlack) {
  double last = 256;
  for (const char* preset : {"day", "dusk", "night"}) {
    const double mean = Mean(Picture(*Under(ParseEnvironmentPreset(preset)), 120, kPose));
    EXPECT_LT(mean, last - 10) << preset;
    EXPECT_GT(mean, 12) << preset;
    last = mean;
  }
}

}  // namespace
}  // namespace airsim360
