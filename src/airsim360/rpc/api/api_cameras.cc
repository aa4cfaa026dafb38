// Poses, fields of view and distortion of cameras.
#include <cmath>
#include <numbers>

#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/coordinates/ned.h"

namespace airsim360 {
namespace {

using airsim::CameraName;
using airsim::External;
using Text = const std::string&;

CameraSetup& CameraToChange(Session& s, const CameraName& camera, Text vehicle, const External& external) {
  const bool of_world = external.external && vehicle.empty();
  const size_t index = of_world ? 0 : s.control(vehicle).index();
  CameraMap& cameras = of_world ? s.world().external_cameras : s.world().cameras[index];
  return const_cast<CameraSetup&>(FindCamera(cameras, camera.text));
}

// As a game engine's: infinite far plane, depth from 1 at the near one to 0, near plane 0.1 m.
airsim::ProjectionMatrix ProjectionMatrixOf(const CaptureSettings& capture) {
  constexpr float kNear = 0.1f;
  const auto scale = static_cast<float>(1 / std::tan(capture.fov_degrees * std::numbers::pi / 360));
  const float aspect = static_cast<float>(capture.width) / static_cast<float>(capture.height);
  airsim::ProjectionMatrix projection;
  projection.matrix = {{{scale, 0, 0, 0}, {0, scale * aspect, 0, 0}, {0, 0, 0, kNear}, {0, 0, -1, 0}}};
  return projection;
}

airsim::CameraInfo InfoOf(const Snapshot& now, const CameraName& name, Text vehicle, const External& external) {
  const bool of_world = external.external && vehicle.empty();
  const size_t index = of_world ? 0 : now.Find(vehicle);
  const CameraSetup& camera = FindCamera(of_world ? now.world->external_cameras : now.world->cameras[index], name.text);
  const CaptureSettings& capture = camera.captures.at(airsim::ImageType::kScene);
  airsim::CameraInfo info;
  info.fov = camera.panorama == PanoramaKind::kNone ? static_cast<float>(capture.fov_degrees) : 360;
  info.proj_mat = ProjectionMatrixOf(capture);

  info.pose = of_world ? airsim::ToMount(camera.X_BA) : airsim::ToPose(CameraPoseIn(now, index, camera), now.vehicles[index].origin_W);
  return info;
}

size_t DistortionIndex(Text name) {
  static const std::vector<std::string> kNames = {"K1", "K2", "K3", "P1", "P2"};
  for (size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i]) return i;
  }
  throw std::invalid_argument("distortion parameter '" + name + "' is none of K1, K2, K3, P1, P2");
}

}  // namespace

void AddCameraCalls(Api& api) {
  api.Read(
      "simGetCameraInfo",
      [](const Snapshot& now, const CameraName& camera, Text vehicle, const External& external) {
        return InfoOf(now, camera, vehicle, external);
      },
      1);
  api.Change(
      "simSetCameraPose",
      [](Session& s, const CameraName& camera, const airsim::Pose& pose, Text vehicle, const External& external) {
        CameraToChange(s, camera, vehicle, external).X_BA = airsim::FromMount(pose);
      },
      1);
  api.Change(
      "simSetCameraFov",
      [](Session& s, const CameraName& camera, float degrees, Text vehicle, const External& external) {
        constexpr float kWidest = 179;
        if (!(degrees > 0.1f && degrees <= kWidest)) throw std::invalid_argument("fov must be in 0.1 ... 179 degrees");
        for (auto& [type, capture] : CameraToChange(s, camera, vehicle, external).captures) {
          capture.fov_degrees = degrees;
        }
      },
      1);
  api.Read(
      "simGetDistortionParams",
      [](const Snapshot& now, const CameraName& camera, Text vehicle, const External& external) {
        const bool of_world = external.external && vehicle.empty();
        return FindCamera(of_world ? now.world->external_cameras : now.world->cameras[now.Find(vehicle)], camera.text).distortion;
      },
      1);
  api.Change(
      "simSetDistortionParam",
      [](Session& s, const CameraName& camera, Text parameter, float value, Text vehicle, const External& external) {
        CameraToChange(s, camera, vehicle, external).distortion[DistortionIndex(parameter)] = value;
        NoticeOnce("simSetDistortionParam: kept, but pictures are not distorted");
      },
      1);
  api.Read(
      "simGetCurrentFieldOfView",
      [](const Snapshot& now, const CameraName& camera, Text vehicle, const External& external) {
        const airsim::CameraInfo info = InfoOf(now, camera, vehicle, external);
        const float vertical = 2 * std::atan(1 / info.proj_mat.matrix[1][1]) * 180 / std::numbers::pi_v<float>;
        return "Current camera field of view:\nHorizontal: " + std::to_string(info.fov) + "\nVertical: " + std::to_string(vertical);
      },
      1);
}

}  // namespace airsim360
