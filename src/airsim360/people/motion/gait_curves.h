// What legs do over a stride, from published curves.
#pragma once

namespace airsim360::internal {

/// The gait of one person at one instant.
struct Gait {
  double weight = 0;     ///< 0 stands, 1 walks or runs
  double run = 0;        ///< 0 walk, 1 run
  double amplitude = 1;  ///< of the hip about its mean: (speed / free speed)^0.42
  double duty = 0.62;    ///< share of the stride that a foot is on the ground
};

/// Gait at a speed (m/s) of a leg of `leg` metres; `weight` and `run` are passed through.
Gait GaitAt(double speed, double leg, double weight, double run);

struct LegAngles {
  double hip = 0;    ///< flexion of the thigh against the pelvis, radians
  double knee = 0;   ///< flexion, radians
  double pitch = 0;  ///< of the foot against the ground, toe down positive, radians
};

/// Angles of a leg at `phase` of its own stride (0 = heel strike). Walk: hip of Olshen et al. 1989 (39 boys,
/// pelvic tilt of 12 degrees taken off), knee of the same mixed with Schwartz et al. 2008 (11.5 : 1), Fourier
/// series through the 20 phases. Run: key figures of Novacheck 1998.
LegAngles LegCurves(const Gait& gait, double phase);

/// Mean and standard deviation of the 39 boys at phases 0.025 + 0.05 i, degrees; hip as recorded (with tilt).
extern const double kBoysHip[20], kBoysHipDeviation[20], kBoysKnee[20], kBoysKneeDeviation[20];
inline constexpr double kPelvicTiltDeg = 12;

}  // namespace airsim360::internal
