// A plan by name: of a recipe, or from a file.
#pragma once

#include <string>
#include <vector>

#include "airsim360/dataset/plan/plan.h"
#include "airsim360/render/vulkan/choose_renderer.h"

namespace airsim360 {

struct PlanRequest {
  /// Name or YAML file of a recipe, or file of a plan; "@HASH" or the first digits of it behind: what its hash must be.
  std::string name;
  std::vector<std::string> worlds = {};  ///< recipes: only the rows of these; empty: all
  int64_t frames = 0;                    ///< recipes: all rows scaled to so many; 0: as many as they say
  uint64_t seed = 0;                     ///< recipes
};

/// Reads the plan, or makes it, which opens every world that exists once. InputError for a name that is none (naming the
/// nearest), for `worlds` or `frames` of a plan file, and for another hash than the one that was named.
DatasetPlan FindPlan(const PlanRequest& request, const DeviceChoice& device);

}  // namespace airsim360
