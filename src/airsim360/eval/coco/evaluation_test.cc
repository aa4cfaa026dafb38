#include "airsim360/eval/coco/evaluation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/eval/coco/similarity.h"

namespace airsim360 {
namespace {

std::vector<std::vector<CocoMatches>> Matches(const std::vector<CocoCell>& cells, const CocoOptions& options) {
  std::vector<std::vector<CocoMatches>> matches;
  for (const CocoCell& cell : cells) matches.push_back({MatchCoco(cell, options)});
  return matches;
}

double Ap(const std::vector<CocoCell>& cells) {
  const CocoOptions options = StandardCocoOptions();
  return AccumulateCoco(Matches(cells, options), options, 1).MeanPrecision(CocoTable::kAll, CocoTable::kAll, 0, 2);
}

TEST(AveragePrecision, OneRightOfTwoTruthsReachesHalfTheRecalls) {
  // Precision 1 at recalls 0 … 0.5: 51 of 101; nothing beyond.
  EXPECT_NEAR(Ap({{.truths = {{.area = 50}, {.area = 50}}, .detections = {{0.9, 50}}, .overlaps = {{{0, 1.0}}}}}), 51.0 / 101, 1e-12);
}

TEST(AveragePrecision, ThresholdsAboveTheOverlapFail) {
  EXPECT_NEAR(Ap({{.truths = {{.area = 50}}, .detections = {{0.9, 50}}, .overlaps = {{{0, 0.72}}}}}), 0.5, 1e-12);
}

TEST(AveragePrecision, EqualScoresKeepTheOrderOfPicturesAndFiles) {
  const CocoCell wrong = {.truths = {}, .detections = {{0.5, 50}}, .overlaps = {{}}};
  const CocoCell right = {.truths = {{.area = 50}}, .detections = {{0.5, 50}}, .overlaps = {{{0, 1.0}}}};
  EXPECT_NEAR(Ap({right, wrong}), 1, 1e-12);
  EXPECT_NEAR(Ap({wrong, right}), 0.5, 1e-12);
}

TEST(Matching, ACrowdTakesAnyNumberAndCountsForNothing) {
  const CocoCell cell = {.truths = {{.area = 50, .crowd = true, .ignore = true}, {.area = 50}},
                         .detections = {{0.9, 50}, {0.8, 50}, {0.7, 50}},
                         .overlaps = {{{0, 0.9}}, {{0, 0.8}, {1, 0.6}}, {{0, 0.95}}}};
  const CocoMatches matches = MatchCoco(cell, StandardCocoOptions());
  EXPECT_EQ(matches.areas[0].truths, 1u);
  // At 0.5 the second prefers the truth that counts, though it overlaps the crowd more.
  EXPECT_EQ(std::vector<uint8_t>(matches.areas[0].ignored.begin(), matches.areas[0].ignored.begin() + 3), (std::vector<uint8_t>{1, 0, 1}));
  EXPECT_EQ(std::vector<uint8_t>(matches.areas[0].matched.begin(), matches.areas[0].matched.begin() + 3), (std::vector<uint8_t>{1, 1, 1}));
}

TEST(Accumulation, DrawingAPictureTwiceIsHavingItTwice) {
  const CocoOptions options = StandardCocoOptions();
  const CocoCell a = {.truths = {{.area = 50}}, .detections = {{0.5, 50}, {0.9, 50}}, .overlaps = {{{0, 0.8}}, {}}};
  const CocoCell b = {.truths = {{.area = 9}, {.area = 50}}, .detections = {{0.7, 50}}, .overlaps = {{{1, 0.9}}}};
  const std::vector<uint32_t> draws = {2, 1};
  const auto two = Matches({a, b}, options), three = Matches({a, a, b}, options);
  const CocoTable drawn = AccumulateCoco(two, options, 1, draws), had = AccumulateCoco(three, options, 1);
  for (size_t area = 0; area < 4; ++area)
    EXPECT_EQ(drawn.MeanPrecision(CocoTable::kAll, 0, area, 2), had.MeanPrecision(CocoTable::kAll, 0, area, 2));
}

TEST(Similarity, KeypointsFallOffAsAGaussian) {
  std::vector<double> truth(51, 0), found(51, 0);
  for (size_t k = 0; k < 17; ++k) truth[3 * k + 2] = k == 0 ? 2 : 0;  // only the nose is labelled
  found[0] = 3;
  EXPECT_NEAR(KeypointSimilarity(found, truth, CocoKeypointSigmas(), 100, {0, 0, 10, 10}), std::exp(-9 / (2 * 100 * 4 * 0.026 * 0.026)),
              1e-12);
  EXPECT_NEAR(BoxOverlap({0, 0, 2, 2}, {1, 0, 2, 2}, false), 2.0 / 6, 1e-15);
  EXPECT_NEAR(BoxOverlap({0, 0, 2, 2}, {1, 0, 9, 9}, true), 0.5, 1e-15);
}

}  // namespace
}  // namespace airsim360
