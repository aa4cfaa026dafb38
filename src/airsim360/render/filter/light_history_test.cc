#include "airsim360/render/filter/light_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/render/filter/test_view.h"

namespace airsim360::internal {
namespace {

TEST(TemporalTest, FramesOfAStandingCameraAddUp) {
  const View view = MakeBall(256);
  Denoiser denoiser;
  double first = 0, last = 0;
  for (int frame = 0; frame < 8; ++frame) {
    Image<Rgb32f> light = Noise(view, 1, 0.2f, static_cast<uint64_t>(frame));
    denoiser.Run(view.guides(), {&light, nullptr, 2}, true);
    last = Variance(view, light, 1, Anywhere);
    if (frame == 0) first = last;
  }
  EXPECT_LT(last, first / 5);
}

TEST(TemporalTest, AMovingCameraDragsNoLightFromOneThingToAnother) {
  Denoiser denoiser;
  for (int frame = 0; frame < 6; ++frame) {
    const View view = MakeRoomView(256, {0.3 + 0.05 * frame, -0.4 + 0.2 * frame, 2});
    Image<Rgb32f> light(view.width(), view.height());
    for (size_t i = 0; i < light.size(); ++i) {
      const float v = 0.1f * static_cast<float>(view.entity.pixels()[i]);
      light.pixels()[i] = {v, v, v};
    }
    const Image<Rgb32f> expected = light;
    denoiser.Run(view.guides(), {&light, nullptr, 16}, true);
    double worst = 0;
    for (size_t i = 0; i < light.size(); ++i)
      worst = std::max(worst, std::abs(static_cast<double>(light.pixels()[i].g) - expected.pixels()[i].g));
    EXPECT_LT(worst, 1e-6) << frame;
  }
}

TEST(TemporalTest, AMovingCameraStillGathersSamples) {
  Denoiser denoiser;
  double still = 0, moved = 0;
  for (int frame = 0; frame < 6; ++frame) {
    const View view = MakeRoomView(256, {0.3, -0.4 + 0.1 * frame, 2});
    Image<Rgb32f> light = Noise(view, 1, 0.2f, static_cast<uint64_t>(frame)), single = light;
    denoiser.Run(view.guides(), {&light, nullptr, 1}, true);
    moved = Variance(view, light, 1, Anywhere);
    still = Variance(view, Filter(view, single, nullptr, 1), 1, Anywhere);
  }
  EXPECT_LT(moved, still / 3);
}

TEST(TemporalTest, ResetForgets) {
  const View view = MakeBall(128);
  Denoiser denoiser;
  Image<Rgb32f> first = Noise(view, 1, 0.2f, 1);
  const Image<Rgb32f> second = Noise(view, 1, 0.2f, 2);
  denoiser.Run(view.guides(), {&first, nullptr, 4}, true);
  denoiser.Reset();
  Image<Rgb32f> light = second;
  denoiser.Run(view.guides(), {&light, nullptr, 4}, true);
  EXPECT_TRUE(light == Filter(view, second, nullptr, 4));
}

TEST(TemporalTest, TurningTheCameraByColumnsChangesNothingInTheWorld) {
  // A standing camera and one that turns by whole columns see the same light at the same places.
  const View view = MakeRoomView(128);
  Denoiser standing, turning;
  for (int frame = 0; frame < 3; ++frame) {
    const int k = 5 * frame;
    Image<Rgb32f> light = Noise(view, 1, 0.2f, static_cast<uint64_t>(frame)), rolled = light;
    View turned = view;
    turned.X_WC.R = view.X_WC.R * RotationY(2 * std::numbers::pi * k / view.width());
    for (int y = 0; y < view.height(); ++y) {
      for (int x = 0; x < view.width(); ++x) {
        const int from = (x + k) % view.width();
        turned.range(x, y) = view.range(from, y);
        turned.entity(x, y) = view.entity(from, y);
        turned.normal(x, y) = view.normal(from, y);
        rolled(x, y) = light(from, y);
      }
    }
    standing.Run(view.guides(), {&light, nullptr, 8}, true);
    turning.Run(turned.guides(), {&rolled, nullptr, 8}, true);
    for (int y = 0; y < view.height(); ++y) {
      for (int x = 0; x < view.width(); ++x) ASSERT_EQ(rolled(x, y), light((x + k) % view.width(), y));
    }
  }
}

}  // namespace
}  // namespace airsim360::internal
