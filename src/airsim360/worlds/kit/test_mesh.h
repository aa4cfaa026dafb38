// What tests ask of meshes: what a ray meets, areas, volumes, whether the numbers are sound.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "airsim360/scene/mesh.h"

namespace airsim360::internal {

/// What a ray meets first.
struct TestHit {
  float t = 0;  ///< metres along the ray, whose direction is a unit vector
  Vec3f n;      ///< of the triangle, by the order of its corners
  MaterialId material = 0;
  EntityId entity = kNoEntity;
};

/// Visits every triangle with its part: visit(part, a, b, c).
template <class Visit>
void ForTriangles(const Mesh& mesh, const Visit& visit) {
  for (const MeshPart& part : mesh.parts) {
    for (uint32_t i = part.first_triangle; i < part.first_triangle + part.triangle_count; ++i) {
      const Vec3u t = mesh.triangles[i];
      visit(part, mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
    }
  }
}

/// Rays through a mesh: its triangles in slices along one axis (0 x, 1 y, 2 z), so that rays across that axis
/// are quick.
class TestRays {
 public:
  explicit TestRays(const Mesh& mesh, int axis = 2) : axis_(axis) {
    const Box3f box = mesh.Bounds();
    low_ = mesh.positions.empty() ? 0 : box.min[axis];
    slices_.resize(mesh.positions.empty() ? 1 : Slice(box.max[axis], 1 << 20) + 1);
    ForTriangles(mesh, [&](const MeshPart& part, Vec3f a, Vec3f b, Vec3f c) {
      const size_t first = Slice(std::min({a[axis], b[axis], c[axis]}) - 1e-4f, slices_.size() - 1);
      const size_t last = Slice(std::max({a[axis], b[axis], c[axis]}) + 1e-4f, slices_.size() - 1);
      for (size_t i = first; i <= last; ++i) slices_[i].push_back({a, b, c, part.material, part.entity});
    });
  }
  /// The first hit within `length` metres, of any side, by Moeller and Trumbore; edges count as inside.
  std::optional<TestHit> First(Vec3f origin, Vec3f direction, float length = 100) const {
    const float at = origin[axis_], end = at + direction[axis_] * length;
    const size_t last = Slice(std::max(at, end), slices_.size() - 1);
    std::optional<TestHit> best;
    for (size_t i = Slice(std::min(at, end), slices_.size() - 1); i <= last; ++i) {
      for (const Triangle& triangle : slices_[i]) {
        const Vec3d e1 = VecCast<double>(triangle.b - triangle.a), e2 = VecCast<double>(triangle.c - triangle.a);
        const Vec3d d = VecCast<double>(direction), p = Cross(d, e2), s = VecCast<double>(origin - triangle.a), q = Cross(s, e1);
        const double det = Dot(e1, p);
        if (std::abs(det) < 1e-9) continue;
        const double u = Dot(s, p) / det, v = Dot(d, q) / det, t = Dot(e2, q) / det;
        if (u < -1e-6 || v < -1e-6 || u + v > 1 + 1e-6 || t < 0 || t > static_cast<double>(length)) continue;
        if (best && static_cast<double>(best->t) <= t) continue;
        best = {static_cast<float>(t), Normalized(VecCast<float>(Cross(e1, e2))), triangle.material, triangle.entity};
      }
    }
    return best;
  }

 private:
  struct Triangle {
    Vec3f a, b, c;
    MaterialId material;
    EntityId entity;
  };
  size_t Slice(float x, size_t most) const { return static_cast<size_t>(std::clamp((x - low_) / 0.3f, 0.0f, static_cast<float>(most))); }
  int axis_;
  float low_ = 0;
  std::vector<std::vector<Triangle>> slices_;
};

/// Square metres of the triangles of one material within a band of heights.
inline double AreaOf(const Mesh& mesh, const std::set<MaterialId>& materials, float low = -1e9f, float high = 1e9f) {
  double area = 0;
  ForTriangles(mesh, [&](const MeshPart& part, Vec3f a, Vec3f b, Vec3f c) {
    if (!materials.contains(part.material) || std::min({a.z, b.z, c.z}) < low || std::max({a.z, b.z, c.z}) > high) return;
    area += static_cast<double>(Norm(Cross(b - a, c - a))) / 2;
  });
  return area;
}

/// By the divergence theorem: positive where the faces of a closed mesh look outwards.
inline double VolumeOf(const Mesh& mesh) {
  double sum = 0;
  ForTriangles(mesh, [&](const MeshPart&, Vec3f a, Vec3f b, Vec3f c) {
    sum += Dot(VecCast<double>(a), Cross(VecCast<double>(b), VecCast<double>(c))) / 6;
  });
  return sum;
}

/// What is wrong with the numbers of a mesh: "" where all is finite, normals are units on the side of their
/// faces, indices and parts fit. `sides`: also ask for the side of the normals.
inline std::string FaultOf(const Mesh& mesh, bool sides = true) {
  const size_t n = mesh.positions.size();
  if (mesh.normals.size() != n || mesh.uvs.size() != n) return "normals or uvs are missing";
  for (size_t i = 0; i < n; ++i) {
    const Vec3f p = mesh.positions[i];
    if (!std::isfinite(p.x + p.y + p.z)) return "position " + std::to_string(i);
    if (!(std::abs(Norm(mesh.normals[i]) - 1) < 1e-3f)) return "normal " + std::to_string(i);
    if (!std::isfinite(mesh.uvs[i].x + mesh.uvs[i].y)) return "uv " + std::to_string(i);
  }
  uint32_t next = 0;
  for (const MeshPart& part : mesh.parts) {
    if (part.first_triangle != next || part.triangle_count == 0) return "parts do not follow each other";
    next += part.triangle_count;
  }
  if (next != mesh.triangles.size()) return "parts do not cover the mesh";
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vec3u t = mesh.triangles[i];
    if (t.x >= n || t.y >= n || t.z >= n) return "index of triangle " + std::to_string(i);
    const Vec3f a = mesh.positions[t.x], f = Cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    const Vec3f shading = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    if (sides && Norm(f) > 1e-6f && Dot(f, shading) < 0) return "side of triangle " + std::to_string(i);
  }
  return "";
}

inline bool SameBytes(const Mesh& a, const Mesh& b) {
  const auto same_part = [](const MeshPart& x, const MeshPart& y) {
    return x.first_triangle == y.first_triangle && x.triangle_count == y.triangle_count && x.material == y.material && x.entity == y.entity;
  };
  return a.positions == b.positions && a.normals == b.normals && a.uvs == b.uvs && a.triangles == b.triangles &&
         std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(), same_part);
}

/// Twice the area of an outline by the shoelace formula, halved: positive counter-clockwise.
inline double Shoelace(const std::vector<Vec2f>& outline) {
  double twice = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vec2f a = outline[i], b = outline[(i + 1) % outline.size()];
    twice += static_cast<double>(a.x) * static_cast<double>(b.y) - static_cast<double>(b.x) * static_cast<double>(a.y);
  }
  return twice / 2;
}

}  // namespace airsim360::internal
