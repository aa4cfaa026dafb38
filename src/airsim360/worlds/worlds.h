// The built-in worlds, each a pure function of (name, seed, options).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/scene/model_source.h"
#include "airsim360/scene/scene.h"

namespace airsim360 {

struct WorldInfo {
  std::string name;
  std::string setting;                  ///< "outdoor" or "indoor"
  double area_m2 = 0;                   ///< ground that can be reached
  std::vector<std::string> categories;  ///< paths of the categories present
  std::string description;
};

/// All built-in worlds, by name.
const std::vector<WorldInfo>& ListWorlds();

struct WorldOptions {
  uint64_t seed = 0;
  const ModelSource* models = nullptr;  ///< used where it has a model; every prop has a procedural fallback
};

/// Builds a world; InputError naming the nearest if there is no such world.
std::shared_ptr<const Scene> BuildWorld(std::string_view name, const WorldOptions& options);

}  // namespace airsim360
