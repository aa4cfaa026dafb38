#include "airsim360/eval/panorama_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

Image<Rgb8> Painted(double (*gray)(double x, double y)) {
  Image<Rgb8> picture(512, 256);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 512; ++x) {
      const auto v = static_cast<uint8_t>(255 * gray((x + 0.5) / 512, (y + 0.5) / 256));
      picture(x, y) = {v, v, v};
    }
  }
  return picture;
}

TEST(PanoramaStatistics, ABlankPictureIsFlatAndSaysNothing) {
  const PanoramaStatistics s = MeasurePanorama(Painted([](double, double) { return 0.5; }));
  EXPECT_DOUBLE_EQ(s.flat, 1);
  EXPECT_NEAR(s.gradient, 0, 1e-12);
  EXPECT_NEAR(s.entropy, 0, 1e-12);
}

TEST(PanoramaStatistics, WhiteNoiseHasALevelSpectrum) {
  // Sampled between pixels, noise loses part of its highest frequencies: a slope near 0, far from nature's 2.
  static std::mt19937 random(1);
  const PanoramaStatistics s = MeasurePanorama(Painted([](double, double) { return random() / 4294967296.0; }));
  EXPECT_NEAR(s.slope, 0.3, 0.4);
  EXPECT_DOUBLE_EQ(s.flat, 0);
  EXPECT_GT(s.entropy, 5.5);
}

TEST(PanoramaStatistics, SharpEdgesHaveASpectrumOfAboutTheThirdPower) {
  // Large dark discs on light ground: round shapes with sharp edges give 3.
  const PanoramaStatistics s = MeasurePanorama(Painted([](double x, double y) {
    const double u = x * 12 - std::floor(x * 12) - 0.5, v = y * 6 - std::floor(y * 6) - 0.5;
    return u * u + v * v < 0.1 ? 0.2 : 0.8;
  }));
  EXPECT_NEAR(s.slope, 3, 0.5);
  EXPECT_GT(s.flat, 0.3);
}

TEST(PanoramaStatistics, OnlyPanoramasAreMeasured) {
  EXPECT_THROW(MeasurePanorama(Image<Rgb8>(300, 200)), InputError);
  EXPECT_THROW(MeasurePanorama(Image<Rgb8>(64, 32)), InputError);
}

}  // namespace
}  // namespace airsim360
