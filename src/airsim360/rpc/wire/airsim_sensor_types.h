// AirSim's sensor readings as they travel (see airsim_types.h).
#pragma once

#include "airsim360/rpc/wire/airsim_types.h"

namespace airsim360::airsim {

struct ImuData {
  uint64_t time_stamp = 0;
  Quaternionr orientation;
  Vector3r angular_velocity, linear_acceleration;
  template <class V>
  void Visit(V& v) {
    v("time_stamp", time_stamp), v("orientation", orientation), v("angular_velocity", angular_velocity);
    v("linear_acceleration", linear_acceleration);
  }
};

struct BarometerData {
  uint64_t time_stamp = 0;
  float altitude = 0, pressure = 0, qnh = 0;  ///< m, Pa, hPa
  template <class V>
  void Visit(V& v) {
    v("time_stamp", time_stamp), v("altitude", altitude), v("pressure", pressure), v("qnh", qnh);
  }
};

struct MagnetometerData {
  uint64_t time_stamp = 0;
  Vector3r magnetic_field_body;  ///< gauss
  std::vector<float> magnetic_field_covariance;
  template <class V>
  void Visit(V& v) {
    v("time_stamp", time_stamp), v("magnetic_field_body", magnetic_field_body);
    v("magnetic_field_covariance", magnetic_field_covariance);
  }
};

struct GnssReport {
  GeoPoint geo_point;
  float eph = 0, epv = 0;
  Vector3r velocity;
  int fix_type = 0;  ///< 0 none, 1 time only, 2 two, 3 three dimensions
  uint64_t time_utc = 0;
  template <class V>
  void Visit(V& v) {
    v("geo_point", geo_point), v("eph", eph), v("epv", epv), v("velocity", velocity), v("fix_type", fix_type);
    v("time_utc", time_utc);
  }
};

struct GpsData {
  uint64_t time_stamp = 0;
  GnssReport gnss;
  bool is_valid = false;
  template <class V>
  void Visit(V& v) {
    v("time_stamp", time_stamp), v("gnss", gnss), v("is_valid", is_valid);
  }
};

struct DistanceSensorData {
  uint64_t time_stamp = 0;
  float distance = 0, min_distance = 0, max_distance = 0;
  Pose relative_pose;
  template <class V>
  void Visit(V& v) {
    v("time_stamp", time_stamp), v("distance", distance), v("min_distance", min_distance);
    v("max_distance", max_distance), v("relative_pose", relative_pose);
  }
};

struct LidarData {
  uint64_t time_stamp = 0;
  std::vector<float> point_cloud;  ///< x, y, z, x, y, z, …
  Pose pose;
  std::vector<int> segmentation;
  template <class V>
  void Visit(V& v) {
    v("time_stamp", time_stamp), v("point_cloud", point_cloud), v("pose", pose), v("segmentation", segmentation);
  }
};

/// Cosys-AirSim's; each point is x, y, z, segmentation colour as one number, intensity.
struct GpuLidarData {
  uint64_t time_stamp = 0;
  std::vector<float> point_cloud;
  Pose pose;
  template <class V>
  void Visit(V& v) {
    v("time_stamp", time_stamp), v("point_cloud", point_cloud), v("pose", pose);
  }
};

}  // namespace airsim360::airsim
