#include "airsim360/rpc/settings/settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/rpc/session/airsim_drone.h"

namespace airsim360 {
namespace {

std::string ErrorOf(std::string_view text) {
  try {
    ParseSettings(text, "settings.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Settings, NothingSaidGivesAirSimsDefaults) {
  const AirSimSettings settings = ParseSettings("{}", "settings.json");
  EXPECT_EQ(settings.port, 41451);
  EXPECT_EQ(settings.local_host_ip, "127.0.0.1");
  ASSERT_EQ(settings.vehicles.size(), 1u);
  EXPECT_EQ(settings.vehicles.begin()->second.type, "SimpleFlight");
  EXPECT_DOUBLE_EQ(settings.origin.latitude, 47.641468);
  const CaptureSettings capture = CaptureOf(settings, {}, airsim::ImageType::kScene);
  EXPECT_EQ(capture.width, 256);
  EXPECT_EQ(capture.height, 144);
  EXPECT_DOUBLE_EQ(capture.fov_degrees, 90);
}

TEST(Settings, VehiclesCamerasSensorsAreRead) {
  const AirSimSettings settings = ParseSettings(R"({
    "SettingsVersion": 1.2, "SimMode": "Multirotor", "ClockSpeed": 2.5,
    "CameraDefaults": {"CaptureSettings": [{"ImageType": 1, "Width": 640, "Height": 480, "FOV_Degrees": 100}]},
    "Vehicles": {
      "Drone1": {"VehicleType": "simpleflight", "X": 4, "Y": -2, "Yaw": 90,
        "Cameras": {"high": {"CaptureSettings": [{"ImageType": 0, "Width": 800, "Height": 600}], "X": 0.5, "Pitch": -45}},
        "Sensors": {"Lidar1": {"SensorType": 6, "Range": 50, "DataFrame": "SensorLocalFrame"}}},
      "Drone2": {"VehicleType": "SimpleFlight", "DefaultVehicleState": "Disarmed"}},
    "Recording": {"RecordInterval": 0.1, "Cameras": [{"CameraName": "0", "ImageType": 3, "PixelsAsFloat": true, "VehicleName": "Drone1"}]},
    "OriginGeopoint": {"Latitude": 10, "Longitude": 20, "Altitude": 30}, "Wind": {"X": 1, "Y": 2, "Z": 3},
    "AirSim360": {"WrapYaw": true}
  })",
                                                "settings.json");
  EXPECT_TRUE(settings.notices.empty()) << settings.notices[0];
  const VehicleSettings& drone = settings.vehicles.at("Drone1");
  EXPECT_EQ(drone.pose.x, 4);
  EXPECT_TRUE(std::isnan(drone.pose.z));
  const CameraSettings& camera = drone.cameras.at("high");
  EXPECT_EQ(CaptureOf(settings, camera, airsim::ImageType::kScene).width, 800);
  EXPECT_EQ(CaptureOf(settings, camera, airsim::ImageType::kDepthPlanar).width, 640);
  EXPECT_EQ(camera.pose.pitch, -45);
  EXPECT_TRUE(drone.sensors.at("Lidar1").sensor_local_frame);
  EXPECT_FALSE(settings.vehicles.at("Drone2").armed);
  EXPECT_TRUE(drone.armed);
  EXPECT_EQ(settings.recording.cameras.at(0).vehicle, "Drone1");
  EXPECT_EQ(settings.wind.z_val, 3);
  EXPECT_TRUE(settings.wrap_yaw);
}

TEST(Settings, ErrorsNameFileLineAndKey) {
  EXPECT_EQ(ErrorOf("{\n\"ClockSpeed\": \"fast\"}"), "settings.json:2: ClockSpeed: expected a number");
  EXPECT_EQ(ErrorOf("{\n\n\"SimMode\": \"Multirotr\"}"),
            "settings.json:3: SimMode: unknown mode 'Multirotr'; did you mean 'Multirotor'? (choices: "
            "Multirotor, ComputerVision)");
  EXPECT_NE(ErrorOf("{\"Vehicles\": {\n\"A\": {\"VehicleType\": \"px4\"}}}").find("settings.json:2: VehicleType"), std::string::npos);
  EXPECT_EQ(ErrorOf("{\"Vehicles\": {\n\"../../evil\": {\"VehicleType\": \"SimpleFlight\"}}}"),
            "settings.json:2: Vehicles: '../../evil' holds a '/': it becomes the name of a file");
  EXPECT_NE(ErrorOf("{\"ExternalCameras\": {\"a\\u0000b\": {}}}").find("control character"), std::string::npos);
  EXPECT_NE(ErrorOf("{\"Vehicles\": {\n\"\": {\"VehicleType\": \"SimpleFlight\"}}}").find("settings.json:2: Vehicles: ''"),
            std::string::npos);
  EXPECT_EQ(ErrorOf("{\n\"ApiServerPort\": 70000}"), "settings.json:2: ApiServerPort: 70000 is not in 0 … 65535");
  EXPECT_NE(ErrorOf("{\"TimeOfDay\":\n{\"Enabled\": true, \"StartDateTime\": \"2026-02-30 10:00:00\"}}")
                .find("settings.json:2: StartDateTime: start_datetime '2026-02-30 10:00:00'"),
            std::string::npos);
  EXPECT_EQ(ErrorOf("{\"ClockSpeed\": 1,\n}"), "settings.json:2: expected a key in quotation marks");
  EXPECT_EQ(ErrorOf("{\"ClockSpeed\": 1"), "settings.json:1: the text ends too early");
  EXPECT_NE(ErrorOf("{\"CameraDefaults\": {\"CaptureSettings\": [\n{\"Width\": 0}]}}").find("settings.json:2: Width"), std::string::npos);
  EXPECT_NE(ErrorOf("{\"a\": tru}").find("expected a value"), std::string::npos);
  EXPECT_NE(ErrorOf("{} {}").find("follows the end"), std::string::npos);
  EXPECT_NE(ErrorOf(std::string(200, '[')).find("too deeply"), std::string::npos);
}

// Whether one notice says all of it.
bool Noticed(const AirSimSettings& settings, std::initializer_list<std::string_view> texts) {
  return std::ranges::any_of(settings.notices, [&](const std::string& notice) {
    return std::ranges::all_of(texts, [&](std::string_view text) { return notice.find(text) != std::string::npos; });
  });
}

TEST(Settings, LidarsOfCosysAirSimHaveTheResolutionThatTheyAskFor) {
  const AirSimSettings settings = ParseSettings(R"({"SettingsVersion": 2.0, "Vehicles": {"A": {"VehicleType": "SimpleFlight", "Sensors": {
    "a": {"SensorType": 6, "MeasurementsPerCycle": 300, "NumberOfChannels": 4},
    "b": {"SensorType": 6, "PointsPerSecond": 12000, "RotationsPerSecond": 10, "NumberOfChannels": 4},
    "c": {"SensorType": 6},
    "gpu": {"SensorType": 8, "MeasurementsPerCycle": 512, "NumberOfChannels": 32, "Range": 50,
            "GenerateNoise": true, "MinNoiseStandardDeviation": 0.02, "NoiseDistanceScale": 3},
    "gpu2": {"SensorType": 8}}}}})",
                                                "settings.json");
  EXPECT_TRUE(settings.notices.empty()) << settings.notices[0];
  const RaySensors sensors = MakeRaySensors(settings, settings.vehicles.at("A"));
  ASSERT_EQ(sensors.lidars.size(), 5u);
  const auto lidar = [&](const char* name) { return *std::ranges::find(sensors.lidars, name, &RaySensors::Lidar::name); };
  EXPECT_EQ(lidar("a").spec.columns, 300u);
  EXPECT_EQ(lidar("b").spec.columns, 300u);  // 12000 / 10 / 4
  EXPECT_EQ(lidar("c").spec.columns, 512u);  // there, where AirSim's has 625
  EXPECT_EQ(lidar("gpu").spec.shots(), 512u * 32);
  EXPECT_TRUE(lidar("gpu").gpu);
  EXPECT_DOUBLE_EQ(lidar("gpu").sigma, 0.02);
  EXPECT_DOUBLE_EQ(lidar("gpu").far_sigma, 0.06);
  EXPECT_EQ(lidar("gpu2").spec.shots(), 64u * 2048);
  EXPECT_EQ(lidar("gpu2").sigma, 0);
  const AirSimSettings old =
      ParseSettings(R"({"Vehicles": {"A": {"VehicleType": "SimpleFlight", "Sensors": {"c": {"SensorType": 6}}}}})", "");
  EXPECT_EQ(MakeRaySensors(old, old.vehicles.at("A")).lidars.at(0).spec.columns, 625u);
}

TEST(Settings, SensorsThatThereAreNotAreReadWithANotice) {
  for (int type = 1; type <= 1000; type += type < 20 ? 1 : 97) {
    const bool here = type <= 6 || type == 8;
    const std::string text =
        "{\"Vehicles\": {\"A\": {\"VehicleType\": \"SimpleFlight\", \"Sensors\": {\n\"s\": {\"SensorType\": " + std::to_string(type) +
        ", \"Enabled\": true, \"NumberOfTraces\": 100}}}}}";
    const AirSimSettings settings = ParseSettings(text, "settings.json");
    const bool noticed = Noticed(settings, {"settings.json:2: SensorType", "there are no sensors of type " + std::to_string(type)});
    EXPECT_EQ(noticed, !here) << type;
    if (!here) {
      EXPECT_TRUE(Noticed(settings, {"settings.json:2", "NumberOfTraces"})) << type;
      EXPECT_EQ(MakeRaySensors(settings, settings.vehicles.at("A")).lidars.size(), 0u);
    }
  }
  EXPECT_NE(ErrorOf("{\"DefaultSensors\": {\n\"s\": {\"Enabled\": true}}}").find("settings.json:2: SensorType: missing or 0"),
            std::string::npos);
}

TEST(Settings, KeysThatCountForNothingAreNamed) {
  const AirSimSettings settings = ParseSettings(R"({"ViewMode": "Fpv", "SubWindows": [],
    "Vehicles": {"A": {"VehicleType": "SimpleFlight", "RC": {}, "Sensors": {
      "l": {"SensorType": 6, "DrawDebugPoints": true, "External": false},
      "i": {"SensorType": 2, "GenerateNoise": true}}}}})",
                                                "settings.json");
  EXPECT_EQ(settings.notices.size(), 4u);
  EXPECT_TRUE(Noticed(settings, {"counts for nothing", "ViewMode", "SubWindows"}));
  EXPECT_TRUE(Noticed(settings, {"counts for nothing", "RC"}));
  EXPECT_TRUE(Noticed(settings, {"counts for nothing", "DrawDebugPoints", "External"}));
  EXPECT_TRUE(Noticed(settings, {"counts for nothing", "GenerateNoise"}));
}

TEST(Settings, AVehicleOfPx4IsFlownBySimpleFlightWithANotice) {
  const AirSimSettings settings = ParseSettings(R"({"Vehicles": {"PX4": {"VehicleType": "PX4Multirotor", "UseSerial": false,
    "LockStep": true, "TcpPort": 4560, "ControlIp": "127.0.0.1", "QgcHostIp": "", "X": 3}}})",
                                                "settings.json");
  EXPECT_EQ(settings.vehicles.at("PX4").type, "SimpleFlight");
  EXPECT_EQ(settings.vehicles.at("PX4").pose.x, 3);
  EXPECT_TRUE(Noticed(settings, {"settings.json:1", "there is no PX4 here", "SimpleFlight flies"}));
  EXPECT_TRUE(Noticed(settings, {"counts for nothing", "TcpPort", "ControlIp", "QgcHostIp"}));
  EXPECT_FALSE(Noticed(settings, {"not known"}));
}

TEST(Settings, UnknownKeysAreNoticedWithTheNearest) {
  const AirSimSettings settings = ParseSettings("{\n\"ClokSpeed\": 3}", "settings.json");
  ASSERT_EQ(settings.notices.size(), 1u);
  EXPECT_NE(settings.notices[0].find("settings.json:2: 'ClokSpeed'"), std::string::npos);
  EXPECT_NE(settings.notices[0].find("'ClockSpeed'"), std::string::npos);
  for (const char* strange : {"Plugins", "PawnPaths"}) {
    const std::string notice = ParseSettings("{\"" + std::string(strange) + "\": {}}", "settings.json").notices.at(0);
    EXPECT_EQ(notice.find("did you mean"), std::string::npos) << notice;
  }
}

}  // namespace
}  // namespace airsim360
