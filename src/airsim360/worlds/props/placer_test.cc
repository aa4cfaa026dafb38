#include "airsim360/worlds/props/placer.h"

#include <gtest/gtest.h>

#include <numbers>

namespace airsim360 {
namespace {

TEST(Footprint, TurnedRectanglesOverlapOnlyWhereTheyMeet) {
  const Footprint a{{0, 0}, {2, 0.5f}, 0};
  EXPECT_TRUE(a.Overlaps({{1.9f, 0.4f}, {0.5f, 0.5f}, 0.3f}));
  EXPECT_FALSE(a.Overlaps({{0, 1.2f}, {2, 0.5f}, 0}));
  // A thin bar across the diagonal gap beside the corner: boxes around them overlap, the bars do not.
  const float diagonal = std::numbers::pi_v<float> / 4;
  EXPECT_FALSE(a.Overlaps({{2.9f, 1.4f}, {2, 0.1f}, -diagonal}));
  EXPECT_TRUE(a.Overlaps({{2.2f, 0.5f}, {2, 0.1f}, diagonal}));
}

TEST(Occupancy, RefusesWhatOverlapsAndKeepsTheRest) {
  Occupancy occupancy;
  occupancy.Add({{0, 0}, {6, 1}, 0});
  EXPECT_FALSE(occupancy.IsFree({{5.5f, 0.5f}, {0.3f, 0.3f}, 0}));
  EXPECT_TRUE(occupancy.IsFree({{0, 1.4f}, {0.3f, 0.3f}, 0}));
  EXPECT_TRUE(occupancy.IsFree({{-100, -100}, {3, 3}, 1}));
}

}  // namespace
}  // namespace airsim360
