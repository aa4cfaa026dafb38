// The cameras of a vehicle: AirSim's ordinary ones and the panoramic ones of AirSim360.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "airsim360/projection/camera.h"
#include "airsim360/rpc/settings/settings.h"

namespace airsim360 {

/// What a panoramic camera shows whatever image type is asked of it; ordinary cameras show every type.
enum class PanoramaKind { kNone, kOriginal, kDepth, kSeg, kEntity, kNormal, kFlow };

struct CameraSetup {
  RigidTransform X_BA;                                    ///< mount; A is body-like, it looks along +X
  std::map<airsim::ImageType, CaptureSettings> captures;  ///< of every type
  PanoramaKind panorama = PanoramaKind::kNone;
  int panorama_width = 1024, panorama_height = 512;
  bool own_resolution = false;                                  ///< of the panorama, set by a call
  std::vector<float> distortion = std::vector<float>(5, 0.0f);  ///< K1, K2, K3, P1, P2; kept, not applied
  double focal_length = 0;                                      ///< kept only
};

/// Cameras by name; "0" … "4", "fpv" and "" are other names of the standard ones.
using CameraMap = std::map<std::string, CameraSetup, std::less<>>;

/// The standard, panoramic and own cameras of a vehicle.
CameraMap MakeCameras(const AirSimSettings& settings, const VehicleSettings& vehicle);
/// ExternalCameras of the settings: X_BA is their place in the global N, as a mount.
CameraMap MakeExternalCameras(const AirSimSettings& settings);

/// The name a camera has in the map for any of its names.
std::string CanonicalCamera(const std::string& name);
/// std::invalid_argument that lists the cameras there are.
const CameraSetup& FindCamera(const CameraMap& cameras, const std::string& name);

/// Pinhole of one capture: square pixels, principal point in the middle.
Camera PinholeOf(const CaptureSettings& capture);
/// What renders images of one type: a pinhole or the panorama.
Camera ProjectionOf(const CameraSetup& setup, airsim::ImageType type);

}  // namespace airsim360
