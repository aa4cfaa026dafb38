// The rooms of a building and its doors, as plain data: what layout labels and flights through doors start from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// A room between the faces of its walls, furniture left out.
struct RoomOutline {
  uint32_t id = 0;             ///< from 1
  std::string name, type;      ///< "bedroom 2", "bedroom"
  int storey = 0;              ///< 0 = the lowest
  std::vector<Vec2f> corners;  ///< in W, counter-clockwise from above
  float floor_z = 0, ceiling_z = 0;
  double area_m2 = 0;
};

/// A door or a passage; drones pass those that are open.
struct RoomDoor {
  uint32_t id = 0;              ///< N of the entity "door N open" or "door N closed"; 0 for passages, which have no leaf
  std::string kind;             ///< "door", "double_door", "sliding_door", "dock_door", "lift_door", "passage"
  double open = 0;              ///< 0 shut … 1 as far as it goes
  Vec3f center = {};            ///< of the free opening, in W
  Vec2f through = {};           ///< unit, level, across the wall towards larger coordinates
  float width = 0, height = 0;  ///< of the clear opening, metres
  uint32_t rooms[2] = {0, 0};   ///< ids of the rooms before and behind it along `through`; 0 = outside
};

struct BuildingRooms {
  std::vector<RoomOutline> rooms;
  std::vector<RoomDoor> doors;

  /// The room that holds a point in W; nullptr = none.
  const RoomOutline* RoomAt(Vec3d p_W) const {
    for (const RoomOutline& room : rooms) {
      const Vec2f low = room.corners[0], high = room.corners[2];
      if (p_W.x >= static_cast<double>(low.x) && p_W.x <= static_cast<double>(high.x) && p_W.y >= static_cast<double>(low.y) &&
          p_W.y <= static_cast<double>(high.y) && p_W.z >= static_cast<double>(room.floor_z) &&
          p_W.z <= static_cast<double>(room.ceiling_z))
        return &room;
    }
    return nullptr;
  }

  /// Places in W in and on both sides of the open doors and passages: a way through a door needs three in a row.
  std::vector<Vec3d> OpenPassages() const {
    constexpr double kHalfOpen = 0.5, kBeside = 0.7;  // share; metres from the middle of the wall
    std::vector<Vec3d> places;
    for (const RoomDoor& door : doors) {
      if (door.open <= kHalfOpen) continue;
      const Vec3d middle = VecCast<double>(door.center), through{door.through.x, door.through.y, 0};
      for (const double side : {0.0, -kBeside, kBeside}) places.push_back(middle + through * side);
    }
    return places;
  }
};

}  // namespace airsim360
