#include "airsim360/rpc/session/cameras.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "airsim360/rpc/session/airsim_drone.h"

namespace airsim360 {
namespace {

constexpr struct {
  const char* name;
  PanoramaKind kind;
} kPanoramas[] = {{"panorama_original", PanoramaKind::kOriginal}, {"panorama_depth", PanoramaKind::kDepth},
                  {"panorama_seg", PanoramaKind::kSeg},           {"panorama_entity", PanoramaKind::kEntity},
                  {"panorama_normal", PanoramaKind::kNormal},     {"panorama_flow", PanoramaKind::kFlow}};

// AirSim's standard cameras on its quadrotor: FRD metres, degrees; stereo baseline 25 cm.
constexpr struct {
  const char* name;
  const char* number;
  double x, y, z, yaw, pitch;
} kStandard[] = {{"front_center", "0", 0.25, 0, 0, 0, 0},
                 {"front_right", "1", 0.25, 0.125, 0, 0, 0},
                 {"front_left", "2", 0.25, -0.125, 0, 0, 0},
                 {"bottom_center", "3", 0, 0, 0.05, 0, -90},
                 {"back_center", "4", -0.25, 0, 0, 180, 0}};

void SetCaptures(const AirSimSettings& settings, const CameraSettings& own, CameraSetup& setup) {
  for (int type = 0; type < static_cast<int>(airsim::ImageType::kCount); ++type) {
    const auto image_type = static_cast<airsim::ImageType>(type);
    setup.captures[image_type] = CaptureOf(settings, own, image_type);
  }
}

}  // namespace

CameraMap MakeCameras(const AirSimSettings& settings, const VehicleSettings& vehicle) {
  CameraMap cameras;
  for (const auto& place : kStandard) {
    CameraSetup& setup = cameras[place.name];
    setup.X_BA = MountOf({}, {place.x, place.y, place.z, 0, place.pitch, place.yaw});
    SetCaptures(settings, {}, setup);
  }
  for (const auto& panorama : kPanoramas) {
    CameraSetup& setup = cameras[panorama.name];
    setup.panorama = panorama.kind;
    SetCaptures(settings, {}, setup);
  }
  for (const auto& [name, own] : vehicle.cameras) {
    CameraSetup& setup = cameras[CanonicalCamera(name)];
    const bool known = !setup.captures.empty();
    if (!known || !std::isnan(own.pose.x)) setup.X_BA = MountOf(own.pose, {});
    SetCaptures(settings, own, setup);
  }
  return cameras;
}

CameraMap MakeExternalCameras(const AirSimSettings& settings) {
  CameraMap cameras;
  for (const auto& [name, own] : settings.external_cameras) {
    CameraSetup& setup = cameras[name];
    setup.X_BA = MountOf(own.pose, {});
    SetCaptures(settings, own, setup);
  }
  return cameras;
}

std::string CanonicalCamera(const std::string& name) {
  if (name.empty() || name == "fpv") return "front_center";
  for (const auto& place : kStandard) {
    if (name == place.number) return place.name;
  }
  return name;
}

const CameraSetup& FindCamera(const CameraMap& cameras, const std::string& name) {
  const auto found = cameras.find(CanonicalCamera(name));
  if (found != cameras.end()) return found->second;
  std::string choices;
  for (const auto& [known, setup] : cameras) {
    if (!choices.empty()) choices += ", ";
    choices += known;
  }
  throw std::invalid_argument("Camera '" + name + "' not found or not available; " +
                              (choices.empty() ? "there are none of this kind" : "the cameras are " + choices));
}

Camera PinholeOf(const CaptureSettings& capture) {
  const double half_angle = capture.fov_degrees * std::numbers::pi / 360;
  const double focal = 0.5 * capture.width / std::tan(half_angle);
  return Pinhole{capture.width, capture.height, focal, focal, 0.5 * capture.width, 0.5 * capture.height};
}

Camera ProjectionOf(const CameraSetup& setup, airsim::ImageType type) {
  if (setup.panorama != PanoramaKind::kNone) return Equirectangular{setup.panorama_width, setup.panorama_height};
  return PinholeOf(setup.captures.at(type));
}

}  // namespace airsim360
