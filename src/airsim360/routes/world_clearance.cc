#include "airsim360/routes/world_clearance.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <unordered_map>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/math/box_overlap.h"
#include "airsim360/planning/routes/search.h"
#include "airsim360/routes/roadmap.h"

namespace airsim360 {
namespace {

// Single precision of coordinates and of a dozen operations on them, relative to the largest coordinate.
constexpr double kFloatRounding = 0x1p-20;
constexpr double kMaxVoxels = 64e6;
constexpr double kMapVoxel = 0.5, kMapMargin = 40;  // metres; of a map around points

}  // namespace

WorldClearance::WorldClearance(std::shared_ptr<const RayTracer> tracer, std::shared_ptr<const ClearanceField> field)
    : tracer_(std::move(tracer)), field_(std::move(field)) {}

double WorldClearance::Clearance(Vec3d p, double max_distance) const {
  const double error = kFloatRounding * (std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) + max_distance);
  const double reach = max_distance + error;
  const double distance = tracer_->Clearance(VecCast<float>(p), static_cast<float>(reach));
  return std::clamp(distance - error, 0.0, max_distance);
}

double WorldClearance::LowerBound(Vec3d p, double enough, double max_distance) const {
  const double bound = field_ ? field_->At(p) : 0;
  return bound >= enough ? bound : Clearance(p, max_distance);
}

namespace {

// What stands for a mesh in a map: boxes around its small triangles, cell by cell, and its large triangles.
struct MeshOutline {
  std::vector<Box3f> boxes;
  std::vector<uint32_t> triangles;
};

MeshOutline OutlineOf(const Mesh& mesh, float cell) {
  MeshOutline outline;
  std::unordered_map<uint64_t, Box3f> cells;
  const Box3f bounds = mesh.Bounds();
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vec3u t = mesh.triangles[i];
    Box3f box;
    for (const uint32_t v : {t.x, t.y, t.z}) box.Add(mesh.positions[v]);
    const Vec3f size = box.size();
    if (std::max({size.x, size.y, size.z}) > cell) {
      outline.triangles.push_back(i);
      continue;
    }
    const Vec3f at = (box.center() - bounds.min) / cell;
    const auto key = (static_cast<uint64_t>(at.x) << 42) | (static_cast<uint64_t>(at.y) << 21) | static_cast<uint64_t>(at.z);
    cells[key].Add(box);
  }
  // The order does not matter: a map is the same for any.
  for (const auto& [key, box] : cells) outline.boxes.push_back(box);
  return outline;
}

double LargestScale(const Mat3f& A) {
  double largest = 0;
  for (int i = 0; i < 3; ++i) largest = std::max(largest, static_cast<double>(Norm(A.column(i))));
  return largest;
}

// Box of a box after an affine map.
Box3d Transformed(const AffineTransform& X, const Box3f& box) {
  const Vec3f half = box.size() * 0.5f;
  const Vec3d center = VecCast<double>(X * box.center());
  Vec3d reach;
  for (int i = 0; i < 3; ++i)
    reach[i] = std::fabs(X.A.m[i][0]) * half.x + std::fabs(X.A.m[i][1]) * half.y + std::fabs(X.A.m[i][2]) * half.z;
  const double error = kFloatRounding * (Norm(center) + Norm(reach));
  reach += Vec3d{error, error, error};
  return {center - reach, center + reach};
}

}  // namespace

std::shared_ptr<const ClearanceField> MapScene(const Scene& scene, const Box3d& box, double voxel) {
  const Vec3d extent = box.max - box.min;
  voxel = std::max(voxel, std::cbrt(extent.x * extent.y * extent.z / kMaxVoxels) * 1.01);
  ClearanceFieldBuilder builder(box, voxel);

  // Meshes that stand often and have many triangles are drawn from boxes of half a voxel at most.
  std::vector<int> uses(scene.meshes.size());
  std::vector<float> scale(scene.meshes.size());
  for (const Instance& instance : scene.instances) {
    ++uses[instance.mesh];
    scale[instance.mesh] = std::max(scale[instance.mesh], static_cast<float>(LargestScale(instance.X_WM.A)));
  }
  std::vector<MeshOutline> outlines(scene.meshes.size());
  std::vector<Box3f> bounds(scene.meshes.size());
  ParallelFor(static_cast<int64_t>(scene.meshes.size()), [&](int64_t m) {
    bounds[m] = scene.meshes[m].Bounds();
    if (uses[m] > 1 && scale[m] > 0) outlines[m] = OutlineOf(scene.meshes[m], static_cast<float>(voxel / 2) / scale[m]);
  });

  constexpr int64_t kPortion = 64;  // instances
  const auto count = static_cast<int64_t>(scene.instances.size());
  ParallelFor((count + kPortion - 1) / kPortion, [&](int64_t k) {
    for (int64_t i = k * kPortion; i < std::min(count, (k + 1) * kPortion); ++i) {
      const Instance& instance = scene.instances[i];
      const Mesh& mesh = scene.meshes[instance.mesh];
      const AffineTransform& X = instance.X_WM;
      if (mesh.triangles.empty() || !Overlap(Transformed(X, bounds[instance.mesh]), box)) continue;
      const auto add = [&](uint32_t triangle) {
        const Vec3u t = mesh.triangles[triangle];
        builder.Add(VecCast<double>(X * mesh.positions[t.x]), VecCast<double>(X * mesh.positions[t.y]),
                    VecCast<double>(X * mesh.positions[t.z]));
      };
      const MeshOutline& outline = outlines[instance.mesh];
      for (const Box3f& part : outline.boxes) builder.Add(Transformed(X, part));
      for (const uint32_t triangle : outline.triangles) add(triangle);
      if (uses[instance.mesh] > 1) continue;
      for (uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) add(triangle);
    }
  });
  return std::make_shared<const ClearanceField>(builder.Build());
}

Box3d FlightBox(const RayTracer& tracer, double ceiling) {
  const Scene& scene = tracer.scene();
  const Box3d all{VecCast<double>(scene.bounds.min), VecCast<double>(scene.bounds.max)};
  if (scene.sky_entity == kNoEntity) return all;
  const Box2d ground = InhabitedGround(scene);
  Box3d box{{ground.min.x, ground.min.y, all.min.z}, {ground.max.x, ground.max.y, all.min.z}};
  // Up to the highest thing that stands there, not to mountains on the horizon.
  for (const Entity& entity : scene.entities) {
    const Vec3f c = entity.bounds.center(), size = entity.bounds.size();
    if (entity.bounds.empty() || c.x < box.min.x || c.x > box.max.x || c.y < box.min.y || c.y > box.max.y) continue;
    if (std::max(size.x, size.y) > 2 * std::max(box.max.x - box.min.x, box.max.y - box.min.y)) continue;
    box.max.z = std::max(box.max.z, static_cast<double>(entity.bounds.max.z));
  }
  box.max.z += ceiling;
  return box;
}

FlightSpace::FlightSpace(std::shared_ptr<const RayTracer> tracer) : tracer_(std::move(tracer)), limits_(FlightBox(*tracer_)) {}

const BoundedClearance& FlightSpace::Around(std::span<const Vec3d> points) {
  Box3d box{points.front(), points.front()};
  for (const Vec3d p : points) box = {Min(box.min, p), Max(box.max, p)};
  if (bounded_ && mapped_.Contains(box.min) && mapped_.Contains(box.max)) return *bounded_;
  mapped_ = BoxAround(box.min, box.max, kMapMargin, limits_);
  std::shared_ptr<const ClearanceField> map;
  const Vec3d size = mapped_.max - mapped_.min;
  if (size.x > 1 && size.y > 1 && size.z > 1) {
    const double fine = std::min(kMapVoxel, std::min({size.x, size.y, size.z}) / 40);
    map = MapScene(tracer_->scene(), mapped_, fine);
  }
  clearance_ = std::make_unique<WorldClearance>(tracer_, map);
  bounded_ = std::make_unique<BoundedClearance>(*clearance_, limits_);
  return *bounded_;
}

void CheckAboveGround(const RayTracer& tracer, Vec3d p, const std::string& name) {
  const Scene& scene = tracer.scene();
  if (scene.sky_entity == kNoEntity || !scene.spawn || !tracer.Intersect(*scene.spawn, {0, 0, -1})) return;
  if (tracer.Intersect(VecCast<float>(p), {0, 0, -1})) return;
  char text[96];
  std::snprintf(text, sizeof(text), " (%.2f, %.2f, %.2f) has no ground below", p.x, p.y, p.z);
  throw InputError(name + text);
}

}  // namespace airsim360
