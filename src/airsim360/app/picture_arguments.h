// Flags of `render` and `collect` that say how colour pictures are made: tone, exposure, lens, radiance.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

struct PictureArguments {
  std::string tone = "filmic", exposure = "0", lens = "ideal";
  bool radiance = false;
  std::optional<int> edge_samples;

  /// Adds the flags; this object must outlive the parsing.
  void AddTo(CLI::App& command);
  /// Fills the spec, whose cameras and tier are set. InputError naming the flag and the value.
  void Apply(DatasetSpec& spec) const;
};

}  // namespace airsim360
