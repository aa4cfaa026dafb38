// What agents outside of the program are told. For the .cc files of this folder.
#pragma once

#include "airsim360/vln/agents/vln_agent.h"
#include "airsim360/vln/predicates/query_json.h"

namespace airsim360::internal {

/// Place and heading from the start, time, limits, what came of the last decision; no picture, and nothing of the goal.
VlnJson ObservationJson(const VlnSituation& situation);
/// Text that is safe to show and to store: valid UTF-8 of printable characters, at most `longest` bytes.
std::string Tame(std::string_view text, size_t longest);

}  // namespace airsim360::internal
