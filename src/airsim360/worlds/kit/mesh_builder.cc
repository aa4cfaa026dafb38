#include "airsim360/worlds/kit/mesh_builder.h"

#include <cmath>
#include <numeric>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/kit/vertex_welder.h"

namespace airsim360 {
namespace {

// Any unit vector across `axis`.
Vec3f Across(Vec3f axis) { return Normalized(Cross(axis, std::abs(axis.z) < 0.9f ? Vec3f{0, 0, 1} : Vec3f{1, 0, 0})); }

float SignedArea(Vec2f a, Vec2f b, Vec2f c) { return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y); }

}  // namespace

void MeshBuilder::Emit(Vec3f p, Vec3f n, Vec2f uv) {
  Group& group = groups_[{material_, entity_}];
  group.positions.push_back(X_ * p);
  group.normals.push_back(Normalized(X_.A * n));
  group.uvs.push_back(uv);
}

void MeshBuilder::SmoothTriangle(const Vec3f (&p)[3], const Vec3f (&n)[3], const Vec2f (&uv)[3]) {
  const bool mirrored = X_.A.determinant() < 0;
  for (int i : {0, mirrored ? 2 : 1, mirrored ? 1 : 2}) Emit(p[i], n[i], uv[i]);
}

void MeshBuilder::Triangle(Vec3f a, Vec3f b, Vec3f c, Vec2f uv_a, Vec2f uv_b, Vec2f uv_c) {
  const Vec3f n = Normalized(Cross(b - a, c - a));
  SmoothTriangle({a, b, c}, {n, n, n}, {uv_a, uv_b, uv_c});
}

void MeshBuilder::QuadUv(Vec3f a, Vec3f b, Vec3f c, Vec3f d, Vec2f uv_a, Vec2f uv_b, Vec2f uv_c, Vec2f uv_d) {
  Triangle(a, b, c, uv_a, uv_b, uv_c);
  Triangle(a, c, d, uv_a, uv_c, uv_d);
}

void MeshBuilder::Quad(Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
  const float w = Norm(b - a), h = Norm(d - a);
  QuadUv(a, b, c, d, {0, h}, {w, h}, {w, 0}, {0, 0});
}

void MeshBuilder::Box(Vec3f l, Vec3f h, unsigned sides) {
  if (sides & kFront) Quad({l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z});
  if (sides & kBack) Quad({h.x, h.y, l.z}, {l.x, h.y, l.z}, {l.x, h.y, h.z}, {h.x, h.y, h.z});
  if (sides & kLeft) Quad({l.x, h.y, l.z}, {l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z});
  if (sides & kRight) Quad({h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z}, {h.x, l.y, h.z});
  if (sides & kTop) Quad({l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
  if (sides & kBottom) Quad({l.x, h.y, l.z}, {h.x, h.y, l.z}, {h.x, l.y, l.z}, {l.x, l.y, l.z});
}

void MeshBuilder::Beam(Vec3f a, Vec3f b, float thickness) {
  const Vec3f axis = Normalized(b - a);
  const Vec3f s = Across(axis) * (thickness / 2), t = Cross(axis, s);
  const Vec3f corner[4] = {-s - t, s - t, s + t, t - s};
  for (int i = 0; i < 4; ++i) {
    const Vec3f p = corner[i], q = corner[(i + 1) % 4];
    Quad(a + p, a + q, b + q, b + p);
  }
  Quad(a + corner[3], a + corner[2], a + corner[1], a + corner[0]);
  Quad(b + corner[0], b + corner[1], b + corner[2], b + corner[3]);
}

void MeshBuilder::Tube(Vec3f a, Vec3f b, float ra, float rb, int sides, bool cap_a, bool cap_b) {
  const Vec3f axis = Normalized(b - a), s = Across(axis), t = Cross(axis, s);
  const float length = Norm(b - a), slope = length > 0 ? (ra - rb) / length : 0;
  const auto spoke = [&](int i) {
    const float angle = kTauF * static_cast<float>(i % sides) / static_cast<float>(sides);
    return s * std::cos(angle) + t * std::sin(angle);
  };
  for (int i = 0; i < sides; ++i) {
    const Vec3f d0 = spoke(i), d1 = spoke(i + 1);
    const Vec3f n0 = Normalized(d0 + axis * slope), n1 = Normalized(d1 + axis * slope);
    const float u0 = kTauF * ra * static_cast<float>(i) / static_cast<float>(sides);
    const float u1 = kTauF * ra * static_cast<float>(i + 1) / static_cast<float>(sides);
    const Vec3f p00 = a + d0 * ra, p10 = a + d1 * ra, p01 = b + d0 * rb, p11 = b + d1 * rb;
    if (ra > 0) SmoothTriangle({p00, p10, p11}, {n0, n1, n1}, {{u0, length}, {u1, length}, {u1, 0}});
    if (rb > 0) SmoothTriangle({p00, p11, p01}, {n0, n1, n0}, {{u0, length}, {u1, 0}, {u0, 0}});
    if (cap_a && ra > 0) Triangle(a, p10, p00);
    if (cap_b && rb > 0) Triangle(b, p01, p11);
  }
}

void MeshBuilder::Sphere(Vec3f center, Vec3f radii, int rings, int sides) {
  const auto direction = [&](int ring, int side) {
    const float polar = kTauF / 2 * static_cast<float>(ring) / static_cast<float>(rings);
    const float angle = kTauF * static_cast<float>(side % sides) / static_cast<float>(sides);
    const float r = ring == 0 || ring == rings ? 0.0f : std::sin(polar);
    return Vec3f{r * std::cos(angle), r * std::sin(angle), std::cos(polar)};
  };
  const auto normal = [&](Vec3f d) { return Normalized(Vec3f{d.x / radii.x, d.y / radii.y, d.z / radii.z}); };
  const float r = radii.x;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      const Vec3f d[4] = {direction(i + 1, j), direction(i + 1, j + 1), direction(i, j + 1), direction(i, j)};
      const float u0 = kTauF * r * static_cast<float>(j) / static_cast<float>(sides), u1 = u0 + kTauF * r / static_cast<float>(sides);
      const float v0 = kTauF / 2 * r * static_cast<float>(i) / static_cast<float>(rings),
                  v1 = v0 + kTauF / 2 * r / static_cast<float>(rings);
      const Vec2f uv[4] = {{u0, v1}, {u1, v1}, {u1, v0}, {u0, v0}};
      if (i + 1 < rings) {
        SmoothTriangle({center + d[0] * radii, center + d[1] * radii, center + d[2] * radii}, {normal(d[0]), normal(d[1]), normal(d[2])},
                       {uv[0], uv[1], uv[2]});
      }
      if (i > 0) {
        SmoothTriangle({center + d[0] * radii, center + d[2] * radii, center + d[3] * radii}, {normal(d[0]), normal(d[2]), normal(d[3])},
                       {uv[0], uv[2], uv[3]});
      }
    }
  }
}

void MeshBuilder::Polygon(std::span<const Vec2f> outline, float z, bool up) {
  for (Vec3u t : TriangulatePolygon(outline)) {
    if (!up) std::swap(t.y, t.z);
    const Vec2f a = outline[t.x], b = outline[t.y], c = outline[t.z];
    Triangle({a.x, a.y, z}, {b.x, b.y, z}, {c.x, c.y, z}, {a.x, -a.y}, {b.x, -b.y}, {c.x, -c.y});
  }
}

void MeshBuilder::Walls(std::span<const Vec2f> outline, float z0, float z1) {
  // Every outline begins somewhere else in the pattern, whole tiles of 24 m apart.
  float u = outline.empty() ? 0.0f : 24 * std::floor(std::fmod(std::abs(13 * outline[0].x + 7.7f * outline[0].y), 64.0f));
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vec2f a = outline[i], b = outline[(i + 1) % outline.size()];
    const float next = u + std::hypot(b.x - a.x, b.y - a.y);
    QuadUv({a.x, a.y, z0}, {b.x, b.y, z0}, {b.x, b.y, z1}, {a.x, a.y, z1}, {u, z1 - z0}, {next, z1 - z0}, {next, 0}, {u, 0});
    u = next;
  }
}

Mesh MeshBuilder::Finish(std::string name) {
  Mesh mesh;
  mesh.name = std::move(name);
  for (auto& entry : groups_) {
    const auto& key = entry.first;
    const Group& group = entry.second;
    internal::VertexWelder welder(mesh);
    const auto index = [&](size_t i) { return welder.Add(group.positions[i], group.normals[i], group.uvs[i]); };
    const auto first = static_cast<uint32_t>(mesh.triangles.size());
    for (size_t i = 0; i + 2 < group.positions.size(); i += 3) {
      const uint32_t a = index(i), b = index(i + 1), c = index(i + 2);
      mesh.triangles.push_back({a, b, c});
    }
    mesh.parts.push_back({first, static_cast<uint32_t>(mesh.triangles.size()) - first, key.first, key.second});
  }
  groups_.clear();
  return mesh;
}

std::vector<Vec3u> TriangulatePolygon(std::span<const Vec2f> outline) {
  std::vector<Vec3u> triangles;
  std::vector<uint32_t> rest(outline.size());
  std::iota(rest.begin(), rest.end(), 0u);
  const auto is_ear = [&](size_t i) {
    const size_t n = rest.size();
    const uint32_t ia = rest[(i + n - 1) % n], ib = rest[i], ic = rest[(i + 1) % n];
    const Vec2f a = outline[ia], b = outline[ib], c = outline[ic];
    if (SignedArea(a, b, c) <= 0) return false;
    for (uint32_t k : rest) {
      if (k == ia || k == ib || k == ic) continue;
      const Vec2f p = outline[k];
      if (SignedArea(a, b, p) >= 0 && SignedArea(b, c, p) >= 0 && SignedArea(c, a, p) >= 0) return false;
    }
    return true;
  };
  while (rest.size() >= 3) {
    size_t ear = 0;
    while (ear < rest.size() && !is_ear(ear)) ++ear;
    if (ear == rest.size()) ear = 0;  // degenerate remainder: clip anything so that the loop ends
    const size_t n = rest.size();
    triangles.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

}  // namespace airsim360
