// Flags of `render` and `collect` that say what a frame is: cameras, tier, products, and how its colours are made.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "airsim360/app/camera_arguments.h"
#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

struct PictureArguments {
  CameraArguments camera;
  std::string tier = "fast", products, rgb_format = "png", pano_frame = "body";
  std::string tone = "filmic", exposure = "0", lens = "ideal";
  int samples = 0;
  bool normal = false, no_denoise = false, radiance = false;
  std::optional<int> edge_samples;

  /// Adds the flags; this object must outlive the parsing.
  void AddTo(CLI::App& command);
  /// Fills the spec. InputError naming the flag and the value.
  void Apply(DatasetSpec& spec) const;
};

}  // namespace airsim360
