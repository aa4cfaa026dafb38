#include "airsim360/render/filter/light_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "airsim360/base/parallel.h"
#include "airsim360/base/table_vector.h"
#include "airsim360/render/filter/filter_buffers.h"
#include "airsim360/render/filter/filter_kernels.h"
#include "airsim360/render/filter/test_view.h"

namespace airsim360::internal {
namespace {

using test::Truth;

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

// A room open to the sky, of a width that is no whole number of vectors.
View MakeOpenRoom(Vec3d p, double turn) {
  const auto look = [](Vec3d o, Vec3d d) { return d.z < 0.3 ? test::Look(o, d) : Truth{1e30, 2, {}}; };
  return MakeView(100, p, look, RotationY(turn) * RotationZ(0.7 * turn));
}

/// Light and samples of what `recall` makes of the second frame, row by row, with what `keep` kept of the
/// first.
template <class Keep, class Recall>
std::vector<float> Recalled(Keep keep, Recall recall) {
  const View views[2] = {MakeOpenRoom({0.3, -0.4, 2}, 0.1), MakeOpenRoom({0.35, -0.3, 2.05}, 0.25)};
  TableVector<float> pixels;
  FilterPast past{nullptr, 0, {}, {0.05f, 0.1f, 0.05f}, nullptr, nullptr};
  std::vector<float> values;
  for (int frame = 0; frame < 2; ++frame) {
    const View& view = views[frame];
    Image<Rgb32f> light = Noise(view, 1, 0.3f, static_cast<uint64_t>(frame));
    Image<uint8_t> samples(view.width(), view.height());
    RngStream rng(static_cast<uint64_t>(frame), "holes");
    for (uint8_t& n : samples.pixels()) n = rng.Chance(0.7) ? 2 : 0;
    FilterBuffers buffers;
    buffers.Load(view.guides(), {&light, &samples, 4}, 4);
    const FilterPlanes& f = buffers.planes();
    past.stride = f.stride;
    pixels.resize(size_t{FilterPast::kFloats} * f.stride * f.height);
    past.pixels = pixels.data();
    for (int y = 0; y < f.height; ++y) frame == 0 ? keep(f, y, pixels.data()) : recall(f, y, past);
    const double* R = buffers.rays().field().R;
    for (int i = 0; i < 9; ++i) past.R[i] = static_cast<float>(R[i % 3 * 3 + i / 3]);
    if (frame == 0) continue;
    for (int y = 0; y < f.height; ++y) {
      for (int x = 0; x < f.width; ++x) {
        const int i = y * f.stride + x;
        if (f.id[i] == kNoSurface) continue;
        values.insert(values.end(), {f.light[0][0][i], f.samples[i], static_cast<float>(f.data_id[0][i])});
      }
    }
  }
  return values;
}

TEST(TemporalTest, InstructionSetsAgreeBitForBit) {
  const auto sse = Recalled(isa_sse42::KeepRow, isa_sse42::RecallRow);
  // Most points were seen before, and 0 or 2 samples are all there is of one frame.
  size_t mixed = 0;
  for (size_t i = 1; i < sse.size(); i += 3) mixed += sse[i] != 0 && sse[i] != 2;
  EXPECT_GT(mixed, sse.size() / 3 / 2);
  EXPECT_LT(mixed, sse.size() / 3);
  if (CurrentKernelIsa() >= KernelIsa::kAvx2) {
    EXPECT_TRUE(Recalled(isa_avx2::KeepRow, isa_avx2::RecallRow) == sse);
  }
  if (CurrentKernelIsa() >= KernelIsa::kAvx512) {
    EXPECT_TRUE(Recalled(isa_avx512::KeepRow, isa_avx512::RecallRow) == sse);
  }
}

TEST(TemporalTest, OneThreadAndManyGiveTheSameBytes) {
  const auto run = [](int threads) {
    const ThreadLimit limit(threads);
    Denoiser denoiser;
    Image<Rgb32f> light;
    for (int frame = 0; frame < 3; ++frame) {
      const View view = MakeOpenRoom({0.3, -0.4 + 0.1 * frame, 2}, 0.1 * frame);
      light = Noise(view, 1, 0.3f, static_cast<uint64_t>(frame));
      denoiser.Run(view.guides(), {&light, nullptr, 4}, true);
    }
    return light;
  };
  EXPECT_TRUE(run(1) == run(0));
}

// Two frames of a plane ahead, of a camera that is no panorama: the second moves and sees the mean of both.
TEST(TemporalTest, APinholeCameraThatMovesFindsItsPoints) {
  const Pinhole pinhole{130, 64, 100, 100, 65, 32};
  Denoiser denoiser;
  Image<Rgb32f> light;
  for (int frame = 0; frame < 2; ++frame) {
    View view{pinhole, CameraInBody(), Image<float>(130, 64), Image<uint32_t>(130, 64, 1), Image<Vec3f>(130, 64, {-1, 0, 0})};
    view.X_WC.p.y = 2.0 * frame;  // 20 pixels
    light = Image<Rgb32f>(130, 64);
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 130; ++x) {
        const Vec3d d = view.X_WC.R * *PixelToRay(pinhole, {x + 0.5, y + 0.5});
        view.range(x, y) = static_cast<float>(10 / d.x);
        // Lit to the right of y = 0 in the first frame, not at all in the second.
        const bool lit = frame == 0 && view.X_WC.p.y + d.y * 10 / d.x > 0;
        light(x, y) = lit ? Rgb32f{1, 1, 1} : Rgb32f{0, 0, 0};
      }
    }
    denoiser.Run(view.guides(), {&light, nullptr, 1}, true);
    if (frame == 0) continue;
    for (int y = 8; y < 56; ++y) {
      for (int x = 4; x < 126; ++x) {
        const double at = view.X_WC.p.y + (view.X_WC.R * *PixelToRay(pinhole, {x + 0.5, y + 0.5})).y * view.range(x, y);
        if (std::abs(at) < 0.5 || at < -6 || at > 6) continue;
        ASSERT_NEAR(light(x, y).g, at > 0 ? 0.5f : 0.0f, 1e-3f) << x << " " << y;
      }
    }
  }
}

}  // namespace
}  // namespace airsim360::internal
