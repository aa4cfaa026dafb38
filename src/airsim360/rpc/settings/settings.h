// AirSim's settings.json (microsoft/AirSim, docs/settings.md): what of it this server honours, with AirSim's
// defaults. Places are NED metres, angles degrees, as in the file.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/rpc/wire/airsim_image_types.h"

namespace airsim360 {

/// A place and attitude of the file: roll, pitch and yaw in AirSim's senses. NaN = not given.
struct SettingsPose {
  double x = kNotGiven, y = kNotGiven, z = kNotGiven, roll = kNotGiven, pitch = kNotGiven, yaw = kNotGiven;
  static constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();
};

struct CaptureSettings {
  int width = 256, height = 144;
  double fov_degrees = 90;  ///< across the width
};

struct CameraSettings {
  SettingsPose pose;
  std::map<airsim::ImageType, CaptureSettings> captures;  ///< types not named have the defaults
};

/// kNone: a type that there is not here, read with a notice.
enum class SensorType {
  kNone,
  kBarometer,
  kImu,
  kGps,
  kMagnetometer,
  kDistance,
  kLidar,
  kGpuLidar = 8  ///< Cosys-AirSim's; a lidar like the others here
};

struct SensorSettings {
  SensorType type = SensorType::kImu;
  bool enabled = true;
  SettingsPose pose;
  // Distance.
  double min_distance = 0.2, max_distance = 40;
  // Lidar.
  int channels = 16;
  int measurements_per_cycle = 0;  ///< shots of a channel in one turn; 0 = by points_per_second
  double range = 100, rotations_per_second = 10;
  double points_per_second = SettingsPose::kNotGiven;  ///< of all channels; 100,000 in AirSim
  double noise_sigma = 0;                              ///< metres at the lidar
  double noise_scale = 1;                              ///< times that at `range`
  double horizontal_fov_start = 0, horizontal_fov_end = 359;
  double vertical_fov_upper = -15, vertical_fov_lower = -45;
  bool sensor_local_frame = false;
};

struct VehicleSettings {
  std::string type = "SimpleFlight";
  bool auto_create = true, allow_api_always = true, enable_collisions = true;
  bool armed = true;  ///< DefaultVehicleState
  SettingsPose pose;  ///< in the global NED frame
  std::map<std::string, CameraSettings> cameras;
  std::map<std::string, SensorSettings> sensors;  ///< instead of the default ones, where there are any
};

struct RecordingSettings {
  struct Camera {
    std::string vehicle, camera = "0";
    airsim::ImageType type = airsim::ImageType::kScene;
    bool pixels_as_float = false, compress = true;
  };
  bool enabled = false, record_on_move = false;
  double interval = 0.05;  ///< seconds
  std::filesystem::path folder;
  std::vector<Camera> cameras;
};

struct AirSimSettings {
  std::string text = "{}";  ///< of the file, for getSettingsString
  std::string sim_mode = "Multirotor";
  bool cosys = false;  ///< SettingsVersion 2 or more: clients are Cosys-AirSim's (server version 4, R, G, B)
  double clock_speed = 1;
  std::string local_host_ip = "127.0.0.1";
  int port = 41451;
  bool collision_in_state = false;    ///< ours: getMultirotorState fills `collision`
  bool float32_depth = false;         ///< ours: depth is not rounded to half precision
  bool wrap_yaw = false;              ///< ours: rotateToYaw measures the way round the circle
  bool slow_down = false;             ///< ours: paths end at a walking pace
  bool depth_in_centimetres = false;  ///< ours: 8-bit panorama_depth is centimetres in every channel
  airsim::Vector3r wind;              ///< NED, m/s
  airsim::GeoPoint origin{47.641468, -122.140165, 122};
  std::string segmentation_init = "CommonObjectsRandomIDs";
  std::string time_of_day;  ///< StartDateTime where enabled, else ""
  std::map<airsim::ImageType, CaptureSettings> camera_defaults;
  std::map<std::string, SensorSettings> default_sensors;
  std::map<std::string, VehicleSettings> vehicles;  ///< one "SimpleFlight" where the file names none
  std::map<std::string, CameraSettings> external_cameras;
  RecordingSettings recording;
  std::vector<std::string> notices;  ///< what the file says that is not known or not done here, with its line
};

/// The settings of a text; `name` stands for the file in messages. InputError "name:line: …" for what is no
/// JSON, values of the wrong kind or out of range, and modes, vehicle and sensor types that there are not.
AirSimSettings ParseSettings(std::string_view text, std::string_view name);
AirSimSettings ReadSettings(const std::filesystem::path& file);
/// One drone named SimpleFlight.
AirSimSettings DefaultSettings();

/// Size and field of view of a camera's images of one type.
CaptureSettings CaptureOf(const AirSimSettings& settings, const CameraSettings& camera, airsim::ImageType type);

}  // namespace airsim360
