// How well distances and orientations are told, beside what needs no learning.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "airsim360/eval/mpde_metrics.h"
#include "airsim360/eval/statistics/bootstrap.h"
#include "airsim360/mpde/model.h"

namespace airsim360 {

struct MpdeReport {
  MpdeErrors errors;
  std::array<MpdeErrors, kMpdeGroupEnds.size() + 1> groups;  ///< by true distance
  Interval distance_interval;                                ///< of errors.distance_mae_m: 95 %, by 2,000 draws of people
  double within_spread = 0;  ///< share of distances within the predicted spread: 0.63 if it is right (Laplace)
  double constant_height_mae_m = 0, constant_trunk_mae_m = 0;
};

/// InputError if the lengths differ or there are no samples.
MpdeReport Judge(std::span<const MpdePrediction> predictions, std::span<const MpdeSample> samples, uint64_t seed = 0);

}  // namespace airsim360
