// How datasets write the intrinsics of pinholes, fisheyes and calibrated lenses.
#pragma once

#include <nlohmann/json.hpp>

#include "airsim360/projection/camera.h"

namespace airsim360 {

/// {"model", "width", "height", "fx", "fy", "cx", "cy", "distortion"} with COLMAP's names of models, PINHOLE (no distortion)
/// and OPENCV_FISHEYE (k1 … k4); of calibrated lenses the names and parameters of projection/camera_model_names.h and "max_theta",
/// radians, beyond which nothing is seen. Pixel centres are at + 0.5. null for panoramas and cube faces.
nlohmann::ordered_json IntrinsicsJson(const Camera& camera);

/// The camera of IntrinsicsJson; `max_theta` where the JSON has none.
Camera CameraOfIntrinsics(const nlohmann::ordered_json& K, double max_theta);

/// Whether COLMAP has the model of these intrinsics.
bool IsColmapModel(const Camera& camera);

}  // namespace airsim360
