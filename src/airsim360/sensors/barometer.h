// Barometer: static pressure and the altitude it stands for.
#pragma once

#include "airsim360/sensors/body_motion.h"
#include "airsim360/sensors/noise.h"

namespace airsim360 {

/// Defaults: an MS5611 class part (1.2 Pa RMS at 50 Hz).
struct BarometerSpec {
  Mount mount = {};
  double rate_hz = 50;
  NoiseSpec pressure{.white = 0.17, .bias_instability = 3, .bias_time = 1000, .turn_on = 10};  ///< Pa
  double qnh = 101325;  ///< Pa: what the altitude of the reading is worked out with

  void Visit(ConfigVisitor& v);
};

struct BarometerReading {
  int64_t t_ns = 0;
  double pressure = 0;     ///< Pa
  double altitude = 0;     ///< metres over sea level, from the pressure and the spec's QNH
  double temperature = 0;  ///< K, of the air
};

struct BarometerState {
  NoiseState noise;
  BarometerReading last;
};

BarometerState StartBarometer(const BarometerSpec& spec, const SensorKey& key);
/// `height` of B over sea level at t; `sea_level_pressure` of the weather, Pa.
void SampleBarometer(const BarometerSpec& spec, const SensorKey& key, const BodyMotion& motion, double height, double sea_level_pressure,
                     int64_t t_ns, BarometerState& state);

}  // namespace airsim360
