#include "airsim360/rpc/settings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"

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
  EXPECT_NE(
      ErrorOf("{\"Vehicles\": {\n\"A\": {\"VehicleType\": \"px4\"}}}").find("settings.json:2: VehicleType"),
      std::string::npos);
  EXPECT_EQ(ErrorOf("{\"Vehicles\": {\n\"../../evil\": {\"VehicleType\": \"SimpleFlight\"}}}"),
            "settings.json:2: Vehicles: '../../evil' holds a '/': it becomes the name of a file");
  EXPECT_NE(ErrorOf("{\"ExternalCameras\": {\"a\\u0000b\": {}}}").find("control character"), std::string::npos);
  EXPECT_EQ(ErrorOf("{\"ClockSpeed\": 1,\n}"), "settings.json:2: expected a key in quotation marks");
  EXPECT_EQ(ErrorOf("{\"ClockSpeed\": 1"), "settings.json:1: the text ends too early");
  EXPECT_NE(ErrorOf("{\"CameraDefaults\": {\"CaptureSettings\": [\n{\"Width\": 0}]}}")
                .find("settings.json:2: Width"),
            std::string::npos);
  EXPECT_NE(ErrorOf("{\"a\": tru}").find("expected a value"), std::string::npos);
  EXPECT_NE(ErrorOf("{} {}").find("follows the end"), std::string::npos);
  EXPECT_NE(ErrorOf(std::string(200, '[')).find("too deeply"), std::string::npos);
}

TEST(Settings, UnknownKeysAreNoticedWithTheNearest) {
  const AirSimSettings settings = ParseSettings("{\n\"ClokSpeed\": 3}", "settings.json");
  ASSERT_EQ(settings.notices.size(), 1u);
  EXPECT_NE(settings.notices[0].find("settings.json:2: 'ClokSpeed'"), std::string::npos);
  EXPECT_NE(settings.notices[0].find("'ClockSpeed'"), std::string::npos);
}

}  // namespace
}  // namespace airsim360
