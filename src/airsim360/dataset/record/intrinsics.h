// How datasets write the intrinsics of pinhole and fisheye cameras.
#pragma once

#include <nlohmann/json.hpp>

#include "airsim360/projection/camera.h"

namespace airsim360 {

/// {"model", "width", "height", "fx", "fy", "cx", "cy", "distortion"} with COLMAP's names of models, PINHOLE (no distortion)
/// and OPENCV_FISHEYE (k1 … k4); pixel centres are at + 0.5. null for panoramas and cube faces.
nlohmann::ordered_json IntrinsicsJson(const Camera& camera);

}  // namespace airsim360
