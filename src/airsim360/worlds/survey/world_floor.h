// How full a downtown must be to be believed: counts that follow from its area and the densities of real districts.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "airsim360/worlds/survey/world_survey.h"

namespace airsim360 {

/// One count and the least that it should be.
struct FloorRow {
  std::string item;  ///< "lamp posts"
  double at_least = 0, measured = 0;
  bool reached() const { return measured >= at_least; }
};

/// The rows for new_york_city (and as of the 1950s), downtown_west and sf_city as built with their default plan; empty for any other world.
std::vector<FloorRow> StructuralFloor(std::string_view world, const WorldSurvey& survey);

}  // namespace airsim360
