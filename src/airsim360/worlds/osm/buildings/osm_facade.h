// How walls of maps and city models are dressed.
#pragma once

#include <string_view>

#include "airsim360/base/random.h"
#include "airsim360/worlds/building/facade.h"
#include "airsim360/worlds/building/facade_bays.h"
#include "airsim360/worlds/osm/data/osm_data.h"

namespace airsim360::internal {

/// Metres from the middle to which facades come in full depth, and with recessed windows; pictures beyond.
inline constexpr double kFullDetail = 230, kSimpleDetail = 480;

/// The style of a building with these tags, material and storeys (building:material, "" = unknown).
FacadeStyle PickFacadeStyle(const OsmTags& tags, std::string_view material, int floors, bool europe, RngStream& rng);

/// Paint (linear albedo) that was mixed for one house of a drawn town and has weathered as long as it has stood there: fainter by
/// up to a half, lighter or darker than its neighbours' of the same name. What a real map says of a colour stays.
Vec3f WeatheredPaint(Vec3f colour, uint64_t seed);

/// One low storey from a to b: windows and a door by turns, at heights that people need.
void BuildLowWall(MeshBuilder& mesh, const Surfaces& surfaces, const Dress& dress, Vec2f a, Vec2f b, float base, float height,
                  EntityId entity, RngStream& rng);

}  // namespace airsim360::internal
