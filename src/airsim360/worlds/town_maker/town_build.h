// A town from its measures, as a scene.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/worlds/worlds.h"

namespace airsim360::internal {

/// The town of `spec` (which Check accepts), called `name`. A function of the measures and the options.
std::shared_ptr<const Scene> BuildTownScene(const std::string& name, const TownSpec& spec, const WorldOptions& options);

/// The measures of one of the named towns (downtown_city, lisbon_downtown, rome, roof, rural_cabins, town).
const TownSpec& NamedTown(std::string_view name);

}  // namespace airsim360::internal
