// Range finder: distance to the nearest surface in a narrow beam.
#pragma once

#include "airsim360/sensors/body_motion.h"
#include "airsim360/sensors/noise.h"
#include "airsim360/sensors/ray_packet.h"

namespace airsim360 {

struct RangeFinderSpec {
  Mount mount{.pitch_deg = -90};  ///< S's forward axis is the beam's; default: straight down
  uint64_t gimbal = 0;            ///< 0 = fixed to the body, n = on the n-th gimbal
  double rate_hz = 50;
  double beam_deg = 2;                     ///< full opening of the cone; 0 = a single ray
  double min_range = 0.2, max_range = 40;  ///< metres
  double sigma = 0.02;                     ///< metres
  double sigma_per_metre = 0.002;          ///< added in quadrature
  bool through_panes = false;              ///< clear glass is not seen

  void Visit(ConfigVisitor& v);
};

struct RangeReading {
  int64_t t_ns = 0;
  double range = 0;    ///< metres, in [min_range, max_range]; max_range where nothing is in reach
  bool valid = false;  ///< something was met
  EntityId entity = kNoEntity;
  CategoryId category = kVoid;
};

/// The nearest hit of 16 rays spread over the cone (a Fermat spiral, the first on the axis); one ray if
/// beam_deg is 0. A pure function of its arguments.
RangeReading MeasureRange(const RangeFinderSpec& spec, const SensorKey& key, const RayTracer& tracer, const RigidTransform& X_WS,
                          int64_t t_ns);

}  // namespace airsim360
