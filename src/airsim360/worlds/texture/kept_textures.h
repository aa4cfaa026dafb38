// Textures that every world needs, made once for all runs of a program.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "airsim360/base/disk_cache.h"
#include "airsim360/scene/material.h"

namespace airsim360::internal {

/// What `make` returns, from the cache where an earlier run of this very program has kept it under `name`.
std::vector<Texture> KeptTextures(const DiskCache& cache, std::string_view name, const std::function<std::vector<Texture>()>& make);

}  // namespace airsim360::internal
