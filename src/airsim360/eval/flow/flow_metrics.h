// Errors of optical flow in pictures and panoramas. Pure functions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "airsim360/math/transform.h"

namespace airsim360 {

/// Means over pixels with truth, each times its weight; NaN without any.
struct FlowErrors {
  double epe = 0;     ///< length of the difference, pixels; in panoramas dx the shorter way round
  double fl_all = 0;  ///< share with an error above 3 pixels and above 5 % of the true flow's length (KITTI 2015)
  double within1 = 0, within3 = 0, within5 = 0;  ///< share with an error below 1, 3, 5 pixels
  double angle_deg = 0;                          ///< panoramas: angle between the directions that prediction and truth lead to; else NaN
  int64_t valid = 0;
};
inline constexpr std::array<std::string_view, 6> kFlowFigures = {"epe", "fl_all", "below1", "below3", "below5", "angle_error_deg"};
std::array<double, kFlowFigures.size()> Figures(const FlowErrors& errors);

/// Flows as (dx, dy) a pixel, NaN = unknown. `source[i]` is the pixel of the width x height picture that entry i belongs to (empty = i). InputError for arrays of different length or a prediction that is no number where there is a truth.
FlowErrors MeasureFlow(std::span<const double> prediction, std::span<const double> truth, int width, int height, bool panorama,
                       std::span<const uint32_t> source = {}, std::span<const double> weights = {});

/// What a flow predicted in a panorama of a turned camera says of the one that was not turned (R_C_turned of sphere/panorama_ray.h): of each
/// pixel that of the nearest one, both ends turned back, dx the shorter way round.
std::vector<double> TurnFlowBack(std::span<const double> flow, int width, int height, const Mat3d& R_C_turned);

}  // namespace airsim360
