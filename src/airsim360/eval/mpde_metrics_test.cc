#include "airsim360/eval/mpde_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

TEST(MpdeMetrics, AnErrorAcrossTheBackIsSmallWrappedAndLargeAsMonolocoLogsIt) {
  const std::vector<PersonPose> truth = {{10, kPi - 0.1}}, predicted = {{11.5, -kPi + 0.1}};
  const MpdeErrors errors = MeasureMpde(predicted, truth);
  EXPECT_DOUBLE_EQ(errors.distance_mae_m, 1.5);
  EXPECT_NEAR(errors.angle_mae_deg, 0.2 * 180 / kPi, 1e-9);
  EXPECT_NEAR(errors.angle_unwrapped_mae_deg, (2 * kPi - 0.2) * 180 / 3.14, 1e-9);
}

TEST(MpdeMetrics, WholeTurnsOfTheInputChangeNothing) {
  const std::vector<PersonPose> truth = {{3, 0.4}, {20, -2}}, predicted = {{4, 0.1}, {18, 2}};
  std::vector<PersonPose> turned = predicted;
  for (PersonPose& pose : turned) pose.angle += 6 * kPi;
  const MpdeErrors a = MeasureMpde(predicted, truth), b = MeasureMpde(turned, truth);
  EXPECT_NEAR(a.angle_mae_deg, b.angle_mae_deg, 1e-9);
  EXPECT_NEAR(a.angle_unwrapped_mae_deg, b.angle_unwrapped_mae_deg, 1e-9);
}

TEST(MpdeMetrics, PoolingTheRowsOfThePaperGivesItsColumns) {
  // nuScenes alone: nuScenes, KITTI, FreeMan, Omni360-Human with the published counts.
  std::vector<MpdeErrors> rows = {{15369, 1.078, 0, 31.9}, {1759, .822, 0, 31.5}, {43361, .26, 0, 17}, {11496, 2.439, 0, 33.3}};
  const MpdeErrors all = PoolMpde(rows);
  EXPECT_NEAR(all.distance_mae_m, 0.80, 0.005);
  EXPECT_NEAR(all.angle_unwrapped_mae_deg, 23.14, 0.005);
  rows.pop_back();
  const MpdeErrors published = PoolMpde(rows);
  EXPECT_NEAR(published.distance_mae_m, 0.484, 0.0005);
  EXPECT_NEAR(published.angle_unwrapped_mae_deg, 21.207, 0.0005);
}

TEST(MpdeMetrics, GroupsByTrueDistancePoolToTheWhole) {
  std::vector<PersonPose> truth, predicted;
  for (int i = 0; i < 40; ++i) truth.push_back({1.0 + i, 0.1 * i}), predicted.push_back({1.5 + 1.02 * i, 0.1 * i + 0.05 * (i % 3)});
  const auto groups = MeasureMpdeGroups(predicted, truth);
  EXPECT_EQ(groups[0].count, 9);   // 1 to 9
  EXPECT_EQ(groups[1].count, 10);  // 10 to 19: an end belongs to the group above
  const MpdeErrors whole = MeasureMpde(predicted, truth), pooled = PoolMpde(groups);
  EXPECT_EQ(pooled.count, 40);
  EXPECT_NEAR(pooled.distance_mae_m, whole.distance_mae_m, 1e-12);
  EXPECT_NEAR(pooled.angle_mae_deg, whole.angle_mae_deg, 1e-12);
}

TEST(MpdeMetrics, NobodyHasNoErrorAndNonsenseIsRefused) {
  EXPECT_TRUE(std::isnan(MeasureMpde({}, {}).distance_mae_m));
  const std::vector<PersonPose> one = {{3, 0}}, two = {{3, 0}, {4, 0}}, bad = {{std::numeric_limits<double>::infinity(), 0}};
  EXPECT_THROW(MeasureMpde(one, two), InputError);
  EXPECT_THROW(MeasureMpdeGroups(one, two), InputError);
  EXPECT_THROW(MeasureMpde(bad, one), InputError);
}

TEST(MpdeMetrics, AnglesWrapIntoOneTurn) {
  EXPECT_DOUBLE_EQ(WrapAngle(kPi), kPi);
  EXPECT_DOUBLE_EQ(WrapAngle(-kPi), kPi);
  EXPECT_NEAR(WrapAngle(5 * kPi + 0.25), -kPi + 0.25, 1e-12);
}

}  // namespace
}  // namespace airsim360
