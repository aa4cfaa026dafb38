#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "airsim360/people/behaviour/plan.h"
#include "airsim360/people/behaviour/seats.h"

namespace airsim360::internal {
namespace {

constexpr double kReachOfSeats = 1.4;  // metres from the ground that is walked on to the feet before a seat

// In buildings that are furnished chairs are sat on too: at desks, at tables, in waiting rooms.
std::optional<PlaceKind> KindOfPlace(std::string_view path, bool furnished) {
  if (furnished && IsSeat(path)) return PlaceKind::kBench;
  if (furnished && path.starts_with("furniture/counter")) return PlaceKind::kQueue;
  static const std::vector<std::pair<std::string_view, PlaceKind>> kinds = {{"furniture/seating/bench", PlaceKind::kBench},
                                                                            {"signage/shop_sign", PlaceKind::kShop},
                                                                            {"construction/door", PlaceKind::kShop},
                                                                            {"furniture/vending", PlaceKind::kFood},
                                                                            {"construction/fountain", PlaceKind::kSight},
                                                                            {"construction/statue", PlaceKind::kSight},
                                                                            {"water", PlaceKind::kSight},
                                                                            {"furniture/transit/bus_stop", PlaceKind::kStop}};
  for (const auto& [prefix, kind] : kinds)
    if (path.starts_with(prefix)) return kind;
  return std::nullopt;
}

/// Seats of a bench or chair, by its shape.
void AddSeats(const SeatFinder& finder, EntityId id, const Box3f& box, const NavMesh& mesh, std::vector<Place>& places) {
  const Vec2d centre{box.center().x, box.center().y};
  const NavPoint near = mesh.Nearest({centre.x, centre.y, box.min.z}, 1.5);
  for (const Seat& seat : finder.Seats(id, near.valid() ? Vec2d{near.p_W.x, near.p_W.y} - centre : Vec2d{})) {
    const NavPoint approach = mesh.Nearest(seat.feet, kReachOfSeats);
    if (approach.valid() && std::abs(approach.p_W.z - seat.feet.z) < 0.5)
      places.push_back({PlaceKind::kBench, approach, seat.feet, seat.yaw, seat.seating});
  }
}

// Four before a counter. Fronts of furniture face -Y of its model. Behind a short one people stand in its way, along a long
// one (a belt) beside it. Nobody queues at what nobody serves at: kitchens have no room for a line, or no name for one.
void AddLine(const Scene& scene, EntityId id, const NavMesh& mesh, std::vector<Place>& places) {
  constexpr double kBelt = 2.2, kStandOff = 0.45, kGap = 0.75, kSlack = 0.2;  // metres
  constexpr int kLongest = 4;
  const Entity& counter = scene.entity(id);
  if (!counter.name.starts_with("checkout") && !counter.name.starts_with("shop_counter")) return;
  const auto instance = std::ranges::find(scene.instances, id, &Instance::entity);
  if (instance == scene.instances.end()) return;
  const auto axis = [&](int column) {
    const Vec2d a{instance->X_WM.A.m[0][column], instance->X_WM.A.m[1][column]};
    const double length = std::hypot(a.x, a.y);
    return length < 1e-6 ? Vec2d{} : a * (1 / length);
  };
  // Models whose up is Y have their front at +Z.
  const bool y_up = std::abs(instance->X_WM.A.m[2][1]) > std::abs(instance->X_WM.A.m[2][2]);
  const Vec2d front = y_up ? axis(2) : axis(1) * -1.0, along = axis(0);
  if (std::hypot(front.x, front.y) == 0 || std::hypot(along.x, along.y) == 0) return;  // lies on its side
  const Vec2d centre{counter.bounds.center().x, counter.bounds.center().y};
  const Vec3f size = counter.bounds.size();
  const double depth = std::abs(front.x) * size.x / 2 + std::abs(front.y) * size.y / 2;
  const bool belt = std::abs(along.x) * size.x + std::abs(along.y) * size.y > kBelt;
  // The longest of the lines that there is room for.
  std::vector<Place> best;
  for (const Vec2d way : belt ? std::vector<Vec2d>{along, along * -1.0} : std::vector<Vec2d>{front, along, along * -1.0}) {
    std::vector<Place> line;
    for (int rank = 0; rank < kLongest; ++rank) {
      const Vec2d p = centre + front * (depth + kStandOff) + way * (kGap * rank);
      const NavPoint at = mesh.Nearest({p.x, p.y, counter.bounds.min.z}, kSlack);
      if (!at.valid() || (rank > 0 && !mesh.Straight(line.back().approach, {at.p_W.x, at.p_W.y}))) break;
      const Vec2d look = rank > 0 ? way * -1.0 : front * -1.0;
      line.push_back({PlaceKind::kQueue, at, at.p_W, std::atan2(look.y, look.x), {}, rank});
    }
    if (line.size() > best.size()) best = std::move(line);
  }
  if (best.size() > 1) places.insert(places.end(), best.begin(), best.end());
}

}  // namespace

std::vector<Box3f> Ceilings(const Scene& scene) {
  std::vector<Box3f> boxes;
  for (const Entity& entity : scene.entities)
    if (!entity.bounds.empty() && scene.tree[entity.category].path.starts_with("construction/ceiling")) boxes.push_back(entity.bounds);
  return boxes;
}

std::vector<Place> FindPlaces(const Scene& scene, const NavMesh& mesh, bool furnished) {
  std::map<EntityId, PlaceKind> wanted;
  for (const Entity& entity : scene.entities)
    if (const auto kind = KindOfPlace(scene.tree[entity.category].path, furnished); kind && !entity.bounds.empty())
      wanted[entity.id] = *kind;
  const SeatFinder finder(scene);
  std::vector<Place> places;
  for (const auto& [id, kind] : wanted) {
    const Box3f& box = scene.entity(id).bounds;
    if (kind == PlaceKind::kBench) {
      AddSeats(finder, id, box, mesh, places);
      continue;
    }
    if (kind == PlaceKind::kQueue) {
      AddLine(scene, id, mesh, places);
      continue;
    }
    // Others are stood before, a step away, facing them; signs hang above the pavement.
    const double low = kind == PlaceKind::kShop ? std::max(box.min.z - 4.0, mesh.bounds().min.z - 1.0) : box.min.z;
    const Vec3d centre{box.center().x, box.center().y, low};
    NavPoint near;
    for (const double z : {low, low + 1.5, low + 3.0}) {
      near = mesh.Nearest({centre.x, centre.y, z}, std::max<double>(box.size().x, box.size().y) / 2 + 2);
      if (near.valid()) break;
    }
    if (!near.valid() || mesh.Kind(near) == GroundKind::kRoad) continue;
    const double yaw = std::atan2(centre.y - near.p_W.y, centre.x - near.p_W.x);
    const NavPoint stand = mesh.Move(near, {near.p_W.x - 0.6 * std::cos(yaw), near.p_W.y - 0.6 * std::sin(yaw)});
    places.push_back({kind, stand, stand.p_W, yaw, {}});
  }
  return places;
}

}  // namespace airsim360::internal
