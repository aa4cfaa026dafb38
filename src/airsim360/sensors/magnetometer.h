// Magnetometer: the Earth's field, the same everywhere in a world, in the sensor's frame.
#pragma once

#include "airsim360/sensors/body_motion.h"
#include "airsim360/sensors/noise.h"

namespace airsim360 {

/// The Earth's field. Defaults: about that of Redmond, Washington, where AirSim's worlds lie.
struct MagneticField {
  double strength = 53e-6;        ///< T
  double declination_deg = 15.5;  ///< from north to the east
  double inclination_deg = 68.5;  ///< down from the horizon

  /// In W, T.
  Vec3d InWorld() const;
  void Visit(ConfigVisitor& v);
};

/// Defaults: a part with 0.2 microtesla RMS at 50 Hz; turn_on stands for uncalibrated hard iron.
struct MagnetometerSpec {
  Mount mount = {};
  double rate_hz = 50;
  NoiseSpec field{.white = 3e-8, .bias_instability = 2e-8, .turn_on = 3e-7};  ///< T

  void Visit(ConfigVisitor& v);
};

struct MagnetometerReading {
  int64_t t_ns = 0;
  Vec3d field;  ///< in S, T
};

struct MagnetometerState {
  NoiseState noise;
  MagnetometerReading last;
};

MagnetometerState StartMagnetometer(const MagnetometerSpec& spec, const SensorKey& key);
void SampleMagnetometer(const MagnetometerSpec& spec, const SensorKey& key, Vec3d field_W, const BodyMotion& motion, int64_t t_ns,
                        MagnetometerState& state);

}  // namespace airsim360
