#include "airsim360/render/filter/denoiser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/render/filter/filter_buffers.h"
#include "airsim360/render/filter/filter_kernels.h"
#include "airsim360/render/filter/test_view.h"

namespace airsim360::internal {
namespace {

using test::Truth;

TEST(DenoiserTest, ConstantLightIsReturnedBitForBit) {
  const View view = MakeRoomView(256);
  const Image<Rgb32f> light(view.width(), view.height(), {0.3f, 0.7f, 1.1f});
  EXPECT_TRUE(Filter(view, light) == light);
}

TEST(DenoiserTest, NoiseOnSurfacesFallsByAFactorOfAHundredInVariance) {
  const View view = MakeBall(512);
  const double before = 0.04;
  const Image<Rgb32f> light = Filter(view, Noise(view, 1, 0.2f));
  EXPECT_LT(Variance(view, light, 1, Anywhere), before / 100);
}

TEST(DenoiserTest, ALargerRadiusLeavesLess) {
  const View view = MakeBall(512);
  const Image<Rgb32f> noise = Noise(view, 1, 0.2f);
  double last = 0.04;
  for (const float radius : {1.0f, 2.0f, 4.0f, 8.0f}) {
    const double left = Variance(view, Filter(view, noise, nullptr, radius), 1, Anywhere);
    EXPECT_LT(left, 0.5 * last) << radius;
    last = left;
  }
}

TEST(DenoiserTest, TheMeanStays) {
  const View view = MakeBall(256);
  const Image<Rgb32f> light = Filter(view, Noise(view, 1, 0.2f));
  double sum = 0;
  for (const Rgb32f& c : light.pixels()) sum += c.g;
  EXPECT_NEAR(sum / static_cast<double>(light.size()), 1, 0.2 * 3 / std::sqrt(view.width() * view.height()));
}

TEST(DenoiserTest, TheMeanOfOcclusionByFourRaysStays) {
  const View view = MakeBall(256);
  Image<Rgb32f> light(view.width(), view.height());
  const Image<uint8_t> samples(view.width(), view.height(), 4);
  RngStream rng(8, "rays");
  for (Rgb32f& c : light.pixels()) {
    int open = 0;
    for (int ray = 0; ray < 4; ++ray) open += rng.Chance(0.7);
    c.r = c.g = c.b = 0.25f * static_cast<float>(open);
  }
  const Image<Rgb32f> filtered = Filter(view, light, &samples);
  double sum = 0, weight = 0;
  Variance(view, filtered, 0, [&](int x, int y) {
    const double w = std::cos(std::numbers::pi * (0.5 - (y + 0.5) / view.height()));
    sum += w * filtered(x, y).g;
    weight += w;
    return true;
  });
  EXPECT_NEAR(sum / weight, 0.7, 0.014);
  EXPECT_LT(Variance(view, filtered, 0.7f, Anywhere), 0.7 * 0.3 / 4 / 60);
}

TEST(DenoiserTest, LightOfOneEntityNeverReachesAnother) {
  const View view = MakeRoomView(512);
  Image<Rgb32f> light = Noise(view, 1, 0.3f);
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) {
      if (view.entity(x, y) % 2 == 0) light(x, y) = {0.25f, 0.5f, 0.125f};
    }
  }
  const Image<Rgb32f> filtered = Filter(view, light);
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) {
      if (view.entity(x, y) % 2 == 0) {
        ASSERT_EQ(filtered(x, y), (Rgb32f{0.25f, 0.5f, 0.125f}));
      }
    }
  }
}

TEST(DenoiserTest, TwoParallelWallsOfOneEntityDoNotMix) {
  // A wall at x = 5 and, above z = 2, one half a metre nearer; light differs only there.
  const View view = MakeView(512, {0, 0, 2}, [](Vec3d o, Vec3d d) {
    if (d.x <= 0.05) return Truth{};
    const double near = 4.5 / d.x, far = 5 / d.x;
    return o.z + d.z * near > 2 ? Truth{near, 1, {-1, 0, 0}} : Truth{far, 1, {-1, 0, 0}};
  });
  Image<Rgb32f> light = Noise(view, 1, 0.4f);
  for (int y = 0; y < view.height() / 2; ++y) {
    for (Rgb32f& c : light.row(y)) c = {0.5f, 0.5f, 0.5f};
  }
  const Image<Rgb32f> filtered = Filter(view, light);
  for (int x = 200; x < 312; ++x) {
    for (int y = 96; y < 128; ++y) ASSERT_EQ(filtered(x, y), (Rgb32f{0.5f, 0.5f, 0.5f})) << x << " " << y;
  }
}

TEST(DenoiserTest, AShadowEdgeOnOneSurfaceStaysWithinTwoPixels) {
  // Lit to 1 left of the image centre and to 0.2 right of it, noise of a tenth.
  const View view = MakeBall(512);
  Image<Rgb32f> light = Noise(view, 0, 0.08f);
  const auto lit = [&](int x) { return x < view.width() / 2 ? 1.0f : 0.2f; };
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) light(x, y).r = light(x, y).g = light(x, y).b += lit(x);
  }
  const Image<Rgb32f> filtered = Filter(view, light);
  double worst = 0, sum = 0;
  int count = 0;
  for (int y = 64; y < 192; ++y) {
    for (int x = 0; x < view.width(); ++x) {
      const int off = std::min(std::abs(2 * x + 1 - view.width()), 2 * std::min(x, view.width() - 1 - x) + 1);
      if (off < 4) continue;
      const double error = std::abs(filtered(x, y).g - lit(x));
      worst = std::max(worst, error);
      sum += error;
      ++count;
    }
  }
  EXPECT_LT(worst, 0.2);
  EXPECT_LT(sum / count, 0.02);
}

TEST(DenoiserTest, WithoutNoiseAShadowEdgeStaysWhereItIs) {
  const View view = MakeBall(256);
  Image<Rgb32f> light(view.width(), view.height(), {1, 1, 1});
  const Image<uint8_t> samples(view.width(), view.height(), 16);
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 40; x < 140; ++x) light(x, y) = {0.5f, 0.5f, 0.5f};
  }
  const Image<Rgb32f> filtered = Filter(view, light, &samples);
  // Beyond 48 degrees pixels that are narrower than high are averaged first. What is left is a five-hundredth of the step.
  const int h = view.height();
  for (int y = h / 4 + 1; y < h - h / 4 - 1; ++y) {
    for (int x = 0; x < view.width(); ++x) ASSERT_NEAR(filtered(x, y).g, light(x, y).g, 1e-3f) << x << " " << y;
  }
}

TEST(DenoiserTest, PolesAndSeamKeepNoMoreNoiseThanTheEquator) {
  // One sample for a pixel's solid angle at the equator: most pixels near the poles have none.
  const View view = MakeBall(512);
  const int w = view.width(), h = view.height();
  Image<uint8_t> samples(w, h);
  RngStream rng(3, "samples");
  for (int y = 0; y < h; ++y) {
    const double share = std::cos(std::numbers::pi * (0.5 - (y + 0.5) / h));
    for (int x = 0; x < w; ++x) samples(x, y) = rng.Chance(share);
  }
  Image<Rgb32f> light = Noise(view, 1, 0.2f);
  for (size_t i = 0; i < light.size(); ++i) {
    if (samples.pixels()[i] == 0) light.pixels()[i] = {};
  }
  light = Filter(view, light, &samples);
  const double equator = Variance(view, light, 1, [&](int, int y) { return std::abs(2 * y - h) < h / 2; });
  const double poles = Variance(view, light, 1, [&](int, int y) { return y < h / 16 || y >= h - h / 16; });
  const double seam = Variance(view, light, 1, [&](int x, int y) { return (x < 8 || x >= w - 8) && std::abs(2 * y - h) < h / 2; });
  // Near the poles samples are where chance put them, some pixels have several: a third less good.
  EXPECT_LT(poles, 1.6 * equator);
  EXPECT_LT(seam, 1.3 * equator);
  EXPECT_LT(equator, 0.04 / 60);
}

// Taps n columns apart must not leave n combs that never meet.
TEST(DenoiserTest, ColumnsBetweenTapsMixInEveryRow) {
  constexpr int kWidth = 480;  // a whole number of all periods
  const View view = MakeBall(kWidth);
  const auto period = [&](int y) {
    const double across = 1 / std::cos(std::numbers::pi * (0.5 - (y + 0.5) / view.height()));
    return std::max(2, static_cast<int>(std::lround(across)));
  };
  const auto wave = [&](int x, int y) { return std::cos(2 * std::numbers::pi * x / period(y)); };
  Image<Rgb32f> light(kWidth, view.height());
  for (int y = 0; y < light.height(); ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float v = 1 + 0.2f * static_cast<float>(wave(x, y));
      light(x, y) = {v, v, v};
    }
  }
  light = Filter(view, light);
  for (int y = 0; y < light.height(); ++y) {
    if (period(y) > 6) continue;
    double left = 0;
    for (int x = 0; x < kWidth; ++x) left += light(x, y).g * wave(x, y) / kWidth;
    EXPECT_LT(std::abs(left), 0.01) << "row " << y;
  }
}

TEST(DenoiserTest, TurningTheCameraByColumnsRollsTheResultByteForByte) {
  const View view = MakeRoomView(256);
  const Image<Rgb32f> noise = Noise(view, 1, 0.3f);
  const Image<Rgb32f> filtered = Filter(view, noise);
  for (const int k : {1, 77, 128}) {
    View turned = view;
    turned.X_WC.R = view.X_WC.R * RotationY(2 * std::numbers::pi * k / view.width());
    Image<Rgb32f> light(noise.width(), noise.height()), expected = light;
    for (int y = 0; y < view.height(); ++y) {
      for (int x = 0; x < view.width(); ++x) {
        const int from = (x + k) % view.width();
        turned.range(x, y) = view.range(from, y);
        turned.entity(x, y) = view.entity(from, y);
        turned.normal(x, y) = view.normal(from, y);
        light(x, y) = noise(from, y);
        expected(x, y) = filtered(from, y);
      }
    }
    EXPECT_TRUE(Filter(turned, light) == expected) << k;
  }
}

TEST(DenoiserTest, OneThreadAndManyGiveTheSameBytes) {
  const View view = MakeRoomView(256);
  const Image<Rgb32f> noise = Noise(view, 1, 0.3f), many = Filter(view, noise);
  const ThreadLimit one(1);
  EXPECT_TRUE(Filter(view, noise) == many);
}

TEST(DenoiserTest, InstructionSetsAgreeBitForBit) {
  const View view = MakeRoomView(96);
  Image<Rgb32f> noise = Noise(view, 1, 0.3f);
  Image<uint8_t> samples(view.width(), view.height(), 2);
  RngStream rng(5, "holes");
  for (uint8_t& n : samples.pixels()) n = rng.Chance(0.7) ? 2 : 0;
  const auto run = [&](auto gather, auto window, auto variance, auto atrous) {
    FilterBuffers buffers;
    buffers.Load(view.guides(), {&noise, &samples, 4}, 4);
    const FilterPlanes& f = buffers.planes();
    std::vector<float> values;
    for (int y = 0; y < f.height; ++y) {
      gather(f, y, buffers.PixelsAcross(y));
      buffers.RepeatLight(y, 0);
      buffers.RepeatSamples(y);
    }
    for (int y = 0; y < f.height; ++y) window(f, y, buffers.StepX(y, 1)), buffers.RepeatStatistics(y);
    for (int y = 0; y < f.height; ++y) variance(f, y, buffers.StepX(y, 3));
    for (int y = 0; y < f.height; ++y) atrous(f, y, 2, buffers.StepX(y, 2), 0);
    Image<Rgb32f> out(view.width(), view.height());
    buffers.Store(1, out);
    for (const Rgb32f& c : out.pixels()) values.insert(values.end(), {c.r, c.g, c.b});
    for (int y = 0; y < f.height; ++y) values.insert(values.end(), f.variance + y * f.stride, f.variance + y * f.stride + f.width);
    return values;
  };
  const auto sse = run(isa_sse42::GatherRow, isa_sse42::WindowRow, isa_sse42::VarianceRow, isa_sse42::AtrousRow);
  if (CurrentKernelIsa() >= KernelIsa::kAvx2) {
    EXPECT_TRUE(run(isa_avx2::GatherRow, isa_avx2::WindowRow, isa_avx2::VarianceRow, isa_avx2::AtrousRow) == sse);
  }
  if (CurrentKernelIsa() >= KernelIsa::kAvx512) {
    EXPECT_TRUE(run(isa_avx512::GatherRow, isa_avx512::WindowRow, isa_avx512::VarianceRow, isa_avx512::AtrousRow) == sse);
  }
}

TEST(DenoiserTest, InstructionSetsLoadTheSamePlanes) {
  const View view = MakeRoomView(96);
  Image<Rgb32f> noise = Noise(view, 1, 0.3f);
  const auto run = [&](auto load) {
    FilterBuffers buffers;
    buffers.Load(view.guides(), {&noise, nullptr, 4}, 4);
    const FilterPlanes& f = buffers.planes();
    const RayField& field = buffers.rays().field();
    std::vector<float> values;
    for (int y = 0; y < f.height; ++y) {
      const int64_t row = int64_t{y} * f.stride;
      for (float* plane : {f.p[0], f.p[1], f.p[2], f.g[2], f.light[0][1]}) std::fill_n(plane + row, f.width, 0.0f);
      const FilterSource source{view.range.row(y).data(),
                                view.entity.row(y).data(),
                                &view.normal.row(y).data()->x,
                                &view.normal.row(y).data()->x,
                                &noise.row(y).data()->r,
                                nullptr,
                                17,
                                field.column_x,
                                field.column_y,
                                field.column_z,
                                field.row_scale[y],
                                field.row_x[y],
                                field.row_y[y],
                                field.row_z[y]};
      load(f, y, source);
      for (const float* plane : {f.p[0], f.p[1], f.p[2], f.g[2], f.light[0][1]})
        values.insert(values.end(), plane + row, plane + row + f.width);
      for (int x = 0; x < f.width; ++x) {
        // Canonical column x is image column x - 17.
        const int from = (x - 17 + f.width) % f.width;
        EXPECT_EQ(f.light[0][1][row + x], noise(from, y).g);
        EXPECT_EQ(f.id[row + x], view.entity(from, y));
      }
    }
    return values;
  };
  const auto sse = run(isa_sse42::LoadFilterRow);
  if (CurrentKernelIsa() >= KernelIsa::kAvx2) {
    EXPECT_TRUE(run(isa_avx2::LoadFilterRow) == sse);
  }
  if (CurrentKernelIsa() >= KernelIsa::kAvx512) {
    EXPECT_TRUE(run(isa_avx512::LoadFilterRow) == sse);
  }
}

TEST(DenoiserTest, PixelsWithoutSamplesTakeTheLightOfTheirSurface) {
  const View view = MakeRoomView(256);
  Image<uint8_t> samples(view.width(), view.height(), 0);
  Image<Rgb32f> light(view.width(), view.height());
  RngStream rng(4, "holes");
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) {
      if (!rng.Chance(0.1)) continue;
      samples(x, y) = 1;
      light(x, y).g = static_cast<float>(view.entity(x, y));
    }
  }
  light = Filter(view, light, &samples);
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) ASSERT_NEAR(light(x, y).g, view.entity(x, y), 1e-5 * view.entity(x, y)) << x << " " << y;
  }
}

TEST(DenoiserTest, AnEntityWithoutAnySampleTakesWhatIsAround) {
  const View view = MakeRoomView(256);
  Image<uint8_t> samples(view.width(), view.height(), 1);
  Image<Rgb32f> light(view.width(), view.height(), {2, 2, 2});
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) {
      if (view.entity(x, y) == 8) samples(x, y) = 0, light(x, y) = {};
    }
  }
  light = Filter(view, light, &samples);
  for (const Rgb32f& c : light.pixels()) ASSERT_EQ(c.g, 2);
}

TEST(DenoiserTest, LeavesShareLightWithLeavesAround) {
  // One tree of leaves at random angles and depths.
  View view = MakeBall(256);
  RngStream rng(6, "leaves");
  for (size_t i = 0; i < view.range.size(); ++i) {
    view.range.pixels()[i] = static_cast<float>(rng.Uniform(9.8, 10.2));
    const Vec3d toward = VecCast<double>(view.normal.pixels()[i]);
    const Vec3d side{rng.Uniform(-1, 1), rng.Uniform(-1, 1), rng.Uniform(-1, 1)};
    view.normal.pixels()[i] = VecCast<float>(Normalized(toward + side));
  }
  const Image<Rgb32f> light = Filter(view, Noise(view, 1, 0.2f));
  EXPECT_LT(Variance(view, light, 1, Anywhere), 0.04 / 20);
}

TEST(DenoiserTest, AFireflyGoesAndLeavesNothingAround) {
  const View view = MakeBall(512);
  Image<Rgb32f> light = Noise(view, 1, 0.1f);
  light(100, 128) = {80, 80, 80};
  light = Filter(view, light);
  EXPECT_LT(light(100, 128).g, 1.5);
  EXPECT_LT(light(101, 128).g, 1.1);
  EXPECT_LT(light(104, 124).g, 1.1);
}

TEST(DenoiserTest, TwoFirefliesThatTouchDoNotVouchForEachOther) {
  const View view = MakeBall(512);
  Image<Rgb32f> light = Noise(view, 1, 0.1f);
  light(100, 128) = light(101, 129) = {8, 8, 8};
  const Image<uint8_t> samples(view.width(), view.height(), 4);
  light = Filter(view, light, &samples);
  EXPECT_LT(light(100, 128).g, 1.5);
  EXPECT_LT(light(101, 129).g, 1.5);
}

// One pixel in twelve met a lamp: neither it nor the rest around it stays.
TEST(DenoiserTest, RareLightIsSpread) {
  const View view = MakeBall(512);
  Image<Rgb32f> light(view.width(), view.height(), {0.2f, 0.2f, 0.2f});
  RngStream random(7, "lamps");
  for (Rgb32f& c : light.pixels()) {
    if (random.Chance(1.0 / 12)) c = {4, 4, 4};
  }
  const Image<uint8_t> samples(view.width(), view.height(), 4);
  const Image<Rgb32f> filtered = Filter(view, light, &samples);
  int specks = 0, count = 0;
  for (int y = 80; y < 176; ++y) {
    for (int x = 0; x < view.width(); ++x) specks += filtered(x, y).g > 1.5f, ++count;
  }
  EXPECT_LT(specks, count / 60);
}

TEST(DenoiserTest, SkyIsLeftAlone) {
  const View view = MakeView(128, {0, 0, 2}, [](Vec3d o, Vec3d d) {
    return d.z < -0.01 ? Truth{-o.z / d.z, 1, {0, 0, 1}} : Truth{1e30, 2, {}};
  });
  const Image<Rgb32f> noise = Noise(view, 1, 0.3f), light = Filter(view, noise);
  for (int y = 0; y < view.height() / 2; ++y) {
    for (int x = 0; x < view.width(); ++x) ASSERT_EQ(light(x, y), noise(x, y));
  }
}

TEST(DenoiserTest, APinholePictureDoesNotWrap) {
  // A plane ahead, dark in the left half of the picture's first columns.
  const Pinhole pinhole{128, 64, 100, 100, 64, 32};
  View view{pinhole, CameraInBody(), Image<float>(128, 64), Image<uint32_t>(128, 64, 1), Image<Vec3f>(128, 64, {-1, 0, 0})};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const Vec3d d = view.X_WC.R * *PixelToRay(pinhole, {x + 0.5, y + 0.5});
      view.range(x, y) = static_cast<float>(10 / d.x);
    }
  }
  Image<uint8_t> samples(128, 64, 0);
  Image<Rgb32f> light(128, 64);
  for (int y = 0; y < 64; ++y) {
    samples(64, y) = 1;
    samples(127, y) = 1;
    light(64, y) = {1, 1, 1};
    light(127, y) = {9, 9, 9};
  }
  light = Filter(view, light, &samples);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 40; ++x) ASSERT_LT(light(x, y).g, 1.001) << x << " " << y;
  }
}

TEST(DenoiserTest, ImagesOfAnotherSizeAreRefused) {
  const View view = MakeBall(64);
  Image<Rgb32f> light(64, 31);
  EXPECT_THROW(Denoiser().Run(view.guides(), {&light, nullptr, 16}, false), InputError);
  EXPECT_THROW(Denoiser().Run({}, {&light, nullptr, 16}, false), InputError);
}

}  // namespace
}  // namespace airsim360::internal
