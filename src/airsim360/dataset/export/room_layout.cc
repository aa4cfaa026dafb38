// Layouts of rooms: where the corners of the room around the camera lie in its panorama.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "airsim360/dataset/export/export_job.h"
#include "airsim360/dataset/rooms_json.h"
#include "airsim360/opening/world_loader.h"

namespace airsim360::internal {
namespace {

Json Point(Vec2f p) { return {p.x, p.y}; }

// Shares of the picture's width and height at which a point of W is seen, for pixels whose first centre is at 0.
Vec2d ShareOf(const RigidTransform& X_WC, Vec3d p_W, int width, int height) {
  const Vec3d d = X_WC.R.transpose() * (p_W - X_WC.p);
  const double theta = std::atan2(d.x, d.z), phi = std::atan2(-d.y, std::hypot(d.x, d.z));
  const double x = width * (0.5 + theta / (2 * std::numbers::pi)) - 0.5, y = height * (0.5 - phi / std::numbers::pi) - 0.5;
  return {x / width, y / height};
}

// Pairs of a ceiling and a floor corner from left to right: as azimuths grow, so clockwise from above.
Json LayoutJson(const RoomOutline& room, const RigidTransform& X_WC, int width, int height) {
  struct Pair {
    Vec2d ceiling, floor;
    Vec2f corner;
  };
  std::vector<Pair> pairs;
  for (auto corner = room.corners.rbegin(); corner != room.corners.rend(); ++corner) {
    const auto at = [&](float z) { return ShareOf(X_WC, VecCast<double>(Vec3f{corner->x, corner->y, z}), width, height); };
    pairs.push_back({at(room.ceiling_z), at(room.floor_z), *corner});
  }
  const auto leftmost = std::min_element(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.floor.x < b.floor.x; });
  std::rotate(pairs.begin(), leftmost, pairs.end());
  Json json{{"uv", Json::array()}, {"corners_W", Json::array()}};
  for (const Pair& pair : pairs) {
    json["uv"].push_back({pair.ceiling.x, pair.ceiling.y});
    json["uv"].push_back({pair.floor.x, pair.floor.y});
    json["corners_W"].push_back(Point(pair.corner));
  }
  return json;
}

// The camera's down axis is the world's, within a thousandth of a degree.
bool IsUpright(const RigidTransform& X_WC) { return X_WC.R.column(1).z < -1 + 1e-9; }

}  // namespace

void ExportLayout(ExportJob& job) {
  const View& view = job.Panorama();
  const auto building = RoomsOf({.world = job.data.spec().world, .seed = job.data.spec().seed});
  job.Need(building.has_value(), "rooms", "the world of a building: apartment, office, warehouse, mall, car_park or building");
  job.out.Write("rooms.json", RoomsJson(*building));
  int64_t outside = 0, tilted = 0;
  job.EachFrame(
      [&](const NativeFrame& frame) -> std::optional<std::string> {
        const RigidTransform X_WC = frame.X_WC(view);
        const RoomOutline* room = building->RoomAt(X_WC.p);
        if (!room) return std::nullopt;
        if (!IsUpright(X_WC)) return std::string();
        Json json = LayoutJson(*room, X_WC, Width(view.camera), Height(view.camera));
        json["room"] = room->id, json["name"] = room->name, json["type"] = room->type;
        json["camera"] = {X_WC.p.x, X_WC.p.y, X_WC.p.z};
        json["camera_height"] = X_WC.p.z - static_cast<double>(room->floor_z), json["room_height"] = room->ceiling_z - room->floor_z;
        return Pretty(json);
      },
      [&](const NativeFrame& frame, std::optional<std::string> text) {
        outside += !text, tilted += text && text->empty();
        if (text && !text->empty()) job.out.Write("layout/" + frame.stem + ".json", *text);
      });
  job.notes["frames_outside_rooms"] = outside;
  job.notes["frames_tilted"] = tilted;
}

}  // namespace airsim360::internal
