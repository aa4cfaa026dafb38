#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "airsim360/people/behaviour/plan.h"

namespace airsim360::internal {
namespace {

constexpr double kSeatWidth = 0.6, kFeetAhead = 0.1;
constexpr double kReach = 0.7, kReachOfChairs = 1.4;  // metres from the ground that is walked on to the feet before a seat

// In buildings that are furnished chairs are sat on too: at desks, at tables, in waiting rooms.
bool IsChair(std::string_view path) {
  for (const std::string_view prefix :
       {"furniture/seating/chair", "furniture/seating/office_chair", "furniture/seating/armchair", "furniture/sofa"})
    if (path.starts_with(prefix)) return true;
  return false;
}
bool IsFurnished(const Scene& scene) {
  return std::any_of(scene.entities.begin(), scene.entities.end(),
                     [&](const Entity& entity) { return scene.tree[entity.category].path.starts_with("construction/ceiling"); });
}

std::optional<PlaceKind> KindOfPlace(std::string_view path, bool furnished) {
  if (furnished && IsChair(path)) return PlaceKind::kBench;
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

/// Vertices of the entities asked for.
std::map<EntityId, std::vector<Vec3f>> Vertices(const Scene& scene, const std::map<EntityId, PlaceKind>& wanted) {
  std::map<EntityId, std::vector<Vec3f>> found;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const MeshPart& part : mesh.parts) {
      const auto entity = wanted.find(part.entity != kNoEntity ? part.entity : instance.entity);
      if (entity == wanted.end() || entity->second != PlaceKind::kBench) continue;
      std::vector<Vec3f>& list = found[entity->first];
      for (uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count && list.size() < 30000; ++t)
        for (int k = 0; k < 3; ++k) list.push_back(instance.X_WM * mesh.positions[mesh.triangles[t][k]]);
    }
  }
  return found;
}

/// Seats of a bench side by side. Its back rest, if it has one, says where its front is.
void AddSeats(const std::vector<Vec3f>& vertices, const Box3f& box, const NavMesh& mesh, double reach, std::vector<Place>& places) {
  const Vec2d centre{box.center().x, box.center().y};
  Box3f back;
  for (const Vec3f& v : vertices)
    if (v.z > box.min.z + 0.6f) back.Add(v);
  Vec2d front{};
  if (!back.empty()) front = centre - Vec2d{back.center().x, back.center().y};
  if (std::hypot(front.x, front.y) < 0.04) {
    // No back rest: towards the nearest ground to walk on.
    const NavPoint near = mesh.Nearest({centre.x, centre.y, box.min.z}, 1.5);
    if (!near.valid()) return;
    front = Vec2d{near.p_W.x, near.p_W.y} - centre;
  }
  const double length = std::hypot(front.x, front.y);
  if (length < 1e-6) return;
  front = front * (1 / length);
  const Vec2d side{-front.y, front.x};
  double depth = 0, half = 0;
  for (const Vec3f& v : vertices) {
    const Vec2d d = Vec2d{v.x, v.y} - centre;
    if (v.z < box.min.z + 0.6f) depth = std::max(depth, d.x * front.x + d.y * front.y);
    half = std::max(half, std::abs(d.x * side.x + d.y * side.y));
  }
  const int seats = std::clamp(static_cast<int>(2 * half / kSeatWidth), 1, 6);
  for (int i = 0; i < seats; ++i) {
    const Vec2d p = centre + front * (depth + kFeetAhead) + side * (kSeatWidth * (i - (seats - 1) / 2.0));
    const NavPoint approach = mesh.Nearest({p.x, p.y, box.min.z}, reach);
    if (!approach.valid()) continue;
    places.push_back({PlaceKind::kBench, approach, {p.x, p.y, mesh.GroundHeight(p.x, p.y, approach.p_W.z)}, std::atan2(front.y, front.x)});
  }
}

}  // namespace

std::vector<Place> FindPlaces(const Scene& scene, const NavMesh& mesh) {
  std::map<EntityId, PlaceKind> wanted;
  const bool furnished = IsFurnished(scene);
  for (const Entity& entity : scene.entities)
    if (const auto kind = KindOfPlace(scene.tree[entity.category].path, furnished); kind && !entity.bounds.empty())
      wanted[entity.id] = *kind;
  const std::map<EntityId, std::vector<Vec3f>> vertices = Vertices(scene, wanted);
  std::vector<Place> places;
  for (const auto& [id, kind] : wanted) {
    const Box3f& box = scene.entity(id).bounds;
    if (kind == PlaceKind::kBench) {
      if (const auto found = vertices.find(id); found != vertices.end())
        AddSeats(found->second, box, mesh, IsChair(scene.tree[scene.entity(id).category].path) ? kReachOfChairs : kReach, places);
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
    places.push_back({kind, stand, stand.p_W, yaw});
  }
  return places;
}

}  // namespace airsim360::internal
