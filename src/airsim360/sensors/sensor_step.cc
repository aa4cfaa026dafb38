// Sampling all sensors of a vehicle.
#include "airsim360/sensors/sample_clock.h"
#include "airsim360/sensors/sensor_set.h"

namespace airsim360 {
namespace {

void Add(const NoiseState& noise, StateHasher& hasher) {
  hasher.Add(noise.constant);
  hasher.Add(noise.drift);
  hasher.Add(noise.walk);
}

void Add(const GnssReading& reading, StateHasher& hasher) {
  hasher.Add(reading.t_ns);
  hasher.Add(reading.measured_ns);
  hasher.Add(reading.p_WS);
  hasher.Add(reading.v_WS);
  hasher.Add(reading.has_fix);
}

}  // namespace

SensorKey KeyOf(const SensorWorld& world, uint32_t vehicle, std::string_view kind, size_t i) {
  return {world.seed ^ HashName(kind), vehicle, static_cast<uint32_t>(i)};
}

SensorStates StartSensors(const SensorSet& set, const SensorWorld& world, uint32_t vehicle, const BodyMotion& motion) {
  SensorStates states;
  for (const auto& gimbal : set.gimbals) states.gimbals.push_back(StartGimbal(gimbal.spec, {}, motion.body.X_WB.R));
  for (size_t i = 0; i < set.imus.size(); ++i) states.imus.push_back(StartImu(set.imus[i].spec, KeyOf(world, vehicle, "imu", i)));
  for (size_t i = 0; i < set.gnss.size(); ++i) states.gnss.push_back(StartGnss(set.gnss[i].spec, KeyOf(world, vehicle, "gnss", i)));
  for (size_t i = 0; i < set.barometers.size(); ++i) {
    states.barometers.push_back(StartBarometer(set.barometers[i].spec, KeyOf(world, vehicle, "barometer", i)));
  }
  for (size_t i = 0; i < set.magnetometers.size(); ++i) {
    states.magnetometers.push_back(StartMagnetometer(set.magnetometers[i].spec, KeyOf(world, vehicle, "magnetometer", i)));
  }
  return states;
}

void StepSensors(const SensorSet& set, const SensorWorld& world, uint32_t vehicle, const BodyMotion& motion, int64_t t_ns, int64_t dt_ns,
                 SensorStates& states) {
  const auto due = [&](double rate_hz) { return SampleDue(rate_hz, t_ns, dt_ns); };
  for (size_t i = 0; i < states.gimbals.size(); ++i) {
    StepGimbal(set.gimbals[i].spec, motion.body.X_WB.R, static_cast<double>(dt_ns) * 1e-9, states.gimbals[i]);
  }
  for (size_t i = 0; i < states.imus.size(); ++i) {
    if (due(set.imus[i].spec.rate_hz)) SampleImu(set.imus[i].spec, KeyOf(world, vehicle, "imu", i), motion, t_ns, states.imus[i]);
  }
  for (size_t i = 0; i < states.gnss.size(); ++i) {
    if (due(set.gnss[i].spec.rate_hz)) {
      SampleGnss(set.gnss[i].spec, KeyOf(world, vehicle, "gnss", i), world.frame, motion, t_ns, states.gnss[i]);
    }
  }
  for (size_t i = 0; i < states.barometers.size(); ++i) {
    if (!due(set.barometers[i].spec.rate_hz)) continue;
    const double height = world.frame.origin().altitude + motion.body.X_WB.p.z;
    SampleBarometer(set.barometers[i].spec, KeyOf(world, vehicle, "barometer", i), motion, height, world.sea_level_pressure, t_ns,
                    states.barometers[i]);
  }
  for (size_t i = 0; i < states.magnetometers.size(); ++i) {
    if (due(set.magnetometers[i].spec.rate_hz)) {
      SampleMagnetometer(set.magnetometers[i].spec, KeyOf(world, vehicle, "magnetometer", i), world.field.InWorld(), motion, t_ns,
                         states.magnetometers[i]);
    }
  }
}

void HashSensors(const SensorStates& states, StateHasher& hasher) {
  for (const GimbalState& gimbal : states.gimbals) {
    for (const GimbalAngles& a : {gimbal.joints, gimbal.command}) hasher.Add(Vec3d{a.yaw, a.pitch, a.roll});
  }
  for (const ImuState& imu : states.imus) {
    Add(imu.gyro, hasher);
    Add(imu.accel, hasher);
    hasher.Add(imu.last.t_ns);
    hasher.Add(imu.last.angular_velocity);
    hasher.Add(imu.last.specific_force);
  }
  for (const GnssState& gnss : states.gnss) {
    hasher.Add(gnss.error);
    hasher.Add(gnss.measured_ns);
    for (const GnssReading& reading : gnss.pending) Add(reading, hasher);
    Add(gnss.last, hasher);
  }
  for (const BarometerState& barometer : states.barometers) {
    Add(barometer.noise, hasher);
    hasher.Add(barometer.last.t_ns);
    hasher.Add(barometer.last.pressure);
  }
  for (const MagnetometerState& magnetometer : states.magnetometers) {
    Add(magnetometer.noise, hasher);
    hasher.Add(magnetometer.last.t_ns);
    hasher.Add(magnetometer.last.field);
  }
}

}  // namespace airsim360
