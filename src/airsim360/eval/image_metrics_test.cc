#include "airsim360/eval/image_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

Image<Rgb8> Uniform(int width, int height, Rgb8 color) { return Image<Rgb8>(width, height, color); }

Image<Rgb8> Noise(int width, int height, int amplitude, uint64_t seed = 1) {
  Image<Rgb8> image(width, height);
  RngStream rng(seed, "image");
  for (Rgb8& c : image.pixels()) {
    const auto value = [&] { return static_cast<uint8_t>(128 + amplitude * rng.Uniform(-1, 1)); };
    c = {value(), value(), value()};
  }
  return image;
}

TEST(PsnrTest, IsInfiniteForEqualPicturesAndKnownForAShift) {
  const Image<Rgb8> image = Noise(64, 32, 100);
  EXPECT_EQ(Psnr(image, image), std::numeric_limits<double>::infinity());
  // All values off by 5: 20 log10(255 / 5).
  EXPECT_NEAR(Psnr(Uniform(64, 32, {10, 20, 30}), Uniform(64, 32, {15, 25, 25})), 20 * std::log10(51.0), 1e-12);
  // One channel of one pixel in 6.
  Image<Rgb8> one = Uniform(3, 2, {0, 0, 0});
  one(2, 1).g = 255;
  EXPECT_NEAR(Psnr(one, Uniform(3, 2, {0, 0, 0})), 10 * std::log10(18.0), 1e-12);
}

TEST(WsPsnrTest, WeighsRowsBySolidAngle) {
  // A row that differs, alone: its share of the weights is cos(latitude) / sum.
  const int h = 64;
  for (const int row : {0, 10, 31}) {
    const Image<Rgb8> a = Uniform(2 * h, h, {100, 100, 100});
    Image<Rgb8> b = a;
    for (Rgb8& c : b.row(row)) c = {110, 110, 110};
    // Closed form of sum over rows of cos((j + 1/2 - h / 2) pi / h) is 1 / sin(pi / (2 h)).
    const double share = std::cos((row + 0.5 - h / 2.0) * std::numbers::pi / h) * std::sin(std::numbers::pi / (2 * h));
    EXPECT_NEAR(WsPsnr(a, b), 10 * std::log10(255.0 * 255 / (100 * share)), 1e-9) << row;
  }
}

TEST(WsPsnrTest, EqualsPsnrWhereTheErrorIsTheSameEverywhere) {
  const Image<Rgb8> a = Uniform(64, 32, {1, 2, 3}), b = Uniform(64, 32, {3, 4, 1});
  EXPECT_NEAR(WsPsnr(a, b), Psnr(a, b), 1e-9);
}

TEST(SsimTest, IsOneForEqualPicturesAndKnownForUniformOnes) {
  const Image<Rgb8> image = Noise(40, 30, 100);
  EXPECT_NEAR(Ssim(image, image), 1, 1e-12);
  // Without contrast only the luminance term is left: (2 m n + C1) / (m^2 + n^2 + C1).
  const double c1 = 2.55 * 2.55;
  EXPECT_NEAR(Ssim(Uniform(20, 20, {100, 100, 100}), Uniform(20, 20, {150, 150, 150})), (2 * 100 * 150 + c1) / (100 * 100 + 150 * 150 + c1),
              1e-9);
}

TEST(SsimTest, ContrastTermIsThatOfTheFormula) {
  // b = 128 + (a - 128) / 2: covariance v / 2, variance v / 4, means equal where the window's mean is 128.
  Image<Rgb8> a(64, 64), b(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const int d = (x + y) % 2 ? 60 : -60;
      const auto grey = [](int v) { return Rgb8{static_cast<uint8_t>(v), static_cast<uint8_t>(v), static_cast<uint8_t>(v)}; };
      a(x, y) = grey(128 + d);
      b(x, y) = grey(128 + d / 2);
    }
  }
  // A checkerboard's windowed mean is off 128 by less than 1e-3 of its amplitude.
  const double v = 3600, c2 = 7.65 * 7.65;
  EXPECT_NEAR(Ssim(a, b), (2 * v / 2 + c2) / (v + v / 4 + c2), 1e-4);
}

TEST(SsimTest, NegatingTheContrastGivesAlmostMinusOne) {
  Image<Rgb8> a = Noise(40, 40, 100), b = a;
  for (Rgb8& c : b.pixels()) {
    c = {static_cast<uint8_t>(256 - c.r), static_cast<uint8_t>(256 - c.g), static_cast<uint8_t>(256 - c.b)};
  }
  EXPECT_LT(Ssim(a, b), -0.9);
}

TEST(FlipTest, EqualPicturesDoNotFlip) {
  const Image<Rgb8> image = Noise(48, 24, 100);
  EXPECT_EQ(MeanFlip(image, image), 0);
}

// Uniform pictures have no features and filtering leaves them: closed forms of the colour part.
TEST(FlipTest, UniformColoursDifferByTheRedistributedHyAbDistance) {
  // Black and white: HyAB is 100. Green and blue define the greatest distance: 41.2760 to the power 0.7
  // already taken.
  constexpr double kLargest = 41.2760, kBend = 0.4 * kLargest;
  const double e = std::pow(100, 0.7);
  const double expected = 0.95 + (e - kBend) / (kLargest - kBend) * 0.05;
  EXPECT_NEAR(MeanFlip(Uniform(32, 16, {0, 0, 0}), Uniform(32, 16, {255, 255, 255})), expected, 1e-4);
  EXPECT_NEAR(MeanFlip(Uniform(32, 16, {0, 255, 0}), Uniform(32, 16, {0, 0, 255})), 1, 1e-6);
  // Greys 119 and 120: L* from the sRGB curve by hand.
  const auto lightness = [](double s) { return 116 * std::cbrt(std::pow((s / 255 + 0.055) / 1.055, 2.4)) - 16; };
  const double near = 0.95 / kBend * std::pow(lightness(120) - lightness(119), 0.7);
  EXPECT_NEAR(MeanFlip(Uniform(32, 16, {119, 119, 119}), Uniform(32, 16, {120, 120, 120})), near, 1e-4);
}

TEST(FlipTest, IsSymmetricAndBounded) {
  const Image<Rgb8> a = Noise(64, 32, 120, 1), b = Noise(64, 32, 120, 2);
  const Image<float> ab = Flip(a, b), ba = Flip(b, a);
  for (size_t i = 0; i < ab.size(); ++i) {
    EXPECT_NEAR(ab.pixels()[i], ba.pixels()[i], 1e-6);
    EXPECT_GE(ab.pixels()[i], 0);
    EXPECT_LE(ab.pixels()[i], 1);
  }
}

TEST(FlipTest, FineDetailIsInvisibleFromAfarAndPlainFromNear) {
  // A checkerboard against the grey of the same light.
  Image<Rgb8> checker(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) checker(x, y) = (x + y) % 2 ? Rgb8{255, 255, 255} : Rgb8{0, 0, 0};
  }
  const Image<Rgb8> grey = Uniform(64, 64, {188, 188, 188});
  const auto seen = [&](double ppd) {
    // The colour part alone: its centre, away from held borders.
    return Flip(checker, grey, {ppd, true})(32, 32);
  };
  EXPECT_LT(seen(300), 0.05f);
  EXPECT_GT(seen(10), 0.8f);
}

TEST(FlipTest, AnEdgeThatIsMissingCountsMoreThanItsColourAlone) {
  // The same small difference of colour as a patch with an edge, and everywhere.
  const Rgb8 dark{100, 100, 100}, light{112, 112, 112};
  Image<Rgb8> patch = Uniform(64, 64, dark);
  for (int y = 0; y < 64; ++y) {
    for (int x = 32; x < 64; ++x) patch(x, y) = light;
  }
  const Image<float> map = Flip(Uniform(64, 64, dark), patch);
  const double plain = MeanFlip(Uniform(64, 64, dark), Uniform(64, 64, light));
  EXPECT_NEAR(map(62, 32), plain, 0.02);
  // Colour alone: half a pixel from the edge of a Gaussian of 1.03 pixels, 0.69 of the difference.
  EXPECT_GT(map(32, 32), 1.2 * plain * std::pow(0.69, 0.7));
  EXPECT_LT(map(4, 32), 0.01);
}

TEST(FlipTest, WrappingColumnsMakesTheSeamLikeAnyOtherPlace) {
  const Image<Rgb8> a = Noise(64, 32, 100, 1), b = Noise(64, 32, 100, 2);
  const int k = 23;
  Image<Rgb8> a_rolled(64, 32), b_rolled(64, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) a_rolled(x, y) = a((x + k) % 64, y), b_rolled(x, y) = b((x + k) % 64, y);
  }
  const FlipOptions options{.wrap_columns = true};
  const Image<float> map = Flip(a, b, options), rolled = Flip(a_rolled, b_rolled, options);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) EXPECT_FLOAT_EQ(rolled(x, y), map((x + k) % 64, y));
  }
}

TEST(MetricsTest, PicturesThatCannotBeComparedAreRefused) {
  EXPECT_THROW(Psnr(Uniform(4, 4, {}), Uniform(4, 5, {})), InputError);
  EXPECT_THROW(WsPsnr({}, {}), InputError);
  EXPECT_THROW(Ssim(Uniform(10, 40, {}), Uniform(10, 40, {})), InputError);
  EXPECT_THROW(Flip(Uniform(4, 4, {}), Uniform(4, 4, {}), {0, false}), InputError);
}

}  // namespace
}  // namespace airsim360
