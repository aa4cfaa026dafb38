// Flights through the doors of a building: from a free place of a room through the middle of an open door to a free place of the
// room behind it. Each is certified to keep its distance from every surface, or counted by what stands against it.
//   door_flights [WORLD [FLIGHTS [METRES]]]     (default: apartment 1000 0.3)
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/dataset/waypoint_set.h"
#include "airsim360/opening/world_loader.h"

namespace airsim360 {
namespace {

// A place at least `radius` and a little more from everything, within 5 m of the door.
std::optional<Vec3d> PlaceIn(const RoomOutline& room, Vec3d door, const BoundedClearance& world, double radius, RngStream& random) {
  const auto between = [&](float low, float high, double about) {
    return random.Uniform(std::max(static_cast<double>(low), about - 5), std::min(static_cast<double>(high), about + 5));
  };
  for (int k = 0; k < 400; ++k) {
    const Vec3d p{between(room.corners[0].x, room.corners[2].x, door.x), between(room.corners[0].y, room.corners[2].y, door.y),
                  random.Uniform(static_cast<double>(room.floor_z) + 0.4,
                                 std::min<double>(static_cast<double>(room.ceiling_z), static_cast<double>(room.floor_z) + 3) - 0.4)};
    if (world.Clearance(p, 2 * radius) > radius + 0.1) return p;
  }
  return std::nullopt;
}

struct Outcome {
  std::string refused;  // empty: certified
  double least = 0;
};

Outcome Fly(const BuildingRooms& rooms, const RoomDoor& door, const BoundedClearance& world, double radius, RngStream random) {
  const auto by_id = [&](uint32_t id) {
    return std::find_if(rooms.rooms.begin(), rooms.rooms.end(), [&](const RoomOutline& r) { return r.id == id; });
  };
  const Vec3d middle = VecCast<double>(door.center);
  const auto a = PlaceIn(*by_id(door.rooms[0]), middle, world, radius, random),
             b = PlaceIn(*by_id(door.rooms[1]), middle, world, radius, random);
  if (!a || !b) return {"no free place beside the door", 0};
  try {
    const CertifiedFlight flight =
        FlyFree({*a, middle, *b}, world, {.limits = {.speed = 2, .acceleration = 2}, .allocation = {}, .radius = radius});
    if (!flight.certificate.certified) return {"not certified", flight.certificate.least_clearance};
    return {"", flight.certificate.least_clearance};
  } catch (const InputError& error) {
    // Without its numbers, so that like ones are counted together.
    std::string reason = error.what();
    for (char& c : reason)
      if ((c >= '0' && c <= '9') || c == '-' || c == '.') c = '#';
    reason.erase(std::unique(reason.begin(), reason.end(), [](char x, char y) { return x == '#' && y == '#'; }), reason.end());
    return {reason, 0};
  }
}

}  // namespace
}  // namespace airsim360

int main(int argc, char** argv) {
  using namespace airsim360;
  const std::string name = argc > 1 ? argv[1] : "apartment";
  const int flights = argc > 2 ? std::atoi(argv[2]) : 1000;
  const double radius = argc > 3 ? std::atof(argv[3]) : 0.3;
  const WorldRequest request{.world = name};
  const std::optional<BuildingRooms> rooms = RoomsOf(request);
  if (!rooms) {
    std::fprintf(stderr, "%s has no rooms\n", name.c_str());
    return 2;
  }
  std::vector<RoomDoor> open;
  for (const RoomDoor& door : rooms->doors)
    if (door.open > 0.5 && door.rooms[0] != 0 && door.rooms[1] != 0 && static_cast<double>(door.width) >= 2 * radius + 0.1)
      open.push_back(door);
  Stage stage({.world = request});
  const WaypointSpace space(stage, radius);
  std::map<std::string, int> refused;
  std::map<size_t, int> of_door;
  std::mutex mutex;
  int certified = 0;
  double least = 1e9;
  ParallelFor(flights, [&](int64_t i) {
    const size_t door = static_cast<size_t>(i) % open.size();
    const Outcome outcome = Fly(*rooms, open[door], space.world(), radius, RngStream(static_cast<uint64_t>(i), "door flights"));
    const std::scoped_lock lock(mutex);
    if (!outcome.refused.empty()) {
      ++refused[outcome.refused];
      ++of_door[door];
      return;
    }
    ++certified;
    least = std::min(least, outcome.least);
  });
  std::printf("%s: %d of %d flights through %zu open doors certified, clearance never below %.3f m\n", name.c_str(), certified, flights,
              open.size(), least);
  for (const auto& [reason, count] : refused) std::printf("  %d refused: %s\n", count, reason.c_str());
  for (const auto& [door, count] : of_door)
    std::printf("  door %u (%s, %.2f m wide): %d refused\n", open[door].id, open[door].kind.c_str(), static_cast<double>(open[door].width),
                count);
}
