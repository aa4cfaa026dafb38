#include "airsim360/dataset/record/segments.h"

#include <gtest/gtest.h>

#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

std::vector<uint64_t> Columns(std::initializer_list<std::pair<int, int>> runs, int width) {
  std::vector<uint64_t> bits((width + 63) / 64);
  for (const auto& [begin, end] : runs) {
    for (int c = begin; c < end; ++c) bits[c >> 6] |= uint64_t{1} << (c & 63);
  }
  return bits;
}

using Interval = std::pair<int, int>;

TEST(ShortestColumnRun, ClosedCases) {
  EXPECT_EQ(ShortestColumnRun(Columns({{10, 20}}, 100).data(), 100), (Interval{10, 10}));
  EXPECT_EQ(ShortestColumnRun(Columns({{0, 5}, {95, 100}}, 100).data(), 100), (Interval{95, 10}));  // across the seam
  EXPECT_EQ(ShortestColumnRun(Columns({{0, 10}, {40, 50}}, 64).data(), 64), (Interval{40, 34}));    // gaps of 30 and 14
  EXPECT_EQ(ShortestColumnRun(Columns({{0, 11}, {50, 61}}, 64).data(), 64), (Interval{50, 25}));    // gaps of 39 and 3
  EXPECT_EQ(ShortestColumnRun(Columns({{0, 128}}, 128).data(), 128), (Interval{0, 128}));           // everywhere
  EXPECT_EQ(ShortestColumnRun(Columns({{63, 64}}, 128).data(), 128), (Interval{63, 1}));
  EXPECT_EQ(ShortestColumnRun(Columns({{0, 1}, {50, 51}}, 100).data(), 100), (Interval{0, 51}));  // equal gaps: leftmost
}

TEST(ShortestColumnRun, IsTheShortestOfAllStartsForRandomColumns) {
  constexpr int kWidth = 70;
  RngStream random(1, "columns");
  for (int round = 0; round < 200; ++round) {
    std::vector<uint64_t> bits(2);
    std::vector<bool> set(kWidth);
    const int n = 1 + static_cast<int>(random.Index(12));
    for (int i = 0; i < n; ++i) {
      const int c = static_cast<int>(random.Index(kWidth));
      set[c] = true;
      bits[c >> 6] |= uint64_t{1} << (c & 63);
    }
    // Second method: try every start.
    int best = kWidth;
    for (int start = 0; start < kWidth; ++start) {
      int length = 0;
      for (int k = 0; k < kWidth; ++k) {
        if (set[(start + k) % kWidth]) length = k + 1;
      }
      best = std::min(best, length);
    }
    const auto [start, length] = ShortestColumnRun(bits.data(), kWidth);
    EXPECT_EQ(length, best);
    EXPECT_TRUE(set[start]);
    EXPECT_TRUE(set[(start + length - 1) % kWidth]);
  }
}

std::shared_ptr<const Scene> ThreeEntities() {
  SceneBuilder builder("three");
  builder.AddSky();
  builder.AddEntity("tower", builder.tree().At("construction/tower"));
  builder.AddEntity("road", builder.tree().At("ground/road"));
  return builder.Build();
}

TEST(FindSegments, BoxesAreasAndSolidAnglesOfADrawnPicture) {
  // Sky above, road below, a tower across the seam in columns 14, 15, 0.
  const auto scene = ThreeEntities();
  Image<EntityId> entity(16, 8, 1);
  for (int y = 4; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) entity(x, y) = 3;
  }
  for (int y = 2; y < 6; ++y) {
    for (int x : {14, 15, 0}) entity(x, y) = 2;
  }
  Image<CategoryId> semantic(16, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) semantic(x, y) = scene->entity(entity(x, y)).category;
  }
  const auto segments = FindSegments(entity, semantic, *scene, PixelSolidAngles(Equirectangular{16, 8}), {.wraps = true});
  ASSERT_EQ(segments.size(), 3u);
  EXPECT_EQ(segments[1].area, 12);
  EXPECT_EQ(segments[1].box, (PixelBox{0, 2, 16, 4}));
  EXPECT_EQ(segments[1].box_wrap, (PixelBox{14, 2, 3, 4}));
  EXPECT_EQ(segments[0].box, (PixelBox{0, 0, 16, 4}));
  EXPECT_EQ(segments[2].box_wrap, (PixelBox{0, 4, 16, 4}));
  int64_t area = 0;
  double solid_angle = 0;
  for (const Segment& segment : segments) {
    area += segment.area;
    solid_angle += segment.solid_angle;
  }
  EXPECT_EQ(area, 16 * 8);
  EXPECT_NEAR(solid_angle, 4 * std::numbers::pi, 1e-10);
  // Closed form: 3 of 16 columns between +-45 degrees of elevation.
  EXPECT_NEAR(segments[1].solid_angle, 2 * std::numbers::pi * 3 / 16 * 2 * std::sin(std::numbers::pi / 4), 1e-12);
}

TEST(FindSegments, WithoutWrapTheBoxesAreTheSame) {
  const auto scene = ThreeEntities();
  Image<EntityId> entity(8, 4, 1);
  entity(0, 0) = entity(7, 0) = 2;
  Image<CategoryId> semantic(8, 4, scene->entity(1).category);
  semantic(0, 0) = semantic(7, 0) = scene->entity(2).category;
  const auto segments = FindSegments(entity, semantic, *scene, PixelSolidAngles(Equirectangular{8, 4}), {});
  EXPECT_EQ(segments[1].box_wrap, segments[1].box);
  EXPECT_EQ(segments[1].box, (PixelBox{0, 0, 8, 1}));
}

TEST(FindSegments, RefusesPixelsWithoutAnEntityOrWithAnotherCategory) {
  const auto scene = ThreeEntities();
  const PixelSolidAngles solid(Equirectangular{8, 4});
  Image<EntityId> entity(8, 4, 1);
  Image<CategoryId> semantic(8, 4, scene->entity(1).category);
  entity(3, 2) = kNoEntity;
  EXPECT_THROW(FindSegments(entity, semantic, *scene, solid, {}), RuntimeError);
  EXPECT_NO_THROW(FindSegments(entity, semantic, *scene, solid, {.allows_void = true}));
  entity(3, 2) = 4;
  EXPECT_THROW(FindSegments(entity, semantic, *scene, solid, {}), RuntimeError);
  entity(3, 2) = 2;
  EXPECT_THROW(FindSegments(entity, semantic, *scene, solid, {}), RuntimeError);
}

}  // namespace
}  // namespace airsim360
