#include "airsim360/sensors/imu.h"

#include <algorithm>

#include "airsim360/math/standard_atmosphere.h"
#include "airsim360/sensors/sample_clock.h"

namespace airsim360 {
namespace {

Vec3d Clamp(Vec3d v, double range) {
  return {std::clamp(v.x, -range, range), std::clamp(v.y, -range, range), std::clamp(v.z, -range, range)};
}

}  // namespace

void ImuSpec::Visit(ConfigVisitor& v) {
  v.Group("mount", "place on the body", [&](ConfigVisitor& g) { mount.Visit(g); });
  v.Field("rate_hz", "samples a second", rate_hz, 0.01, 1e5);
  v.Group("gyro", "noise, rad/s", [&](ConfigVisitor& g) { gyro.Visit(g); });
  v.Group("accel", "noise, m/s^2", [&](ConfigVisitor& g) { accel.Visit(g); });
  v.Field("gyro_range", "rad/s", gyro_range, 0, 1e4);
  v.Field("accel_range", "m/s^2", accel_range, 0, 1e5);
}

ImuReading IdealImu(const RigidTransform& X_BS, const BodyMotion& motion, int64_t t_ns) {
  const Vec3d w = motion.body.w_WB_B, r = X_BS.p;
  const Vec3d a_B = motion.body.X_WB.R.transpose() * (motion.a_WB + Vec3d{0, 0, kGravity});
  const Vec3d f_B = a_B + Cross(motion.alpha_WB_B, r) + Cross(w, Cross(w, r));
  const Mat3d R_SB = X_BS.R.transpose();
  return {t_ns, R_SB * w, R_SB * f_B};
}

ImuState StartImu(const ImuSpec& spec, const SensorKey& key) {
  ImuState state;
  state.gyro = StartNoise(spec.gyro, SampleStream(key, "gyro start", 0));
  state.accel = StartNoise(spec.accel, SampleStream(key, "accel start", 0));
  return state;
}

void SampleImu(const ImuSpec& spec, const SensorKey& key, const BodyMotion& motion, int64_t t_ns, ImuState& state) {
  const double dt = SampleLength(spec.rate_hz, t_ns, state.last.t_ns);
  const auto index = static_cast<uint64_t>(t_ns);
  state.last = IdealImu(spec.mount.pose(), motion, t_ns);
  state.last.angular_velocity =
      Clamp(state.last.angular_velocity + NextNoise(spec.gyro, dt, SampleStream(key, "gyro", index), state.gyro), spec.gyro_range);
  state.last.specific_force =
      Clamp(state.last.specific_force + NextNoise(spec.accel, dt, SampleStream(key, "accel", index), state.accel), spec.accel_range);
}

}  // namespace airsim360
