#include "airsim360/eval/sphere/pixel_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

double Sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(PixelWeights, SolidAnglesSumToTheSphere) {
  for (const int height : {1, 2, 7, 64}) {
    EXPECT_NEAR(Sum(RowWeights(height, 2 * height, PixelWeight::kSolidAngle)) * 2 * height, 4 * kPi, 1e-12);
    EXPECT_NEAR(Sum(WholeView(2 * height, height, PixelWeight::kSolidAngle).weights), 4 * kPi, 1e-12);
  }
  EXPECT_THROW(WholeView(30, 20, PixelWeight::kSolidAngle), InputError);
  EXPECT_THROW(ParsePixelWeight("solid"), InputError);
}

TEST(Views, BandsAndSeamDivideThePicture) {
  for (const int bands : {1, 3, 5, 13}) {
    std::vector<int> seen(26 * 13, 0);
    for (int band = 0; band < bands; ++band) {
      for (const uint32_t i : BandView(26, 13, band, bands, PixelWeight::kPixel).source) ++seen[i];
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 26 * 13) << bands;
  }
  const auto near = SeamView(26, 13, 4, true, PixelWeight::kSolidAngle), far = SeamView(26, 13, 4, false, PixelWeight::kSolidAngle);
  EXPECT_EQ(near.source.size(), 8u * 13);
  EXPECT_EQ(near.source.size() + far.source.size(), 26u * 13);
  EXPECT_NEAR(Sum(near.weights) + Sum(far.weights), 4 * kPi, 1e-12);
  EXPECT_THROW(SeamView(26, 13, 13, true, PixelWeight::kPixel), InputError);
}

TEST(Views, CubeFacesSeeEveryDirectionOnce) {
  // Each face's centre is where its axis is; shares of rows follow the solid angle of a cube's pixels, integrated over longitude.
  const int width = 256, height = 128;
  const PixelView cube = CubeView(width, height);
  EXPECT_EQ(cube.source.size(), 6u * 64 * 64);
  // Above 45 degrees of latitude lies the part of the upper face within the circle of tan(45) = 1: pi / 4 of it; nothing of the side faces' …
  double high = 0;
  for (const uint32_t i : cube.source) high += i / width < static_cast<uint32_t>(height) / 4;
  // … but their upper corners bend over it: none, since tan(lat) <= cos(azimuth from the axis) <= 1 there.
  EXPECT_NEAR(high / (64 * 64), kPi / 4, 0.02);
}

TEST(Views, TangentPicturesAreNearlyUniformOnTheSphere) {
  const int width = 128, height = 64;
  const PixelView tangent = TangentView(width, height);
  // Pixels of a tangent plane weigh 1 / cos³ more at its rim than in its middle: the whole holds 4 pi times between 1 and 1.4.
  const double pixels = static_cast<double>(tangent.source.size()) * (2 * kPi / width) * (2 * kPi / width);
  EXPECT_GT(pixels, 4 * kPi);
  EXPECT_LT(pixels, 1.4 * 4 * kPi);
  // Symmetric: as many above the horizon as below.
  double above = 0;
  for (const uint32_t i : tangent.source) above += i / width < static_cast<uint32_t>(height) / 2;
  EXPECT_NEAR(above / static_cast<double>(tangent.source.size()), 0.5, 0.005);
}

TEST(Views, RollingBackUndoesARoll) {
  const std::vector<int> picture = {0, 1, 2, 3, 10, 11, 12, 13}, rolled = {3, 0, 1, 2, 13, 10, 11, 12};
  EXPECT_EQ(RollBack<int>(rolled, 4, 1), picture);
  EXPECT_EQ(RollBack<int>(rolled, 4, -3), picture);
  EXPECT_EQ(RollBack<int>(rolled, 4, 5), picture);
}

TEST(Views, TurningBackUndoesATurn) {
  const int width = 64, height = 32;
  std::vector<int> picture(static_cast<size_t>(width) * height);
  std::iota(picture.begin(), picture.end(), 0);
  EXPECT_EQ(Take<int>(picture, TurnedView(width, height, 0, 0, 0)), picture);
  // A camera that turned 8 columns to the right sees everything 8 columns farther left.
  EXPECT_EQ(Take<int>(picture, TurnedView(width, height, 8 * 2 * kPi / width, 0, 0)), RollBack<int>(picture, width, -8));
  // Nose up by 90 degrees: what was ahead is at the lower end, what was above is ahead. Right side down: the right is above the middle.
  const auto pitched = TurnedView(width, height, 0, kPi / 2, 0).source, rolled = TurnedView(width, height, 0, 0, kPi / 2).source;
  EXPECT_GE(pitched[static_cast<size_t>(16 * width + 32)] / width, 31u);
  EXPECT_NEAR(pitched[32] / width, 16, 1);
  EXPECT_LE(rolled[static_cast<size_t>(16 * width + 48)] / width, 1u);
  EXPECT_THROW(TurnedView(30, 20, 0, 0, 0), InputError);
}

TEST(Views, ResizingTakesTheNearestPixel) {
  const PixelView half = ResizedView(4, 2, 2, 1), twice = ResizedView(2, 1, 4, 2);
  EXPECT_EQ(half.source, (std::vector<uint32_t>{5, 7}));
  EXPECT_EQ(twice.source, (std::vector<uint32_t>{0, 0, 1, 1, 0, 0, 1, 1}));
}

}  // namespace
}  // namespace airsim360
