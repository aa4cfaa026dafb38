#include "airsim360/vln/language/surface_points.h"

#include <algorithm>
#include <cmath>

namespace airsim360::internal {
namespace {

// The i-th number of van der Corput's sequence: the bits of i mirrored at the point.
double Mirrored(uint32_t i) {
  double value = 0;
  for (double digit = 0.5; i > 0; i >>= 1, digit /= 2) value += digit * (i & 1U);
  return value;
}

// Some place of a triangle, evenly: Roberts' sequence R2, folded into it.
Vec3f PlaceIn(Vec3f a, Vec3f b, Vec3f c, int i) {
  double u = std::fmod(0.5 + 0.7548776662466927 * i, 1.0), v = std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return a + (b - a) * static_cast<float>(u) + (c - a) * static_cast<float>(v);
}

}  // namespace

const SurfacePoints::Spread& SurfacePoints::SpreadOf(uint32_t mesh_index, uint32_t part_index) const {
  const std::lock_guard lock(mutex_);
  const auto [entry, is_new] = spreads_.try_emplace({mesh_index, part_index});
  Spread& spread = entry->second;
  if (!is_new) return spread;
  const Mesh& mesh = scene_->meshes[mesh_index];
  const MeshPart& part = mesh.parts[part_index];
  std::vector<double> up_to;
  for (uint32_t t = 0; t < part.triangle_count; ++t) {
    const Vec3u corner = mesh.triangles[part.first_triangle + t];
    const Vec3f a = mesh.positions[corner.x], b = mesh.positions[corner.y], c = mesh.positions[corner.z];
    spread.area += 0.5 * static_cast<double>(Norm(Cross(b - a, c - a)));
    up_to.push_back(spread.area);
  }
  for (int i = 0; i < kMost && spread.area > 0; ++i) {
    const auto at = std::ranges::upper_bound(up_to, Mirrored(static_cast<uint32_t>(i)) * spread.area) - up_to.begin();
    const Vec3u corner = mesh.triangles[part.first_triangle + std::min<size_t>(at, up_to.size() - 1)];
    spread.points.push_back(PlaceIn(mesh.positions[corner.x], mesh.positions[corner.y], mesh.positions[corner.z], i));
  }
  return spread;
}

std::vector<Vec3d> SurfacePoints::Of(EntityId entity) const {
  double area = 0;
  for (const EntityPart& p : parts_.at(entity)) area += SpreadOf(scene_->instances[p.instance].mesh, p.part).area;
  std::vector<Vec3d> points;
  double up_to = 0;
  for (const EntityPart& p : parts_.at(entity)) {
    const Instance& instance = scene_->instances[p.instance];
    const Spread& spread = SpreadOf(instance.mesh, p.part);
    // Rounded so that what many small parts lose one by one is not lost: a shelf is mostly books.
    const double before = up_to;
    up_to += kMost * spread.area / std::max(area, 1e-12);
    const auto share = static_cast<size_t>(std::floor(up_to + 0.5) - std::floor(before + 0.5));
    // The first of a part that gets one of its points at a time would always be the same corner of it.
    const size_t first = share < 4 ? points.size() % kMost : 0;
    for (size_t i = 0; i < share && i < spread.points.size(); ++i)
      points.push_back(VecCast<double>(instance.X_WM * spread.points[(first + i) % spread.points.size()]));
  }
  return points;
}

}  // namespace airsim360::internal
