// Inertial measurement unit: angular velocity and specific force at its place on the body.
#pragma once

#include "airsim360/sensors/body_motion.h"
#include "airsim360/sensors/noise.h"

namespace airsim360 {

/// Defaults: an ADIS16448 with the noise that the EuRoC data set publishes for it (imu0/sensor.yaml) and the
/// in-run bias stability of its datasheet (14.5 degrees/h, 0.25 mg).
struct ImuSpec {
  Mount mount = {};
  double rate_hz = 200;
  NoiseSpec gyro{.white = 1.6968e-4, .bias_instability = 7.0e-5, .random_walk = 1.9393e-5, .turn_on = 3e-3};
  NoiseSpec accel{.white = 2.0e-3, .bias_instability = 2.5e-3, .random_walk = 3.0e-3, .turn_on = 2e-2};
  double gyro_range = 17.5;  ///< rad/s: larger rates read as this (1000 degrees/s)
  double accel_range = 177;  ///< m/s^2 (18 g)

  void Visit(ConfigVisitor& v);
};

struct ImuReading {
  int64_t t_ns = 0;
  Vec3d angular_velocity;  ///< w_WS_S, rad/s
  Vec3d specific_force;    ///< in S, m/s^2: acceleration less gravity; (0, 0, 9.80665) on a level table
};

struct ImuState {
  NoiseState gyro, accel;
  ImuReading last;
};

/// What an ideal IMU on a mount that is fixed to the body reads.
ImuReading IdealImu(const RigidTransform& X_BS, const BodyMotion& motion, int64_t t_ns);

ImuState StartImu(const ImuSpec& spec, const SensorKey& key);
/// The sample at t; `state.last` is it.
void SampleImu(const ImuSpec& spec, const SensorKey& key, const BodyMotion& motion, int64_t t_ns, ImuState& state);

}  // namespace airsim360
