#include "airsim360/render/sky/sun_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
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
  float Guess(bool wraps = true) { return internal::GuessSun({pixels.data(), kWidth, kHeight, wraps, x, y}, *rays, *surfaces, 0); }
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

TEST(SunPixels, LeavesTakeTheAnswerOfALeafAboutAsFarAway) {
  Ground crown;
  crown.surfaces->kind[0] = 1;
  crown.rays->width[0] = 0.02f;
  EXPECT_EQ(crown.Guess(), -1);  // no leaves around
  // Two of three see the sun, and so do two of three samples.
  for (int k = 0; k < 3; ++k) {
    SunPixel& leaf = crown.At(2 + k, 1);
    leaf.state = k < 2 ? SunPixel::kLitLeaf : SunPixel::kDarkLeaf;
    leaf.offset = 10.1f;
  }
  int lit = 0;
  for (uint32_t key = 0; key < 3; ++key) {
    crown.rays->key[0] = key << 8 | 1;
    lit += crown.Guess() == 1;
  }
  EXPECT_EQ(lit, 2);
  crown.At(2, 1).offset = 10.3f;  // too far behind
  EXPECT_EQ(crown.Guess(), -1);
}

TEST(SunPixels, LightIsPackedToOnePartIn512OfItsLargest) {
  for (const Vec3f light : {Vec3f{0, 0, 0}, Vec3f{1, 0.5f, 0.001f}, Vec3f{1e-4f, 3e-4f, 2e-4f}, Vec3f{511.9f, 3, 7}, Vec3f{60000, 1, 40000},
                            Vec3f{-1, 1e9f, 0}}) {
    const uint32_t packed = internal::PackLight(light);
    EXPECT_NE(packed, 0u);
    const Vec3f back = internal::UnpackLight(packed);
    const float most = std::min(65000.0f, std::max({light.x, light.y, light.z, 1e-4f}));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], std::clamp(light[k], 0.0f, 65000.0f), most / 500) << k;
  }
}

TEST(SunPixels, PanesTakeTheMeanOfWhatIsSeenInTheirPlane) {
  Ground pane;
  pane.surfaces->kind[0] = 2, pane.surfaces->mirror[0] = 1;
  const auto guess = [&] {
    internal::GuessReflections({pane.pixels.data(), kWidth, kHeight, true, pane.x, pane.y}, *pane.rays, *pane.surfaces);
  };
  pane.At(2, 1).reflected = internal::PackLight({1, 2, 4});
  pane.At(3, 1).reflected = internal::PackLight({3, 2, 1});
  guess();
  EXPECT_EQ(pane.surfaces->traced[0], 0);  // two are too few
  pane.At(4, 1).reflected = internal::PackLight({9, 9, 9});
  guess();
  EXPECT_EQ(pane.surfaces->traced[0], 0);  // one is much brighter
  pane.At(4, 1).reflected = internal::PackLight({2, 2, 2});
  guess();
  EXPECT_EQ(pane.surfaces->traced[0], 1);
  EXPECT_EQ(pane.surfaces->mirror[0], 0);
  EXPECT_NEAR(pane.surfaces->reflected_r[0], 2, 0.02);
  EXPECT_NEAR(pane.surfaces->reflected_b[0], 7.0 / 3, 0.02);
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
