#include "airsim360/dataset/rooms_json.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

Json Point(Vec2f p) { return {p.x, p.y}; }
Json Point(Vec3f p) { return {p.x, p.y, p.z}; }

}  // namespace

std::string RoomsJson(const BuildingRooms& building) {
  Json json{{"rooms", Json::array()}, {"doors", Json::array()}};
  for (const RoomOutline& room : building.rooms) {
    Json corners = Json::array();
    for (const Vec2f& corner : room.corners) corners.push_back(Point(corner));
    json["rooms"].push_back({{"id", room.id},
                             {"name", room.name},
                             {"type", room.type},
                             {"storey", room.storey},
                             {"floor_z", room.floor_z},
                             {"ceiling_z", room.ceiling_z},
                             {"area_m2", room.area_m2},
                             {"corners", std::move(corners)}});
  }
  for (const RoomDoor& door : building.doors)
    json["doors"].push_back({{"id", door.id},
                             {"kind", door.kind},
                             {"open", door.open},
                             {"center", Point(door.center)},
                             {"through", Point(door.through)},
                             {"width", door.width},
                             {"height", door.height},
                             {"rooms", {door.rooms[0], door.rooms[1]}}});
  return json.dump(1) + "\n";
}

}  // namespace airsim360
