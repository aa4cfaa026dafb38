#include "airsim360/scene/parts.h"

#include <gtest/gtest.h>

namespace airsim360 {
namespace {

TEST(Parts, MaterialsOfABuildingTellItsWindowsAndDoors) {
  EXPECT_EQ(PartOf("construction/building", "glass with curtain"), Part::kWindow);
  EXPECT_EQ(PartOf("construction/building", "shop window 0"), Part::kWindow);
  EXPECT_EQ(PartOf("construction/building", "frame white"), Part::kWindow);
  EXPECT_EQ(PartOf("construction/building", "Doors_02"), Part::kDoor);
  EXPECT_EQ(PartOf("construction/building", "brick red"), Part::kNone);
}

TEST(Parts, TheSameMaterialMeansNothingOnAnotherThing) {
  EXPECT_EQ(PartOf("furniture/lighting/street_light", "glass"), Part::kNone);
  EXPECT_EQ(PartOf("vehicle/car", "Glass"), Part::kWindow);
  EXPECT_EQ(PartOf("vegetation/tree/broadleaf/elm", "bark"), Part::kTrunk);
}

TEST(Parts, AWordInsideAnotherDoesNotCount) {
  EXPECT_EQ(PartOf("construction/building", "fiberglass"), Part::kNone);
  EXPECT_EQ(PartOf("construction/building", "outdoor paint"), Part::kNone);
}

TEST(Parts, ABalconyIsOneWhateverItIsMadeOf) { EXPECT_EQ(PartOf("construction/balcony", "frame dark"), Part::kBalcony); }

}  // namespace
}  // namespace airsim360
