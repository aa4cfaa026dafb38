#include "airsim360/rpc/settings/settings.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/file_name.h"
#include "airsim360/math/coordinate_limit.h"
#include "airsim360/rpc/settings/settings_reader.h"
#include "airsim360/rpc/settings/time_of_day.h"

namespace airsim360 {
namespace {

using internal::SettingsObject;

constexpr double kFar = kCoordinateLimit;
constexpr double kCosysSettingsVersion = 2;
constexpr int kLargestSide = 8192;

void ReadPose(SettingsObject& object, SettingsPose& pose) {
  object.Read("X", pose.x, -kFar, kFar), object.Read("Y", pose.y, -kFar, kFar), object.Read("Z", pose.z, -kFar, kFar);
  object.Read("Roll", pose.roll, -360, 360), object.Read("Pitch", pose.pitch, -360, 360);
  object.Read("Yaw", pose.yaw, -360, 360);
}

airsim::ImageType ReadImageType(SettingsObject& object) {
  int type = 0;
  object.Read("ImageType", type, -1, static_cast<int>(airsim::ImageType::kCount) - 1);
  return static_cast<airsim::ImageType>(std::max(type, 0));
}

// CaptureSettings: a list with one entry for each image type.
std::map<airsim::ImageType, CaptureSettings> ReadCaptures(SettingsObject& parent) {
  static constexpr const char* kLight[] = {"AutoExposureSpeed",
                                           "AutoExposureBias",
                                           "AutoExposureMaxBrightness",
                                           "AutoExposureMinBrightness",
                                           "AutoExposureLowPercent",
                                           "AutoExposureHighPercent",
                                           "AutoExposureMethod",
                                           "AutoExposureHistogramLogMin",
                                           "AutoExposureHistogramLogMax",
                                           "MotionBlurAmount",
                                           "TargetGamma",
                                           "ProjectionMode",
                                           "OrthoWidth"};
  std::map<airsim::ImageType, CaptureSettings> captures;
  const JsonNode* list = parent.Take("CaptureSettings");
  if (list == nullptr) return captures;
  if (list->kind != JsonNode::Kind::kArray) parent.Fail(*list, "CaptureSettings: expected a list in brackets");
  for (const JsonNode& item : list->items) {
    SettingsObject object(item, parent.file(), parent.notices());
    CaptureSettings& capture = captures[ReadImageType(object)];
    object.Read("Width", capture.width, 1, kLargestSide);
    object.Read("Height", capture.height, 1, kLargestSide);
    object.Read("FOV_Degrees", capture.fov_degrees, 0.1, 179);
    object.Ignore(kLight);
    object.Finish();
  }
  return captures;
}

CameraSettings ReadCamera(const JsonNode& node, SettingsObject& parent) {
  static constexpr const char* kOther[] = {"NoiseSettings", "Gimbal", "UnrealEngine"};
  SettingsObject object(node, parent.file(), parent.notices());
  CameraSettings camera;
  ReadPose(object, camera.pose);
  camera.captures = ReadCaptures(object);
  object.Ignore(kOther);
  object.Finish();
  return camera;
}

// Of a type that there is not here everything is read and left.
SensorType ReadSensorType(SettingsObject& object) {
  static constexpr const char* kHere = "1 barometer, 2 imu, 3 gps, 4 magnetometer, 5 distance, 6 lidar, 8 GPU lidar";
  int type = 0;
  object.Read("SensorType", type, 0, 1000);
  if (type == 0) object.Fail(object.node(), std::string("SensorType: missing or 0; there are ") + kHere);
  const bool known = type <= static_cast<int>(SensorType::kLidar) || type == static_cast<int>(SensorType::kGpuLidar);
  if (known) return static_cast<SensorType>(type);
  object.notices().push_back(std::string(object.file()) + ":" + std::to_string(object.node().line) +
                             ": SensorType: there are no sensors of type " + std::to_string(type) +
                             " here, and so not this one (there are " + kHere + ")");
  object.IgnoreTheRest();
  return SensorType::kNone;
}

// Cosys-AirSim's noise of ranges.
void ReadNoise(SettingsObject& object, SensorSettings& sensor) {
  bool noise = false;
  double sigma = 0, scale = 1;
  object.Read("GenerateNoise", noise);
  object.Read("MinNoiseStandardDeviation", sigma, 0, 100);
  object.Read("NoiseDistanceScale", scale, 0, 1000);
  const bool lidar = sensor.type == SensorType::kLidar || sensor.type == SensorType::kGpuLidar;
  if (noise && lidar) {
    sensor.noise_sigma = sigma, sensor.noise_scale = scale;
  } else if (noise) {
    static constexpr const char* kNoise[] = {"GenerateNoise", "MinNoiseStandardDeviation", "NoiseDistanceScale"};
    object.Ignore(kNoise);
  }
}

// Keys of sensors that change nothing here: of drawing, and of noise models that other keys stand for.
constexpr const char* kOtherSensorKeys[] = {"DrawDebugPoints",
                                            "DrawSensor",
                                            "DrawMode",
                                            "External",
                                            "ExternalLocal",
                                            "LimitPoints",
                                            "Resolution",
                                            "IgnoreMarked",
                                            "GroundTruth",
                                            "InstanceSegmentation",
                                            "Annotation",
                                            "GenerateIntensity",
                                            "rangeMaxLambertianPercentage",
                                            "rainMaxIntensity",
                                            "rainConstantA",
                                            "rainConstantB",
                                            "ExternalController",
                                            "UpdateLatency",
                                            "UpdateFrequency",
                                            "StartupDelay",
                                            "AngularRandomWalk",
                                            "GyroBiasStabilityTau",
                                            "GyroBiasStability",
                                            "VelocityRandomWalk",
                                            "AccelBiasStabilityTau",
                                            "AccelBiasStability",
                                            "EphTimeConstant",
                                            "EpvTimeConstant",
                                            "EphInitial",
                                            "EpvInitial",
                                            "EphFinal",
                                            "EpvFinal",
                                            "EphMin3d",
                                            "EphMin2d",
                                            "PressureFactorSigma",
                                            "PressureFactorTau",
                                            "UncorrelatedNoiseSigma",
                                            "NoiseSigma",
                                            "NoiseBias",
                                            "ScaleFactor"};

SensorSettings ReadSensor(const JsonNode& node, SettingsObject& parent) {
  SettingsObject object(node, parent.file(), parent.notices());
  SensorSettings sensor;
  sensor.type = ReadSensorType(object);
  if (sensor.type == SensorType::kNone) return sensor;
  object.Read("Enabled", sensor.enabled);
  ReadPose(object, sensor.pose);
  if (sensor.type == SensorType::kGpuLidar) sensor.channels = 64, sensor.measurements_per_cycle = 2048, sensor.range = 50;
  object.Read("MinDistance", sensor.min_distance, 0, kFar), object.Read("MaxDistance", sensor.max_distance, 0.01, kFar);
  object.Read("NumberOfChannels", sensor.channels, 1, 1024), object.Read("Range", sensor.range, 0.01, kFar);
  object.Read("PointsPerSecond", sensor.points_per_second, 1, 1e7);
  object.Read("MeasurementsPerCycle", sensor.measurements_per_cycle, 1, 36000);
  ReadNoise(object, sensor);
  object.Read("RotationsPerSecond", sensor.rotations_per_second, 0.1, 1000);
  object.Read("HorizontalFOVStart", sensor.horizontal_fov_start, -360, 360);
  object.Read("HorizontalFOVEnd", sensor.horizontal_fov_end, -360, 360);
  object.Read("VerticalFOVUpper", sensor.vertical_fov_upper, -90, 90);
  object.Read("VerticalFOVLower", sensor.vertical_fov_lower, -90, 90);
  std::string frame = "VehicleInertialFrame";
  object.Read("DataFrame", frame);
  sensor.sensor_local_frame = frame == "SensorLocalFrame";
  object.Ignore(kOtherSensorKeys);
  object.Finish();
  return sensor;
}

// An object whose members are things with names of the user's choice.
template <class T, class ReadOne>
std::map<std::string, T> ReadNamed(SettingsObject& parent, const char* key, const ReadOne& read_one) {
  std::map<std::string, T> named;
  if (const JsonNode* node = parent.TakeObject(key)) {
    for (size_t i = 0; i < node->keys.size(); ++i) {
      // Recordings name pictures after vehicles and cameras.
      // A camera may have no name, as the default one of AirSim.
      const bool names_files = std::is_same_v<T, VehicleSettings> || (!std::is_same_v<T, SensorSettings> && !node->keys[i].empty());
      try {
        if (names_files) CheckFileName(key, node->keys[i]);
      } catch (const InputError& error) {
        parent.Fail(node->items[i], error.what());
      }
      named[node->keys[i]] = read_one(node->items[i], parent);
    }
  }
  return named;
}

constexpr const char* kPx4 = "PX4Multirotor";
// What such a vehicle says of its autopilot and of the links to it (docs/px4_setup.md there).
constexpr const char* kOfPx4[] = {
    "ControlIp",         "ControlPort",   "ControlPortLocal", "ControlPortRemote", "LocalHostIp", "LogViewerHostIp", "LogViewerPort",
    "LogViewerSendPort", "Logs",          "ParamFile",        "QgcHostIp",         "QgcPort",     "SerialBaudRate",  "SerialPort",
    "SimSysID",          "SimCompID",     "SitlIp",           "SitlPort",          "TcpPort",     "UdpIp",           "UdpPort",
    "VehicleSysID",      "VehicleCompID", "OffboardSysID",    "OffboardCompID",    "AirSimSysID", "AirSimCompID"};

VehicleSettings ReadVehicle(const JsonNode& node, SettingsObject& parent) {
  static const std::vector<std::string> kTypes = {"SimpleFlight", "ComputerVision", kPx4};
  static constexpr const char* kOther[] = {"RC",
                                           "EnableTrace",
                                           "EnableCollisionPassthrogh",
                                           "EnableCollisionPassthrough",
                                           "IsFpvVehicle",
                                           "PawnPath",
                                           "Model",
                                           "Parameters",
                                           "LockStep",
                                           "UseSerial",
                                           "UseTcp"};
  SettingsObject object(node, parent.file(), parent.notices());
  VehicleSettings vehicle;
  object.Read("VehicleType", vehicle.type);
  // As AirSim: in capitals or not.
  const auto type = std::find_if(kTypes.begin(), kTypes.end(), [&](const std::string& name) {
    return std::equal(name.begin(), name.end(), vehicle.type.begin(), vehicle.type.end(),
                      [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
  });
  if (type == kTypes.end()) {
    object.Fail(node, "VehicleType: " + UnknownChoiceMessage("vehicle type", vehicle.type, kTypes));
  }
  vehicle.type = *type;
  if (vehicle.type == kPx4) {
    object.notices().push_back(std::string(object.file()) + ":" + std::to_string(node.line) +
                               ": VehicleType: there is no PX4 here: the built-in SimpleFlight flies this vehicle");
    vehicle.type = kTypes[0];
    object.Ignore(kOfPx4);
  }
  std::string state = "Armed";
  object.Read("DefaultVehicleState", state);
  vehicle.armed = state == "Armed";
  object.Read("AutoCreate", vehicle.auto_create);
  object.Read("AllowAPIAlways", vehicle.allow_api_always);
  object.Read("EnableCollisions", vehicle.enable_collisions);
  ReadPose(object, vehicle.pose);
  vehicle.cameras = ReadNamed<CameraSettings>(object, "Cameras", ReadCamera);
  vehicle.sensors = ReadNamed<SensorSettings>(object, "Sensors", ReadSensor);
  object.Ignore(kOther);
  object.Finish();
  return vehicle;
}

void ReadRecordingCameras(SettingsObject& object, RecordingSettings& recording) {
  const JsonNode* list = object.Take("Cameras");
  if (list == nullptr || list->kind != JsonNode::Kind::kArray) return;
  for (const JsonNode& item : list->items) {
    SettingsObject entry(item, object.file(), object.notices());
    RecordingSettings::Camera camera;
    if (const JsonNode* name = entry.Take("CameraName")) {
      int number = 0;
      const bool is_number = name->kind == JsonNode::Kind::kNumber;
      if (is_number) entry.Read("CameraName", number, 0, 1000);
      camera.camera = is_number ? std::to_string(number) : name->text;
    }
    camera.type = ReadImageType(entry);
    entry.Read("PixelsAsFloat", camera.pixels_as_float), entry.Read("Compress", camera.compress);
    entry.Read("VehicleName", camera.vehicle);
    static constexpr const char* kOther[] = {"Annotation"};
    entry.Ignore(kOther);
    entry.Finish();
    recording.cameras.push_back(camera);
  }
}

void ReadRecording(SettingsObject& parent, RecordingSettings& recording) {
  const JsonNode* node = parent.TakeObject("Recording");
  if (node == nullptr) return;
  SettingsObject object(*node, parent.file(), parent.notices());
  object.Read("RecordOnMove", recording.record_on_move), object.Read("Enabled", recording.enabled);
  object.Read("RecordInterval", recording.interval, 0.001, 1e6);
  std::string folder;
  object.Read("Folder", folder);
  if (folder.find('\0') != std::string::npos) object.Fail(*object.Take("Folder"), "Folder: holds a NUL character");
  recording.folder = folder;
  ReadRecordingCameras(object, recording);
  object.Finish();
}

// Wind, origin, time of day, segmentation, our own options.
void ReadWorld(SettingsObject& root, AirSimSettings& settings) {
  if (const JsonNode* node = root.TakeObject("Wind")) {
    SettingsObject wind(*node, root.file(), root.notices());
    double v[3] = {};
    wind.Read("X", v[0], -200, 200), wind.Read("Y", v[1], -200, 200), wind.Read("Z", v[2], -200, 200);
    settings.wind = {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
    wind.Finish();
  }
  if (const JsonNode* node = root.TakeObject("OriginGeopoint")) {
    SettingsObject origin(*node, root.file(), root.notices());
    double altitude = settings.origin.altitude;
    origin.Read("Latitude", settings.origin.latitude, -90, 90);
    origin.Read("Longitude", settings.origin.longitude, -180, 180);
    origin.Read("Altitude", altitude, -1000, 20000);
    settings.origin.altitude = static_cast<float>(altitude);
    origin.Finish();
  }
  if (const JsonNode* node = root.TakeObject("SegmentationSettings")) {
    static constexpr const char* kOther[] = {"MeshNamingMethod", "OverrideExisting"};
    SettingsObject segmentation(*node, root.file(), root.notices());
    segmentation.Read("InitMethod", settings.segmentation_init);
    segmentation.Ignore(kOther);
    segmentation.Finish();
  }
  if (const JsonNode* node = root.TakeObject("TimeOfDay")) {
    static constexpr const char* kOther[] = {"StartDateTimeDst", "CelestialClockSpeed", "UpdateIntervalSecs", "MoveSun"};
    SettingsObject time(*node, root.file(), root.notices());
    bool enabled = false;
    std::string start;
    time.Read("Enabled", enabled), time.Read("StartDateTime", start);
    try {
      Environment checked;
      SetTimeOfDay(start, settings.origin, checked);
    } catch (const std::invalid_argument& error) {
      time.Fail(*node, "StartDateTime: " + std::string(error.what()));
    }
    if (enabled) settings.time_of_day = start;
    time.Ignore(kOther);
    time.Finish();
  }
  if (const JsonNode* node = root.TakeObject("AirSim360")) {
    SettingsObject own(*node, root.file(), root.notices());
    own.Read("CollisionInState", settings.collision_in_state), own.Read("Float32Depth", settings.float32_depth);
    own.Read("WrapYaw", settings.wrap_yaw), own.Read("SlowDownAtEndOfPath", settings.slow_down);
    own.Read("DepthInCentimetres", settings.depth_in_centimetres);
    own.Finish();
  }
}

void ReadMode(SettingsObject& root, AirSimSettings& settings) {
  static const std::vector<std::string> kModes = {"Multirotor", "ComputerVision"};
  double version = 1.2;
  root.Read("SettingsVersion", version, 0, 100);
  settings.cosys = version >= kCosysSettingsVersion;
  root.Read("SimMode", settings.sim_mode);
  if (settings.sim_mode.empty()) settings.sim_mode = kModes[0];
  if (std::find(kModes.begin(), kModes.end(), settings.sim_mode) == kModes.end()) {
    root.Fail(*root.node().Find("SimMode"), "SimMode: " + UnknownChoiceMessage("mode", settings.sim_mode, kModes));
  }
  root.Read("ClockSpeed", settings.clock_speed, 0.001, 1000);
  root.Read("LocalHostIp", settings.local_host_ip);
  root.Read("ApiServerPort", settings.port, 0, 65535);
}

}  // namespace

AirSimSettings ParseSettings(std::string_view text, std::string_view name) {
  static constexpr const char* kOther[] = {"SeeDocsAt",          "ClockType",         "ViewMode",
                                           "SubWindows",         "CameraDirector",    "PawnPaths",
                                           "PhysicsEngineName",  "SpeedUnitFactor",   "SpeedUnitLabel",
                                           "LogMessagesVisible", "ShowLosDebugLines", "RpcEnabled",
                                           "EngineSound",        "PhysicsPeriod",     "RC",
                                           "EnableTrace",        "Weather",           "InitialInstanceSegmentation"};
  AirSimSettings settings;
  settings.text = text;
  const JsonNode node = ParseJson(text, name);
  SettingsObject root(node, name, settings.notices);
  ReadMode(root, settings);
  ReadWorld(root, settings);
  ReadRecording(root, settings.recording);
  if (const JsonNode* defaults = root.TakeObject("CameraDefaults")) {
    settings.camera_defaults = ReadCamera(*defaults, root).captures;
  }
  settings.default_sensors = ReadNamed<SensorSettings>(root, "DefaultSensors", ReadSensor);
  settings.vehicles = ReadNamed<VehicleSettings>(root, "Vehicles", ReadVehicle);
  settings.external_cameras = ReadNamed<CameraSettings>(root, "ExternalCameras", ReadCamera);
  root.Ignore(kOther);
  root.Finish();
  if (settings.vehicles.empty()) settings.vehicles["SimpleFlight"] = {};
  if (settings.sim_mode == "ComputerVision") {
    for (auto& [vehicle_name, vehicle] : settings.vehicles) vehicle.type = "ComputerVision";
  }
  return settings;
}

AirSimSettings ReadSettings(const std::filesystem::path& file) {
  return ParseSettings(ReadTextFile(file, size_t{16} << 20), file.string());
}

AirSimSettings DefaultSettings() { return ParseSettings("{}", "settings"); }

CaptureSettings CaptureOf(const AirSimSettings& settings, const CameraSettings& camera, airsim::ImageType type) {
  if (const auto own = camera.captures.find(type); own != camera.captures.end()) return own->second;
  if (const auto common = settings.camera_defaults.find(type); common != settings.camera_defaults.end()) {
    return common->second;
  }
  return {};
}

}  // namespace airsim360
