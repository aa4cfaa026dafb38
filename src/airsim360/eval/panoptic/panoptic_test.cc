#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/eval/panoptic/panoptic_quality.h"
#include "airsim360/eval/panoptic/tracking_quality.h"
#include "airsim360/eval/semantic/confusion.h"

namespace airsim360 {
namespace {

std::vector<PanopticCount> Count(const std::vector<uint32_t>& p, const std::vector<uint32_t>& t, std::vector<PanopticSegment> ps,
                                 std::vector<PanopticSegment> ts, std::vector<double> weights = {}) {
  PanopticOverlap overlap;
  overlap.Add(p, t, weights);
  std::vector<PanopticCount> counts(2);
  overlap.Count(ps, ts, counts);
  return counts;
}

TEST(PanopticQuality, MatchesAboveOneHalfOnly) {
  // Four of the five pixels of either are shared, then two of six.
  EXPECT_DOUBLE_EQ(Count({1, 1, 1, 1, 2}, {5, 5, 5, 5, 5}, {{1, 0}, {2, 0}}, {{5, 0}})[0].iou, 0.8);
  const auto half = Count({1, 1, 0, 0}, {5, 5, 5, 5}, {{1, 0}}, {{5, 0}})[0];
  EXPECT_EQ(half.tp, 0);
  EXPECT_EQ(half.fp + half.fn, 2);
}

TEST(PanopticQuality, VoidAndCrowdExcusePredictions) {
  EXPECT_DOUBLE_EQ(Count({1, 1, 1, 1}, {5, 5, 0, 0}, {{1, 0}}, {{5, 0}})[0].iou, 1);  // void counts for neither
  EXPECT_EQ(Count({1, 1, 1, 1}, {5, 0, 0, 0}, {{1, 1}}, {{5, 0}})[1].fp, 0);          // mostly void
  EXPECT_EQ(Count({1, 1, 1, 1}, {5, 5, 5, 5}, {{1, 0}}, {{5, 0, true}})[0].fp, 0);    // all crowd
  EXPECT_EQ(Count({1, 1, 1, 1}, {5, 5, 5, 5}, {{1, 1}}, {{5, 0, true}})[1].fp, 1);    // of another category
}

TEST(PanopticQuality, WeightsAreAreas) {
  const auto c = Count({1, 1}, {5, 6}, {{1, 0}}, {{5, 0}, {6, 0}}, {3, 1})[0];
  EXPECT_DOUBLE_EQ(c.iou, 0.75);
  EXPECT_EQ(c.fn, 1);
  const PanopticQuality q = QualityOf(c);
  EXPECT_DOUBLE_EQ(q.pq, 0.75 / 1.5);
  EXPECT_TRUE(std::isnan(MeanQuality(std::vector<PanopticCount>(2), {true, true}).pq));
}

TEST(PanopticQuality, IdsOfPixelsAndListsMustAgree) {
  EXPECT_THROW(Count({1, 2}, {5, 5}, {{1, 0}}, {{5, 0}}), InputError);
  EXPECT_THROW(Count({1, 1}, {5, 5}, {{1, 0}, {2, 0}}, {{5, 0}}), InputError);
  EXPECT_THROW(Count({1, 1}, {5, 5}, {{1, 0}, {1, 0}}, {{5, 0}}), InputError);
  EXPECT_THROW(Count({1, 1}, {5, 5}, {{1, 7}}, {{5, 0}}), InputError);
}

TEST(TrackingQuality, ALostTrackHalvesTheAssociation) {
  // One thing for four frames of one pixel; two frames each under two ids.
  TrackingQuality quality({true});
  const std::vector<uint32_t> category = {0}, one = {1}, two = {2};
  for (const auto& id : {one, one, two, two}) quality.Add({category, id}, {category, one});
  const TrackingScore score = quality.Score();
  EXPECT_DOUBLE_EQ(score.aq, 0.5);  // each half: 2 * (2 / 4) / 4
  EXPECT_DOUBLE_EQ(score.sq, 1);
  EXPECT_DOUBLE_EQ(score.stq, std::sqrt(0.5));
  EXPECT_EQ(score.tubes, 1);
}

TEST(Confusion, LeavesOutWhatNobodyHas) {
  Confusion c(3);
  const std::vector<uint16_t> p = {0, 0, 1, Confusion::kOther, 1}, t = {0, 1, 1, 1, Confusion::kOther};
  c.Add(p, t);
  EXPECT_DOUBLE_EQ(c.Iou(0), 0.5);
  EXPECT_DOUBLE_EQ(c.Iou(1), 1.0 / 3);
  EXPECT_TRUE(std::isnan(c.Iou(2)));
  EXPECT_DOUBLE_EQ(c.MeanIou(), (0.5 + 1.0 / 3) / 2);
  EXPECT_DOUBLE_EQ(c.PixelAccuracy(), 0.5);
  EXPECT_THROW(c.Add(Confusion(2)), InputError);
}

}  // namespace
}  // namespace airsim360
