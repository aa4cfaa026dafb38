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
  float t = 0;      ///< metres along the ray, whose direction is a unit vector
  Vec3f n;          ///< of the triangle, by the order of its corners
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

/// The first hit of any side, by Moeller and Trumbore; edges count as inside.
inline std::optional<TestHit> FirstHit(const Mesh& mesh, Vec3f origin, Vec3f direction) {
  std::optional<TestHit> best;
  ForTriangles(mesh, [&](const MeshPart& part, Vec3f a, Vec3f b, Vec3f c) {
    const Vec3d e1 = VecCast<double>(b - a), e2 = VecCast<double>(c - a), d = VecCast<double>(direction);
    const Vec3d p = Cross(d, e2), s = VecCast<double>(origin - a), q = Cross(s, e1);
    const double det = Dot(e1, p);
    if (std::abs(det) < 1e-9) return;
    const double u = Dot(s, p) / det, v = Dot(d, q) / det, t = Dot(e2, q) / det;
    if (u < -1e-6 || v < -1e-6 || u + v > 1 + 1e-6 || t < 0) return;
    if (best && static_cast<double>(best->t) <= t) return;
    best = {static_cast<float>(t), Normalized(Cross(b - a, c - a)), part.material, part.entity};
  });
  return best;
}

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

/// What is wrong with the numbers of a mesh: "" where all is finite, normals are units on the side of their faces, indices and
/// parts fit. `sides`: also ask for the side of the normals.
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
    return x.first_triangle == y.first_triangle && x.triangle_count == y.triangle_count && x.material == y.material &&
           x.entity == y.entity;
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
