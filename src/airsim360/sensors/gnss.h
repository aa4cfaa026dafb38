// Satellite navigation: place and velocity with the errors and the delay of a receiver.
#pragma once

#include <vector>

#include "airsim360/math/geodesy.h"
#include "airsim360/sensors/body_motion.h"
#include "airsim360/sensors/noise.h"

namespace airsim360 {

/// Defaults: a single-frequency receiver under open sky (1.5 m CEP, 10 Hz, 0.05 m/s).
struct GnssSpec {
  Mount mount = {};  ///< of the antenna
  double rate_hz = 10;
  double horizontal_sigma = 1.27;  ///< metres, of east and of north: CEP / 1.1774
  double vertical_sigma = 2.5;     ///< metres
  double velocity_sigma = 0.05;    ///< m/s, of each axis, white
  double correlation_time = 60;    ///< seconds over which the position error drifts; 0 = new at each sample
  double latency = 0.2;            ///< seconds from a measurement to its reading
  double start_up = 0;             ///< seconds without a fix after the start

  void Visit(ConfigVisitor& v);
};

struct GnssReading {
  int64_t t_ns = 0;         ///< when it was delivered
  int64_t measured_ns = 0;  ///< when the antenna was there
  GeoPoint place;
  Vec3d p_WS;               ///< the same in W, metres
  Vec3d v_WS;               ///< in W, m/s
  double eph = 0, epv = 0;  ///< metres: one-sigma errors that the receiver reports
  bool has_fix = false;
};

struct GnssState {
  Vec3d error;                       ///< of the position now, metres
  std::vector<GnssReading> pending;  ///< measured, not yet delivered; oldest first
  int64_t measured_ns = 0;           ///< time of the last measurement
  GnssReading last;
};

GnssState StartGnss(const GnssSpec& spec, const SensorKey& key);
/// Measures at t and delivers what is due; call at every sample of the rate.
void SampleGnss(const GnssSpec& spec, const SensorKey& key, const GeoFrame& frame, const BodyMotion& motion, int64_t t_ns,
                GnssState& state);

/// Velocity in W of a point fixed to the body at r in B.
Vec3d PointVelocity(const Kinematics& body, Vec3d r_B);

}  // namespace airsim360
