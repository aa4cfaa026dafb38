// A building from words: each word is understood, is filler, or is an error.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/worlds/building_spec.h"

namespace airsim360 {

struct BuildingRequest {
  BuildingSpec spec;
  uint64_t people = 0;  ///< who are inside
  /// Some words and the setting that they became ("storeys: 2"), or "filler"; in order, together all of the description.
  std::vector<std::pair<std::string, std::string>> words;
};

/// What "a two-storey library with an atrium" says; nullopt where the description names no building of which the inside can
/// be made, as those of towns do. InputError for words that mean nothing here (naming the nearest that does), for a second use, and for
/// measures that a building of that use cannot have.
std::optional<BuildingRequest> BuildingFromWords(std::string_view description);

}  // namespace airsim360
