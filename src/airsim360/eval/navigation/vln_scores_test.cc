#include "airsim360/eval/navigation/vln_scores.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

TEST(VlnScores, OfTheReferenceItselfAreFull) {
  VlnEpisode e{.reference = {{0, 0, 0}, {30, 0, 0}, {30, 40, 0}}};
  e.flown = e.reference;
  const VlnScore s = ScoreVln(e, 20);
  EXPECT_EQ(s.success + s.oracle + s.spl + s.ndtw + s.sdtw + s.cls, 6);
  EXPECT_DOUBLE_EQ(s.spl_straight, 50.0 / 70);
  EXPECT_EQ(s.error, 0);
  EXPECT_EQ(s.length, 70);
}

TEST(VlnScores, PassingTheGoalIsOracleSuccessAlone) {
  VlnEpisode e{.reference = {{0, 0, 0}, {30, 0, 0}}, .flown = {{0, 0, 0}, {30, 0, 0}, {60, 0, 0}}};
  const VlnScore s = ScoreVln(e, 20);
  EXPECT_EQ(s.success, 0);
  EXPECT_EQ(s.oracle, 1);
  EXPECT_DOUBLE_EQ(s.ndtw, std::exp(-30.0 / 40));
  // Covered in full, but twice as long: 1 * 30 / (30 + 30).
  EXPECT_DOUBLE_EQ(s.cls, 0.5);
  e.goal = Vec3d{60, 0, 0};
  EXPECT_EQ(ScoreVln(e, 20).success, 1);
}

TEST(VlnScores, AnyPlaceOfTheGoalWillDo) {
  // Past the first place by 1.4 m, and on to where the other is nearest.
  VlnEpisode e{.reference = {{0, 0, 0}, {10, 0, 0}}, .flown = {{0, 0, 0}, {10, 1.4, 0}, {18, 0, 0}}};
  e.places = {{20, 0, 0}};
  VlnScore s = ScoreVln(e, 1.5);
  EXPECT_EQ(s.success, 0);
  EXPECT_EQ(s.oracle, 1);
  EXPECT_EQ(s.error, 2);
  e.flown.push_back({19, 0, 0});
  s = ScoreVln(e, 1.5);
  EXPECT_EQ(s.success, 1);
  EXPECT_EQ(s.error, 1);
  EXPECT_EQ(s.spl_straight, 1);  // of 20 m, flown in 19.2
}

TEST(VlnScores, NoMoveForNoWayIsFull) {
  const VlnScore s = ScoreVln({.reference = {{1, 1, 1}}, .flown = {{1, 1, 1}}}, 5);
  EXPECT_EQ(s.spl, 1);
  EXPECT_EQ(s.cls, 1);
}

TEST(VlnScores, BadInputIsRefused) {
  EXPECT_THROW(ScoreVln({.reference = {{0, 0, 0}}, .flown = {}}, 5), InputError);
  EXPECT_THROW(ScoreVln({.reference = {{0, 0, 0}}, .flown = {{NAN, 0, 0}}}, 5), InputError);
  EXPECT_THROW(ScoreVln({.reference = {{0, 0, 0}}, .flown = {{0, 0, 0}}}, -1), InputError);
  EXPECT_THROW(ScoreVln({.reference = {{0, 0, 0}}, .flown = {{0, 0, 0}}, .shortest = -1}, 5), InputError);
  EXPECT_THROW(ScoreVln({.reference = {{0, 0, 0}}, .flown = {{0, 0, 0}}, .shortest = NAN}, 5), InputError);
  EXPECT_THROW(FindVlnProtocol("openfli"), InputError);
}

}  // namespace
}  // namespace airsim360
