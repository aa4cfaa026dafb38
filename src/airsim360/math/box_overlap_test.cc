#include "airsim360/math/box_overlap.h"

#include <gtest/gtest.h>

#include "airsim360/math/box.h"

namespace airsim360 {
namespace {

TEST(Overlap, BoxesThatTouchMeetAndOnesApartOnAnyAxisDoNot) {
  const Box3f box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_TRUE(Overlap(box, Box3f{{0.2f, 0.2f, 0.2f}, {0.3f, 0.3f, 0.3f}}));
  EXPECT_TRUE(Overlap(box, Box3f{{1, 2, 3}, {4, 4, 4}}));
  for (const Vec3f apart : {Vec3f{1.01f, 0, 0}, Vec3f{0, 2.01f, 0}, Vec3f{0, 0, 3.01f}}) {
    const Box3f other{box.min + apart, box.max + apart};
    EXPECT_FALSE(Overlap(box, other));
    EXPECT_FALSE(Overlap(other, box));
  }
}

TEST(Overlap, NothingMeetsAnEmptyBox) {
  EXPECT_FALSE(Overlap(Box3f{{-9, -9, -9}, {9, 9, 9}}, Box3f{}));
  EXPECT_FALSE(Overlap(Box3f{}, Box3f{}));
}

}  // namespace
}  // namespace airsim360
