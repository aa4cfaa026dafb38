// Fields of a configuration as JSON, for meta.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "airsim360/base/config.h"

namespace airsim360 {

/// Adds every field under its name: numbers, truth values, words and lists; counts that were not given are left out.
void AddConfig(const ConfigFields& fields, nlohmann::ordered_json& json);

}  // namespace airsim360
