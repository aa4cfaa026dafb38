// 3D lidar: a scan of points with range, intensity, category and entity.
#pragma once

#include <string>
#include <vector>

#include "airsim360/sensors/body_motion.h"
#include "airsim360/sensors/noise.h"
#include "airsim360/sensors/ray_packet.h"

namespace airsim360 {

/// Defaults: AirSim's (16 channels, 100,000 points/s at 10 turns a second, 100 m, -45 … -15 degrees).
struct LidarSpec {
  Mount mount = {};
  uint64_t gimbal = 0;                   ///< 0 = fixed to the body, n = on the n-th gimbal
  std::string pattern = "spinning";      ///< "spinning": channels turn about S's up axis, clockwise from above;
                                         ///< "rosette": a narrow field that fills over many scans
  double rate_hz = 10;                   ///< scans a second
  uint64_t channels = 16;                ///< spinning
  uint64_t columns = 625;                ///< spinning: shots of a channel in one scan; rosette: all of its shots / channels
  double low_deg = -45, high_deg = -15;  ///< spinning: elevation of the lowest and highest channel
  double start_deg = 180,
         sweep_deg = 360;                   ///< spinning: azimuth (to the left) of the first column; angle swept
  double field_deg = 70;                    ///< rosette: full opening of the cone
  double min_range = 0.3, max_range = 100;  ///< metres
  double sigma = 0.02;                      ///< metres
  double dropout = 0;                       ///< share of points lost at random
  bool through_panes = false;               ///< clear glass is not seen
  bool motion_distortion = false;           ///< each shot leaves from where the sensor is at its own time

  void Visit(ConfigVisitor& v);
  uint64_t shots() const { return channels * columns; }
  /// InputError naming the first value that makes no sense together with the others.
  void Check() const;
};

struct LidarPoint {
  Vec3f p_S;            ///< metres, in the sensor frame at the time of the scan
  float range = 0;      ///< metres along the shot, with noise
  float intensity = 0;  ///< 0 … 1: reflectance * cosine of the angle of incidence (range already made up for)
  float time = 0;       ///< seconds before the scan's time (<= 0)
  CategoryId category = kVoid;
  EntityId entity = kNoEntity;
  uint32_t shot = 0;  ///< column * channels + channel
};

/// One turn that ends at t_ns. Points are in the order of their shots; shots that met nothing are left out.
struct LidarScan {
  int64_t t_ns = 0;
  RigidTransform X_WS;
  uint32_t shots = 0;
  std::vector<LidarPoint> points;
};

/// Unit direction in S of every shot of the scan number `scan`; see LidarPoint::shot.
std::vector<Vec3f> LidarDirections(const LidarSpec& spec, uint64_t scan);

/// A scan of the surfaces of `tracer` by a sensor at X_BS on a moving body. Packets of 16 shots, in parallel;
/// the same bytes for any number of threads. With motion distortion the points are as the sensor would
/// give them without knowing of its motion: p_S = range * direction.
void ScanLidar(const LidarSpec& spec, const SensorKey& key, const RayTracer& tracer, const Kinematics& body, const RigidTransform& X_BS,
               int64_t t_ns, LidarScan& scan);

}  // namespace airsim360
