// Scores of paths flown towards a goal. Pure functions; metres. InputError for an empty path.
#pragma once

#include <span>

#include "airsim360/math/vector.h"

namespace airsim360 {

double PathLength(std::span<const Vec3d> path);

/// Success weighted by path length: success * shortest / max(flown, shortest); 1 for a success of no length
/// (Anderson et al., "On Evaluation of Embodied Navigation Agents", 2018). InputError for lengths that are not numbers of at least 0.
double SuccessByLength(bool success, double shortest, double flown);

/// Least sum of distances over all monotone pairings of two sequences of points that pair first with first
/// and last with last (dynamic time warping). O(path * reference) time.
double DynamicTimeWarping(std::span<const Vec3d> path, std::span<const Vec3d> reference);

/// exp(-DTW / (|reference| * threshold)), in (0, 1] (nDTW; Ilharco et al., "General Evaluation for
/// Instruction Conditioned Navigation using Dynamic Time Warping", 2019).
double NormalizedTimeWarping(std::span<const Vec3d> path, std::span<const Vec3d> reference, double threshold);

}  // namespace airsim360
