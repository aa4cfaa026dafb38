#include "airsim360/eval/depth/depth_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

TEST(DepthErrors, OfAConstantFactorAreKnown) {
  const std::vector<double> g = {1, 2, 4, 8, 0, -1, NAN, INFINITY}, p = {1.3, 2.6, 5.2, 10.4, 5, 5, 5, 5};
  const DepthErrors e = MeasureDepth(p, g);
  EXPECT_EQ(e.valid, 4);
  EXPECT_NEAR(e.absrel, 0.3, 1e-12);
  EXPECT_NEAR(e.sqrel, 0.09 * 15 / 4, 1e-12);
  EXPECT_NEAR(e.rmse, 0.3 * std::sqrt(85.0 / 4), 1e-12);
  EXPECT_NEAR(e.rmselog, std::log(1.3), 1e-12);
  EXPECT_NEAR(e.log10, std::log10(1.3), 1e-12);
  EXPECT_NEAR(e.silog, 0, 1e-6);
  EXPECT_EQ(e.d1, 0);
  EXPECT_EQ(e.d2, 1);
  EXPECT_EQ(MeasureDepth(p, g, {}, {.max_depth = 4}).valid, 3);
  EXPECT_NEAR(MeasureDepth(p, g, {}, {.median_scale = true}).absrel, 0, 1e-12);
}

TEST(DepthErrors, WeightsRepeatPixels) {
  const std::vector<double> g = {1, 3}, p = {2, 4}, w = {1, 3}, g4 = {1, 3, 3, 3}, p4 = {2, 4, 4, 4};
  const DepthErrors a = MeasureDepth(p, g, w), b = MeasureDepth(p4, g4);
  EXPECT_NEAR(a.absrel, b.absrel, 1e-15);
  EXPECT_NEAR(a.rmselog, b.rmselog, 1e-15);
  EXPECT_EQ(a.d3, b.d3);
}

TEST(DepthErrors, DeltaIsStrict) {
  const std::vector<double> g = {4}, p = {5};
  EXPECT_EQ(MeasureDepth(p, g).d1, 0);
  EXPECT_EQ(MeasureDepth(p, g).d2, 1);
}

TEST(DepthErrors, WhatHasNoLogarithmIsInfinitelyWrong) {
  const std::vector<double> g = {4, 4}, zero = {0, 4}, nan = {NAN, 4};
  EXPECT_TRUE(std::isinf(MeasureDepth(zero, g).rmselog));
  EXPECT_EQ(MeasureDepth(zero, g).absrel, 0.5);
  EXPECT_EQ(MeasureDepth(zero, g).not_positive, 1);
  EXPECT_THROW(MeasureDepth(nan, g), InputError);
  EXPECT_THROW(MeasureDepth(g, std::vector<double>{1}), InputError);
  EXPECT_TRUE(std::isnan(MeasureDepth(g, std::vector<double>{0, 0}).absrel));
}

}  // namespace
}  // namespace airsim360
