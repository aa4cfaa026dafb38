// The radius of a fisheye picture as a function of the angle from its axis, and back. Not for other modules.
#pragma once

#include <optional>

#include "airsim360/projection/camera.h"

namespace airsim360::internal {

/// r(theta) = theta + k1 theta^3 + k2 theta^5 + k3 theta^7 + k4 theta^9, in focal lengths.
double RadiusOfTheta(const Fisheye& camera, double theta);

/// The theta in [0, max_theta] with r(theta) = r; nullopt where r is larger than r(max_theta). Needs
/// RadiusGrows.
std::optional<double> ThetaOfRadius(const Fisheye& camera, double r);

/// Whether dr / dtheta > 0 on all of [0, max_theta].
bool RadiusGrows(const Fisheye& camera);

}  // namespace airsim360::internal
