#include "airsim360/render/shading/sun_pixels.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace airsim360 {
namespace {

constexpr int kWidth = 8, kHeight = 4;

// Level ground 2 m under the camera at every pixel, lit; a sample on it that belongs to one pixel.
struct Ground {
  std::unique_ptr<internal::RaySet> rays = std::make_unique<internal::RaySet>();
  std::unique_ptr<internal::SurfaceSet> surfaces = std::make_unique<internal::SurfaceSet>();
  std::vector<SunPixel> pixels{static_cast<size_t>(kWidth * kHeight), Pixel(1, 1)};
  int x[1] = {3}, y[1] = {2};

  Ground() { Place(-2); }
  void Place(float z) {
    rays->count = 1;
    rays->distance[0] = 10;
    surfaces->gz[0] = 1;
    surfaces->px[0] = 5, surfaces->py[0] = 8, surfaces->pz[0] = z;
  }
  // What KeepSun makes of the ground where `sunlit`.
  static SunPixel Pixel(bool asked, float sunlit) {
    const auto rays = std::make_unique<internal::RaySet>();
    const auto surfaces = std::make_unique<internal::SurfaceSet>();
    rays->count = 1;
    surfaces->gz[0] = 1, surfaces->px[0] = 4, surfaces->pz[0] = -2, surfaces->sunlit[0] = sunlit;
    SunPixel out{};
    internal::KeepSun(*rays, *surfaces, &asked, &out);
    return out;
  }
  SunPixel& At(int column, int row) { return pixels[static_cast<size_t>(row * kWidth + column)]; }
  float Guess(bool wraps = true) {
    return internal::GuessSun({pixels.data(), kWidth, kHeight, wraps, x, y}, *rays, *surfaces, 0);
  }
};

TEST(SunPixels, AgreeingNeighboursOnThePlaneTell) {
  Ground ground;
  EXPECT_EQ(ground.Guess(), 1);
  for (SunPixel& pixel : ground.pixels) pixel = Ground::Pixel(true, 0);
  EXPECT_EQ(ground.Guess(), 0);
}

TEST(SunPixels, OneThatDisagreesOrIsNotSureLeavesItOpen) {
  for (const SunPixel& other : {Ground::Pixel(true, 0), Ground::Pixel(true, 0.8f), Ground::Pixel(false, 0)}) {
    Ground ground;
    ground.At(4, 3) = other;
    EXPECT_EQ(ground.Guess(), -1);
    ground.At(4, 3) = ground.At(0, 0);
    ground.At(5, 3) = other;  // two columns away
    EXPECT_EQ(ground.Guess(), 1);
  }
}

TEST(SunPixels, OtherPlanesDoNotCount) {
  Ground above;
  above.Place(-1.9f);
  EXPECT_EQ(above.Guess(), -1);
  Ground turned;
  turned.surfaces->gz[0] = 0, turned.surfaces->gx[0] = 1;
  EXPECT_EQ(turned.Guess(), -1);
}

TEST(SunPixels, ColumnsWrapOnlyOnTheSphere) {
  Ground ground;
  ground.x[0] = 0, ground.y[0] = 0;
  for (int row = 0; row < 2; ++row) ground.At(kWidth - 1, row) = Ground::Pixel(true, 0);
  EXPECT_EQ(ground.Guess(true), -1);
  EXPECT_EQ(ground.Guess(false), 1);
}

}  // namespace
}  // namespace airsim360
