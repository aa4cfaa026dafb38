// Constants of angles, for every module.
#pragma once

#include <numbers>

namespace airsim360 {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTau = 2 * std::numbers::pi;       ///< a full turn [rad]
inline constexpr double kDegree = std::numbers::pi / 180;  ///< one degree [rad]
inline constexpr double kRadian = 180 / std::numbers::pi;  ///< one radian [degrees]
inline constexpr float kPiF = std::numbers::pi_v<float>;
inline constexpr float kTauF = 2 * std::numbers::pi_v<float>;

}  // namespace airsim360
