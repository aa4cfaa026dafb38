// Painted ways over roads, and whether traffic lights stand by them.
#pragma once

#include <vector>

#include "airsim360/people/navigation/navmesh.h"

namespace airsim360::internal {

/// One of every entity of category ground/crosswalk.
std::vector<NavMesh::Crossing> FindCrossings(const Scene& scene);

}  // namespace airsim360::internal
