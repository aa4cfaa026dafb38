// Rooms and doors of a building as JSON: `world rooms --json`, and rooms.json of exported layouts.
#pragma once

#include <string>

#include "airsim360/scene/building_rooms.h"

namespace airsim360 {

/// {"rooms": [{id, name, type, storey, floor_z, ceiling_z, area_m2, corners}], "doors": [{id, kind, open, center, through, width, height, rooms}]}, indented, with a line break at the end.
std::string RoomsJson(const BuildingRooms& building);

}  // namespace airsim360
