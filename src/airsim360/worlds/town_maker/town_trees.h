// Trees of the south that streets elsewhere do not have.
#pragma once

#include <string_view>

#include "airsim360/scene/model_source.h"

namespace airsim360::internal {

/// One individual of about `kTypicalHeight` of its kind: "palm", "cypress" or "umbrella_pine".
Model GrowSouthernTree(std::string_view kind, uint32_t individual);
/// Metres, of all individuals of a kind before they are scaled.
double TypicalHeight(std::string_view kind);

}  // namespace airsim360::internal
