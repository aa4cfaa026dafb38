#include "airsim360/rpc/coordinates/ned_commands.h"

#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

VerticalTarget Vertical(NedVertical vertical, Vec3d origin_W) {
  if (vertical.is_throttle) return {VerticalTarget::Mode::kThrottle, vertical.value};
  return {VerticalTarget::Mode::kAltitude, origin_W.z - vertical.value};
}

}  // namespace

YawTarget YawOf(const airsim::YawMode& mode) {
  const double angle = mode.yaw_or_rate * kDegree;
  if (mode.is_rate) return {YawTarget::Mode::kRate, -angle};
  return {YawTarget::Mode::kAngle, SwapHeading(angle)};
}

Command NedVelocity(Vec3d v_N, const airsim::YawMode& yaw) {
  VelocityCommand command;
  command.v = NedFromWorld(v_N);
  command.yaw = YawOf(yaw);
  return command;
}

Command NedVelocityZ(double vx, double vy, double z, const airsim::YawMode& yaw, Vec3d origin_W) {
  VelocityCommand command;
  command.v = NedFromWorld({vx, vy, 0});
  command.yaw = YawOf(yaw);
  command.hold_altitude = true;
  command.altitude = origin_W.z - z;
  return command;
}

Command NedPosition(Vec3d p_N, const airsim::YawMode& yaw, Vec3d origin_W) {
  PositionCommand command;
  command.p_W = origin_W + NedFromWorld(p_N);
  command.yaw = YawOf(yaw);
  return command;
}

Command FrdAttitude(double roll, double pitch, double yaw, bool yaw_is_rate, NedVertical vertical, Vec3d origin_W) {
  AttitudeCommand command;
  command.roll = roll;
  command.pitch = pitch;
  command.yaw = yaw_is_rate ? YawTarget{YawTarget::Mode::kRate, -yaw} : YawTarget{YawTarget::Mode::kAngle, SwapHeading(yaw)};
  command.vertical = Vertical(vertical, origin_W);
  return command;
}

Command FrdRates(Vec3d rates_F, NedVertical vertical, Vec3d origin_W) {
  RateCommand command;
  command.w_B = FrdFromBody(rates_F);
  command.vertical = Vertical(vertical, origin_W);
  return command;
}

Command MotorSignals(const std::array<double, 4>& signals) {
  RotorSignalCommand command;
  for (size_t i = 0; i < signals.size(); ++i) command.signals[i] = signals[i];
  return command;
}

}  // namespace airsim360
