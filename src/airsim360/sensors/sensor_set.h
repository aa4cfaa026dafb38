// All sensors of one vehicle: what they are, their state, and the step that samples those that are due.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "airsim360/base/state_hash.h"
#include "airsim360/sensors/barometer.h"
#include "airsim360/sensors/gimbal.h"
#include "airsim360/sensors/gnss.h"
#include "airsim360/sensors/imu.h"
#include "airsim360/sensors/lidar.h"
#include "airsim360/sensors/magnetometer.h"
#include "airsim360/sensors/range_finder.h"
#include "airsim360/sensors/rig.h"

namespace airsim360 {

/// A sensor with the name that users ask for it by; unique among its kind.
template <class Spec>
struct Named {
  std::string name;
  Spec spec;
};

/// An ordinary or panoramic camera.
struct CameraSpec : PictureSettings {
  std::string projection = "erp";  ///< erp, pinhole or fisheye
  Mount mount = {};                ///< the camera looks along S's forward axis, S's up is up in the picture
  uint64_t gimbal = 0;             ///< 0 = fixed to the body, n = on the n-th gimbal
  uint64_t width = 1024, height = 512;
  double fov_deg = 90;  ///< pinhole: across the width; fisheye: across the shorter side
  double rate_hz = 10;

  void Visit(ConfigVisitor& v);
  /// The rig of an unturned gimbal; InputError naming the value that makes no sense.
  PanoramicRig Rig() const;
};

struct SensorSet {
  std::vector<Named<GimbalSpec>> gimbals;
  std::vector<Named<ImuSpec>> imus;
  std::vector<Named<GnssSpec>> gnss;
  std::vector<Named<BarometerSpec>> barometers;
  std::vector<Named<MagnetometerSpec>> magnetometers;
  std::vector<Named<RangeFinderSpec>> range_finders;
  std::vector<Named<LidarSpec>> lidars;
  std::vector<Named<CameraSpec>> cameras;

  /// One imu, gnss, barometer and magnetometer at the centre of mass, named by their kind, and a panoramic
  /// camera "panorama".
  static SensorSet Standard();
  void Visit(ConfigVisitor& v);
  /// InputError for a name that is empty or given twice, a gimbal that does not exist, or a spec that makes
  /// no sense; `where` starts the message.
  void Check(std::string_view where) const;
};

/// A sensor file, over a set that has what it does not name; see docs/reference/sensors.md. InputError naming
/// file:line.
SensorSet ReadSensorSet(const std::filesystem::path& file, SensorSet base = SensorSet::Standard());

/// States of the sensors that the step samples, in the order of the set. Ray sensors and cameras have none:
/// they are functions of a snapshot.
struct SensorStates {
  std::vector<GimbalState> gimbals;
  std::vector<ImuState> imus;
  std::vector<GnssState> gnss;
  std::vector<BarometerState> barometers;
  std::vector<MagnetometerState> magnetometers;
};

/// What surrounds all sensors of a world.
struct SensorWorld {
  GeoFrame frame{{47.641468, -122.140165, 122}};  ///< place of W's origin; default: AirSim's home
  double sea_level_pressure = 101325;             ///< Pa
  MagneticField field;
  uint64_t seed = 0;
};

/// At the start of a run: gimbals in place, biases drawn, no readings yet.
SensorStates StartSensors(const SensorSet& set, const SensorWorld& world, uint32_t vehicle, const BodyMotion& motion);

/// Moves gimbals and samples every sensor that is due in the step of dt that ends at t, from the exact motion
/// at its end. Random numbers depend on (seed, vehicle, sensor, t) alone.
void StepSensors(const SensorSet& set, const SensorWorld& world, uint32_t vehicle, const BodyMotion& motion, int64_t t_ns, int64_t dt_ns,
                 SensorStates& states);

/// Adds every number of the states.
void HashSensors(const SensorStates& states, StateHasher& hasher);

/// Key of the i-th sensor of a kind: kinds have numbers of their own, so that adding one sensor leaves the
/// noise of others as it is.
SensorKey KeyOf(const SensorWorld& world, uint32_t vehicle, std::string_view kind, size_t i);

/// X_BS of a sensor on gimbal `gimbal` (0 = none) now.
RigidTransform MountPose(const SensorSet& set, const SensorStates& states, const RigidTransform& X_BS, uint64_t gimbal);

}  // namespace airsim360
