#include "airsim360/sensors/gimbal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

GimbalAngles Limited(const GimbalSpec& spec, const GimbalAngles& a) {
  const double yaw = spec.yaw_limit_deg * kDegree, roll = spec.roll_limit_deg * kDegree;
  return {std::clamp(a.yaw, -yaw, yaw), std::clamp(a.pitch, spec.pitch_low_deg * kDegree, spec.pitch_high_deg * kDegree),
          std::clamp(a.roll, -roll, roll)};
}

}  // namespace

void GimbalSpec::Visit(ConfigVisitor& v) {
  v.Field("x", "metres forward of the centre of mass", p_BG.x, -100, 100);
  v.Field("y", "metres to the left", p_BG.y, -100, 100);
  v.Field("z", "metres up", p_BG.z, -100, 100);
  v.Field("stabilise_yaw", "keeps its heading", stabilise_yaw);
  v.Field("stabilise_pitch", "keeps its pitch over the horizon", stabilise_pitch);
  v.Field("stabilise_roll", "keeps the horizon level", stabilise_roll);
  v.Field("max_rate_deg", "degrees/s of each joint", max_rate_deg, 0, 1e6);
  v.Field("yaw_limit_deg", "either way", yaw_limit_deg, 0, 180);
  v.Field("pitch_low_deg", "lowest joint angle", pitch_low_deg, -90, 90);
  v.Field("pitch_high_deg", "highest joint angle", pitch_high_deg, -90, 90);
  v.Field("roll_limit_deg", "either way", roll_limit_deg, 0, 180);
}

GimbalAngles AnglesOf(const Mat3d& R) {
  const auto& m = R.m;
  const double pitch = std::asin(std::clamp(m[2][0], -1.0, 1.0));
  if (std::hypot(m[0][0], m[1][0]) < 1e-9) return {std::atan2(-m[0][1], m[1][1]), pitch, 0};
  return {std::atan2(m[1][0], m[0][0]), pitch, std::atan2(m[2][1], m[2][2])};
}

GimbalAngles WantedJoints(const GimbalSpec& spec, const GimbalAngles& command, const Mat3d& R_WB) {
  const GimbalAngles body = AnglesOf(R_WB);
  const double yaw = command.yaw + (spec.stabilise_yaw ? 0 : body.yaw);
  const double pitch = command.pitch + (spec.stabilise_pitch ? 0 : body.pitch);
  const double roll = command.roll + (spec.stabilise_roll ? 0 : body.roll);
  return AnglesOf(R_WB.transpose() * BodyPose({}, yaw, pitch, roll).R);
}

GimbalState StartGimbal(const GimbalSpec& spec, const GimbalAngles& command, const Mat3d& R_WB) {
  return {Limited(spec, WantedJoints(spec, command, R_WB)), command};
}

void StepGimbal(const GimbalSpec& spec, const Mat3d& R_WB, double dt, GimbalState& state) {
  const GimbalAngles wanted = Limited(spec, WantedJoints(spec, state.command, R_WB));
  const double reach = spec.max_rate_deg * kDegree * dt;
  const auto turn = [&](double from, double to) { return from + std::clamp(to - from, -reach, reach); };
  // A yaw joint that goes all the way round takes the shorter way.
  double yaw = wanted.yaw;
  if (spec.yaw_limit_deg >= 180) yaw = state.joints.yaw + std::remainder(yaw - state.joints.yaw, 2 * std::numbers::pi);
  state.joints = {std::remainder(turn(state.joints.yaw, yaw), 2 * std::numbers::pi), turn(state.joints.pitch, wanted.pitch),
                  turn(state.joints.roll, wanted.roll)};
}

RigidTransform GimbalMount::AtRest(const Mat3d& R_WB) const { return GimbalPose(spec, StartGimbal(spec, command, R_WB)); }

RigidTransform GimbalPose(const GimbalSpec& spec, const GimbalState& state) {
  return BodyPose(spec.p_BG, state.joints.yaw, state.joints.pitch, state.joints.roll);
}

}  // namespace airsim360
