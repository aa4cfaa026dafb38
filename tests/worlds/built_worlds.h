// Worlds that several tests of one program look at, each built once.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "airsim360/worlds/worlds.h"

namespace airsim360 {

inline std::shared_ptr<const Scene> Built(const std::string& name) {
  static std::map<std::string, std::shared_ptr<const Scene>> built;
  std::shared_ptr<const Scene>& scene = built[name];
  if (!scene) scene = BuildWorld(name, {});
  return scene;
}

}  // namespace airsim360
