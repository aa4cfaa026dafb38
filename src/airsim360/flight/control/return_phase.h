// Where in its way home a drone is.
#pragma once

#include <cstdint>

namespace airsim360 {

/// AutopilotState::phase of a return from its place above home on, where it comes down; below that it climbs
/// and flies there.
inline constexpr int64_t kReturnDown = 2;

}  // namespace airsim360
