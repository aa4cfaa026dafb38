// Flags of `render` and `collect` that say what is looked through: one camera, or a rig from a file.
#pragma once

#include <CLI/CLI.hpp>

#include "airsim360/dataset/record/camera_choice.h"

namespace airsim360 {

struct CameraArguments : CameraChoice {
  /// Adds the flags; this object must outlive the parsing.
  void AddTo(CLI::App& command);
};

}  // namespace airsim360
