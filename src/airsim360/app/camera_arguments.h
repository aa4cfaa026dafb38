// Flags of `render` and `collect` that say what is looked through: one camera, or a rig from a file.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

struct CameraArguments {
  std::string projection = "erp", size, cameras;
  double fov_deg = 0;  ///< 0: not given

  /// Adds the flags; this object must outlive the parsing.
  void AddTo(CLI::App& command);
  /// Fills projection, size and field of view of the spec, or its rig. InputError naming the flag, or the line of the
  /// file, and the value.
  void Apply(DatasetSpec& spec) const;
};

}  // namespace airsim360
