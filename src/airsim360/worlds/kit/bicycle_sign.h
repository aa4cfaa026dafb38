// The sign of a bicycle on a lane: strokes of paint, for every builder of streets.
#pragma once

#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// From one place to another, each metres along the lane and to the left, for those who ride along it.
struct SignStroke {
  Vec2f from, to;
};

inline constexpr float kSignStroke = 0.08f;  ///< width of a stroke, metres
/// Two wheels and a frame, seen by who rides towards the sign: 1.5 m across, 1.8 m along.
std::vector<SignStroke> BicycleSign();

}  // namespace airsim360
