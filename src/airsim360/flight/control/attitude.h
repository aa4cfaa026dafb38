// Attitudes from thrust directions, their errors and their rates (differential flatness).
#pragma once

#include "airsim360/math/transform.h"

namespace airsim360::internal {

/// Heading of a body: the angle of its forward axis seen from above.
double HeadingOf(const Mat3d& R_WB);
/// Wraps to [-pi, pi).
double WrapAngle(double angle);
/// Roll (right side down positive) and pitch (nose up positive) of BodyPose.
struct RollPitch {
  double roll = 0, pitch = 0;
};
RollPitch RollPitchOf(const Mat3d& R_WB);

/// The body whose +Z is along `up` and whose forward axis has heading `yaw`. `up` is not zero.
Mat3d AttitudeFor(Vec3d up, double yaw);

/// The turn, in B, that takes R_WB to `wanted`: first the shortest turn of the thrust axis (x, y), then the
/// rest about it (z). Tilt matters to where the drone goes, heading does not (Brescianini and D'Andrea 2018).
Vec3d AttitudeError(const Mat3d& R_WB, const Mat3d& wanted);

/// Rates and accelerations of the wanted attitude, in its own frame, when the specific force f moves with
/// first and second derivatives f1 and f2 (Mellinger and Kumar 2011; Faessler et al. 2018).
struct FlatRates {
  Vec3d w, alpha;
};
FlatRates RatesOf(const Mat3d& attitude, double force, Vec3d f1, Vec3d f2, double yaw, double yaw_rate);

}  // namespace airsim360::internal
