#include "airsim360/people/navigation/crossings.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "airsim360/math/angles.h"
#include "airsim360/people/navigation/polygon2d.h"

namespace airsim360::internal {
namespace {

constexpr double kLightReach = 8;  // metres from a crossing to a traffic light that belongs to it

std::vector<Vec2d> CornersOf(const Box3f& box) {
  return {{box.min.x, box.min.y}, {box.max.x, box.min.y}, {box.max.x, box.max.y}, {box.min.x, box.max.y}};
}

/// Direction of the longest edge of a hull, radians in [0, pi).
double LongAxis(const std::vector<Vec2d>& hull) {
  double longest = 0, angle = 0;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Vec2d d = hull[(i + 1) % hull.size()] - hull[i];
    const double n = d.x * d.x + d.y * d.y;
    if (n <= longest) continue;
    longest = n;
    angle = std::atan2(d.y, d.x);
  }
  return angle < 0 ? angle + kPi : angle >= kPi ? angle - kPi : angle;
}

}  // namespace

std::vector<NavMesh::Crossing> FindCrossings(const Scene& scene) {
  // Outlines of all stripes of an entity.
  std::map<EntityId, std::vector<Vec2d>> points;
  for (const Entity& entity : scene.entities)
    if (GroundKindOf(scene.tree, entity.category) == GroundKind::kCrossing) points[entity.id];
  if (points.empty()) return {};
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const MeshPart& part : mesh.parts) {
      const auto found = points.find(part.entity != kNoEntity ? part.entity : instance.entity);
      if (found == points.end()) continue;
      for (uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t)
        for (int k = 0; k < 3; ++k) {
          const Vec3f p = instance.X_WM * mesh.positions[mesh.triangles[t][k]];
          found->second.push_back({p.x, p.y});
        }
    }
  }

  // Where the lights stand.
  std::vector<Vec2d> lights;
  for (const Entity& entity : scene.entities)
    if (scene.tree[entity.category].path.starts_with("traffic/control/traffic_light") && !entity.bounds.empty())
      lights.push_back({entity.bounds.center().x, entity.bounds.center().y});

  std::vector<NavMesh::Crossing> crossings;
  for (auto& [entity, corners] : points) {
    NavMesh::Crossing crossing{.outline = ConvexHull(std::move(corners)), .entity = entity};
    if (crossing.outline.size() < 3) continue;
    if (crossing.outline.size() > 12) crossing.outline = CornersOf(scene.entity(entity).bounds);
    for (const Vec2d light : lights)
      for (const Vec2d corner : crossing.outline) crossing.signal |= std::hypot(light.x - corner.x, light.y - corner.y) < kLightReach;
    const double axis = LongAxis(crossing.outline);
    crossing.phase = axis > 0.785 && axis < 2.356 ? 1 : 0;
    crossings.push_back(std::move(crossing));
  }
  return crossings;
}

}  // namespace airsim360::internal
