// A rig of several cameras from a file: our own, or one that a calibration program wrote.
#pragma once

#include <filesystem>
#include <vector>

#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

/// The cameras of a file in its order (docs/reference/cameras.md): a YAML or JSON file with `cameras` and `gimbals`, Kalibr's
/// camchain.yaml, COLMAP's cameras.txt, OpenCV's or ROS's YAML. InputError naming file, line and value.
std::vector<RigCamera> ReadRigFile(const std::filesystem::path& file);

/// Projection, size and field of view that fit each other, as flags give them; empty and 0 stand for the projection's own.
RigCamera MakeRigCamera(const std::string& projection, const std::string& size, double fov_deg);

}  // namespace airsim360
