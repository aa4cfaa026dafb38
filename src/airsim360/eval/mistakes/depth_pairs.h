// Predicted and true depths at the pixels of a grid, as logarithms, and how well they agree.
#pragma once

#include <span>
#include <vector>

#include "airsim360/eval/mistakes/likely_cause.h"
#include "airsim360/eval/mistakes/turns.h"

namespace airsim360::internal {

/// Where both are above 0.
struct DepthPairs {
  std::vector<double> prediction, truth, ratio;  ///< logarithms; ratio is their difference
  std::vector<size_t> places;                    ///< in the grid
  double middle = 0;                             ///< median of ratio
  double scaled_error = 0;                       ///< MeanDistance of ratio from it: what a constant scale leaves
};

/// Mean distance from a value, those above 1 as 1.
double MeanDistance(std::span<const double> values, double from);
/// Share of logarithms of ratios that are within a factor of 1.25 of `from`.
double Agreement(std::span<const double> values, double from);
/// Of the line through (x, y) with the least squares.
double SlopeOf(std::span<const double> x, std::span<const double> y);

/// Depths along an axis, or horizontal distances, for ranges of a panorama or the other way round: the ratio follows a cosine of the ray.
LikelyMistake AxisMistake(const DepthPairs& pairs, const SampleGrid& grid);

}  // namespace airsim360::internal
