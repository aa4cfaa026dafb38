// AirSim's structures as they travel: NED world and FRD body, metres, radians, 4-byte reals, nanoseconds
// (microsoft/AirSim, AirLib/include/api/RpcLibAdaptorsBase.hpp and the multirotor's adaptors list the keys).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "airsim360/rpc/wire/wire_convert.h"

namespace airsim360::airsim {

/// A duration or time-out. AirSim's clients send the largest float, about 3.4e38, for "for ever".
struct Seconds {
  float value = 0;
  operator float() const { return value; }
};
inline void FromWire(const WireValue& value, Seconds& out) {
  out.value = static_cast<float>(RealFromWire(value, static_cast<double>(std::numeric_limits<float>::max())));
}

struct Vector2r {
  float x_val = 0, y_val = 0;
  template <class V>
  void Visit(V& v) {
    v("x_val", x_val), v("y_val", y_val);
  }
};

struct Vector3r {
  float x_val = 0, y_val = 0, z_val = 0;
  template <class V>
  void Visit(V& v) {
    v("x_val", x_val), v("y_val", y_val), v("z_val", z_val);
  }
};

struct Quaternionr {
  float w_val = 1, x_val = 0, y_val = 0, z_val = 0;
  template <class V>
  void Visit(V& v) {
    v("w_val", w_val), v("x_val", x_val), v("y_val", y_val), v("z_val", z_val);
  }
};

struct Pose {
  Vector3r position;
  Quaternionr orientation;
  template <class V>
  void Visit(V& v) {
    v("position", position), v("orientation", orientation);
  }
};

/// Where to put something. A part (position, orientation) of which every number is NaN stays as it is, as in AirSim.
struct PoseChange : Pose {
  bool keeps_position = false, keeps_orientation = false;
};
void FromWire(const WireValue& value, PoseChange& out);

struct GeoPoint {
  double latitude = 0, longitude = 0;  ///< degrees
  float altitude = 0;
  template <class V>
  void Visit(V& v) {
    v("latitude", latitude), v("longitude", longitude), v("altitude", altitude);
  }
};

struct CollisionInfo {
  bool has_collided = false;
  float penetration_depth = 0;
  uint64_t time_stamp = 0;
  Vector3r normal, impact_point, position;
  std::string object_name;
  int object_id = -1;
  template <class V>
  void Visit(V& v) {
    v("has_collided", has_collided), v("penetration_depth", penetration_depth), v("time_stamp", time_stamp);
    v("normal", normal), v("impact_point", impact_point), v("position", position);
    v("object_name", object_name), v("object_id", object_id);
  }
};

struct KinematicsState {
  Vector3r position;
  Quaternionr orientation;
  Vector3r linear_velocity, angular_velocity, linear_acceleration, angular_acceleration;
  template <class V>
  void Visit(V& v) {
    v("position", position), v("orientation", orientation);
    v("linear_velocity", linear_velocity), v("angular_velocity", angular_velocity);
    v("linear_acceleration", linear_acceleration), v("angular_acceleration", angular_acceleration);
  }
};

struct EnvironmentState {
  Vector3r position;
  GeoPoint geo_point;
  Vector3r gravity;
  float air_pressure = 0, temperature = 0, air_density = 0;
  template <class V>
  void Visit(V& v) {
    v("position", position), v("geo_point", geo_point), v("gravity", gravity);
    v("air_pressure", air_pressure), v("temperature", temperature), v("air_density", air_density);
  }
};

struct RCData {
  uint64_t timestamp = 0;
  float pitch = 0, roll = 0, throttle = 0, yaw = 0, left_z = 0, right_z = 0;
  unsigned switches = 0;
  std::string vendor_id;
  bool is_initialized = false, is_valid = false;
  template <class V>
  void Visit(V& v) {
    v("timestamp", timestamp), v("pitch", pitch), v("roll", roll), v("throttle", throttle), v("yaw", yaw);
    v("left_z", left_z), v("right_z", right_z), v("switches", switches), v("vendor_id", vendor_id);
    v("is_initialized", is_initialized), v("is_valid", is_valid);
  }
};

enum class LandedState : int { kLanded = 0, kFlying = 1 };

struct MultirotorState {
  CollisionInfo collision;
  KinematicsState kinematics_estimated;
  GeoPoint gps_location;
  uint64_t timestamp = 0;
  LandedState landed_state = LandedState::kLanded;
  RCData rc_data;
  template <class V>
  void Visit(V& v) {
    v("collision", collision), v("kinematics_estimated", kinematics_estimated), v("gps_location", gps_location);
    v("timestamp", timestamp), v("landed_state", landed_state), v("rc_data", rc_data);
  }
};

struct RotorParameters {
  float thrust = 0, torque_scaler = 0, speed = 0;
  template <class V>
  void Visit(V& v) {
    v("thrust", thrust), v("torque_scaler", torque_scaler), v("speed", speed);
  }
};

struct RotorStates {
  std::vector<RotorParameters> rotors;
  uint64_t timestamp = 0;
  template <class V>
  void Visit(V& v) {
    v("rotors", rotors), v("timestamp", timestamp);
  }
};

enum class DrivetrainType : int { kMaxDegreeOfFreedom = 0, kForwardOnly = 1 };

struct YawMode {
  bool is_rate = true;
  float yaw_or_rate = 0;  ///< degrees, degrees per second
  template <class V>
  void Visit(V& v) {
    v("is_rate", is_rate), v("yaw_or_rate", yaw_or_rate);
  }
};

struct ProjectionMatrix {
  std::array<std::array<float, 4>, 4> matrix{};
  template <class V>
  void Visit(V& v) {
    v("matrix", matrix);
  }
};

struct CameraInfo {
  Pose pose;
  float fov = 0;
  ProjectionMatrix proj_mat;
  template <class V>
  void Visit(V& v) {
    v("pose", pose), v("fov", fov), v("proj_mat", proj_mat);
  }
};

struct Box2D {
  Vector2r min, max;
  template <class V>
  void Visit(V& v) {
    v("min", min), v("max", max);
  }
};

struct Box3D {
  Vector3r min, max;
  template <class V>
  void Visit(V& v) {
    v("min", min), v("max", max);
  }
};

struct DetectionInfo {
  std::string name;
  GeoPoint geo_point;
  Box2D box2D;
  Box3D box3D;
  Pose relative_pose;
  template <class V>
  void Visit(V& v) {
    v("name", name), v("geo_point", geo_point), v("box2D", box2D), v("box3D", box3D);
    v("relative_pose", relative_pose);
  }
};

struct MeshPositionVertexBuffersResponse {
  Vector3r position;
  Quaternionr orientation;
  std::vector<float> vertices;
  std::vector<uint32_t> indices;
  std::string name;
  template <class V>
  void Visit(V& v) {
    v("position", position), v("orientation", orientation), v("vertices", vertices), v("indices", indices);
    v("name", name);
  }
};

}  // namespace airsim360::airsim

namespace airsim360 {
/// Rows of rows.
inline void ToWire(WireWriter& writer, const std::array<std::array<float, 4>, 4>& rows) {
  writer.ArrayHeader(rows.size());
  for (const auto& row : rows) writer.Floats(row);
}
}  // namespace airsim360
