#include "airsim360/render/lights/lamp_parts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "airsim360/base/disjoint_sets.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

// Corners that lie in the same place are the same corner, whatever their index.
struct PlaceHash {
  size_t operator()(const std::array<uint32_t, 3>& k) const {
    return (k[0] * 0x9e3779b97f4a7c15ull) ^ (k[1] * 0xc2b2ae3d27d4eb4full) ^ (k[2] * 0x165667b19e3779f9ull);
  }
};

}  // namespace

bool Shines(const Material& m, const Environment& environment) {
  return m.emission.x + m.emission.y + m.emission.z > 0 && (!m.lamp || environment.lamps_on());
}

uint32_t MeshLamps::ShapeOf(uint32_t triangle) const {
  const auto at = std::lower_bound(shape_of.begin(), shape_of.end(), std::pair{triangle, 0u});
  return at != shape_of.end() && at->first == triangle ? at->second : LightTable::kNoLamp;
}

MeshLamps FindLamps(const Scene& scene, const Mesh& mesh, const Mat3f& A, const Environment& environment) {
  // Shining triangles; those without area have no light to give.
  MeshLamps lamps;
  std::vector<uint32_t> shining;
  std::vector<float> areas;
  for (const MeshPart& part : mesh.parts) {
    if (!Shines(scene.materials[part.material], environment)) continue;
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      const float area = PlaceTriangle(mesh, k, {A, {}}).area;
      if (!(area > 0) || !std::isfinite(area)) continue;
      shining.push_back(k);
      areas.push_back(area);
    }
  }

  // Joined by common corners.
  DisjointSets groups(shining.size());
  std::unordered_map<std::array<uint32_t, 3>, uint32_t, PlaceHash> first_at;
  for (uint32_t i = 0; i < shining.size(); ++i) {
    const Vec3u t = mesh.triangles[shining[i]];
    for (uint32_t corner : {t.x, t.y, t.z}) {
      const Vec3f p = mesh.positions[corner] + Vec3f{};  // minus zero becomes zero
      const std::array<uint32_t, 3> key{std::bit_cast<uint32_t>(p.x), std::bit_cast<uint32_t>(p.y), std::bit_cast<uint32_t>(p.z)};
      groups.Join(first_at.try_emplace(key, i).first->second, i);
    }
  }
  std::vector<uint32_t> shape_of_root(shining.size(), LightTable::kNoLamp);
  for (uint32_t i = 0; i < shining.size(); ++i) {
    uint32_t& shape = shape_of_root[groups.Root(i)];
    if (shape == LightTable::kNoLamp) {
      shape = static_cast<uint32_t>(lamps.shapes.size());
      lamps.shapes.emplace_back();
    }
    LampShape& s = lamps.shapes[shape];
    s.triangles.push_back(shining[i]);
    s.cumulative.push_back((s.cumulative.empty() ? 0 : s.cumulative.back()) + areas[i]);
    lamps.shape_of.emplace_back(shining[i], shape);
  }
  for (LampShape& s : lamps.shapes) {
    const float total = s.cumulative.back();
    for (float& c : s.cumulative) c /= total;
    s.cumulative.back() = 1;
  }
  std::sort(lamps.shape_of.begin(), lamps.shape_of.end());
  return lamps;
}

LampTriangle PlaceTriangle(const Mesh& mesh, uint32_t triangle, const AffineTransform& X_WM) {
  const Vec3u t = mesh.triangles[triangle];
  LampTriangle out{{X_WM * mesh.positions[t.x], X_WM * mesh.positions[t.y], X_WM * mesh.positions[t.z]}, {}, 0};
  Vec3f cross = Cross(out.corner[1] - out.corner[0], out.corner[2] - out.corner[0]);
  if (X_WM.A.determinant() < 0) cross = -cross;
  const float length = Norm(cross);
  out.area = 0.5f * length;
  if (length > 0) out.normal = cross / length;
  return out;
}

PlacedLamp PlaceLamp(const Mesh& mesh, const SurfaceTables& tables, const InstanceRecord& record, const AffineTransform& X_WM, Vec3f glow,
                     const LampShape& shape) {
  // Sums over the area.
  PlacedLamp out;
  Lamp& lamp = out.lamp;
  std::vector<Vec3f> normals;
  for (uint32_t k : shape.triangles) {
    const LampTriangle t = PlaceTriangle(mesh, k, X_WM);
    const uint32_t material = tables.triangles[record.first_triangle + k].material & ~kMirroredUv;
    lamp.area += t.area;
    lamp.center += (t.corner[0] + t.corner[1] + t.corner[2]) * (t.area / 3);
    lamp.facing += t.normal * t.area;
    lamp.power += tables.mean_emissions[material] * glow * (kPiF * t.area);
    lamp.beam = tables.BeamOf(record, tables.materials[material]);
    normals.push_back(t.normal);
    for (Vec3f p : t.corner) out.box.Add(p);
  }
  lamp.center = lamp.center / std::max(lamp.area, 1e-30f);

  // Bounds of place and direction.
  for (uint32_t k : shape.triangles) {
    for (Vec3f p : PlaceTriangle(mesh, k, X_WM).corner) lamp.radius = std::max(lamp.radius, Norm(p - lamp.center));
  }
  lamp.axis = Normalized(lamp.facing);
  if (Norm(lamp.facing) < 0.01f * lamp.area) {
    lamp.axis = {0, 0, 1};
    lamp.spread = kPiF;
  } else {
    for (Vec3f n : normals) lamp.spread = std::max(lamp.spread, std::acos(std::clamp(Dot(n, lamp.axis), -1.0f, 1.0f)));
  }
  return out;
}

}  // namespace airsim360::internal
