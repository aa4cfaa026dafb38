#include "airsim360/people/navigation/ground_triangles.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace airsim360::internal {
namespace {

// Blades that feet go through; people and drones, which move.
bool LeaveOut(std::string_view path) {
  for (const std::string_view prefix : {"vegetation/grass_tuft", "human", "uav", "animal", "sky", "nature/mountain"})
    if (path.starts_with(prefix)) return true;
  return false;
}

Box3f Placed(const Box3f& box, const AffineTransform& X) {
  Box3f placed;
  for (int corner = 0; corner < 8; ++corner)
    placed.Add(X * Vec3f{corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z});
  return placed;
}

}  // namespace

GroundSource::GroundSource(const Scene& scene, const TileGrid& grid, double margin)
    : scene_(scene), grid_(grid), margin_(margin), tiles_(static_cast<size_t>(grid.count())) {
  // What every entity is for a walker.
  kinds_.assign(scene.entities.size() + 1, GroundKind::kNone);
  no_ground_ = true;
  for (const Entity& entity : scene.entities) {
    GroundKind kind = GroundKindOf(scene.tree, entity.category);
    if (kind != GroundKind::kNone) no_ground_ = false;
    if (LeaveOut(scene.tree[entity.category].path)) kind = GroundKind::kCount;
    kinds_[entity.id] = kind;
  }
  if (no_ground_) {
    for (GroundKind& kind : kinds_)
      if (kind == GroundKind::kNone) kind = GroundKind::kFloor;
  }
  mesh_bounds_.reserve(scene.meshes.size());
  for (const Mesh& mesh : scene.meshes) mesh_bounds_.push_back(mesh.Bounds());
  for (uint32_t i = 0; i < scene.instances.size(); ++i) AddInstance(i);
}

void GroundSource::AddInstance(uint32_t index) {
  const Instance& instance = scene_.instances[index];
  const Mesh& mesh = scene_.meshes[instance.mesh];
  if (mesh.triangles.empty()) return;
  const Box3f box = Placed(mesh_bounds_[instance.mesh], instance.X_WM);
  const bool split = box.size().x > grid_.edge || box.size().y > grid_.edge;
  for (const MeshPart& part : mesh.parts) {
    const EntityId entity = part.entity != kNoEntity ? part.entity : instance.entity;
    const GroundKind kind = entity < kinds_.size() ? kinds_[entity] : GroundKind::kNone;
    // Grass that belongs to its lawn: the lawn below it is the ground.
    const bool blades = kind != GroundKind::kNone && scene_.materials[part.material].kind == SurfaceKind::kFoliage;
    if (kind != GroundKind::kCount && !blades) AddRun({index, part.first_triangle, part.triangle_count, kind}, box, split);
  }
}

// Large instances go to their tiles triangle by triangle, small ones as a whole.
void GroundSource::AddRun(const Run& run, const Box3f& box, bool split) {
  const auto add = [&](const Run& piece, const Box3f& bounds) {
    const auto index = [&](double v, double origin, int n) {
      return static_cast<int>(std::clamp(std::floor((v - origin) / grid_.edge), -1.0, static_cast<double>(n)));
    };
    const int c0 = std::max(0, index(bounds.min.x - margin_, grid_.x0, grid_.columns));
    const int c1 = std::min(grid_.columns - 1, index(bounds.max.x + margin_, grid_.x0, grid_.columns));
    const int r0 = std::max(0, index(bounds.min.y - margin_, grid_.y0, grid_.rows));
    const int r1 = std::min(grid_.rows - 1, index(bounds.max.y + margin_, grid_.y0, grid_.rows));
    for (int r = r0; r <= r1; ++r) {
      for (int c = c0; c <= c1; ++c) {
        std::vector<Run>& runs = tiles_[static_cast<size_t>(r * grid_.columns + c)].runs;
        Run* last = runs.empty() ? nullptr : &runs.back();
        if (last && last->instance == piece.instance && last->kind == piece.kind && last->first + last->count == piece.first)
          last->count += piece.count;
        else
          runs.push_back(piece);
      }
    }
  };
  if (!split) return add(run, box);
  const Instance& instance = scene_.instances[run.instance];
  const Mesh& mesh = scene_.meshes[instance.mesh];
  for (uint32_t t = run.first; t < run.first + run.count; ++t) {
    Box3f bounds;
    for (int k = 0; k < 3; ++k) bounds.Add(instance.X_WM * mesh.positions[mesh.triangles[t][k]]);
    add({run.instance, t, 1, run.kind}, bounds);
  }
}

template <class Visit>
void GroundSource::Each(int tile, bool ground, const Visit& visit) const {
  const double x0 = grid_.x0 + (tile % grid_.columns) * grid_.edge - margin_;
  const double y0 = grid_.y0 + (tile / grid_.columns) * grid_.edge - margin_;
  const double x1 = x0 + grid_.edge + 2 * margin_, y1 = y0 + grid_.edge + 2 * margin_;
  for (const Run& run : tiles_[static_cast<size_t>(tile)].runs) {
    if ((run.kind != GroundKind::kNone) != ground) continue;
    const Instance& instance = scene_.instances[run.instance];
    const Mesh& mesh = scene_.meshes[instance.mesh];
    for (uint32_t t = run.first; t < run.first + run.count; ++t) {
      GroundTriangle triangle;
      triangle.kind = run.kind;
      Box3f box;
      for (int k = 0; k < 3; ++k) {
        triangle.p[k] = instance.X_WM * mesh.positions[mesh.triangles[t][k]];
        box.Add(triangle.p[k]);
      }
      if (box.max.x < x0 || box.min.x > x1 || box.max.y < y0 || box.min.y > y1) continue;
      visit(triangle, box);
    }
  }
}

void GroundSource::Gather(int tile, double headroom, std::vector<GroundTriangle>& ground, std::vector<GroundTriangle>& obstacles) const {
  ground.clear();
  obstacles.clear();
  float low = 1e9f, high = -1e9f;
  Each(tile, true, [&](const GroundTriangle& triangle, const Box3f& box) {
    ground.push_back(triangle);
    low = std::min(low, box.min.z);
    high = std::max(high, box.max.z);
  });
  if (ground.empty()) return;
  Each(tile, false, [&](const GroundTriangle& triangle, const Box3f& box) {
    if (box.max.z > low - 0.5f && box.min.z < high + headroom) obstacles.push_back(triangle);
  });
}

}  // namespace airsim360::internal
