#pragma once

namespace airsim360 {

/// Luminance that no exposure of a picture's own makes whiter than white, cd/m2, so that nights stay dark: f/2, 1/20 s and
/// ISO 3200 to 6400 of a small sensor.
inline constexpr double kDimmestWhite = 1.5;

}  // namespace airsim360
