// What a label file would change, without changing it.
#pragma once

#include <cstddef>
#include <filesystem>

#include "airsim360/scene/scene.h"

namespace airsim360 {

struct LabelCount {
  size_t rules = 0, unused = 0;  ///< of the file; of them, that match nothing
  size_t entities = 0;           ///< that a rule matches
};

/// As Relabelled would hold the rules against the names of a scene. InputError as Relabelled.
LabelCount CountLabelled(const Scene& scene, const std::filesystem::path& labels);

}  // namespace airsim360
