#include "airsim360/worlds/props/prop_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

constexpr float kCreaseCosine = 0.766f;  // corners sharper than 40 degrees stay sharp

auto Fields(const Material& m) {
  return std::tie(m.name, m.kind, m.alpha_mode, m.alpha_cutoff, m.base_color, m.base_alpha, m.metallic, m.roughness, m.emission, m.lamp,
                  m.beam, m.normal_scale, m.transmission, m.macro_variation, m.base_color_texture, m.metallic_roughness_texture,
                  m.normal_texture, m.emission_texture, m.uv_scale, m.uv_offset, m.uv_rotation);
}

Vec2f Unit(Vec2f v) {
  const float n = std::hypot(v.x, v.y);
  return n > 0 ? v * (1 / n) : Vec2f{1, 0};
}

// Normals at both ends of every segment of a polyline whose outside is on its right, averaged over blunt
// corners.
std::vector<std::pair<Vec2f, Vec2f>> ProfileNormals(std::span<const Vec2f> line, bool closed) {
  const size_t n = line.size(), segments = closed ? n : n - 1;
  std::vector<Vec2f> flat(segments);
  for (size_t i = 0; i < segments; ++i) {
    const Vec2f d = Unit(line[(i + 1) % n] - line[i]);
    flat[i] = {d.y, -d.x};
  }
  const auto meet = [&](size_t i, size_t j) {
    const bool blunt = flat[i].x * flat[j].x + flat[i].y * flat[j].y > kCreaseCosine;
    return blunt ? Unit(flat[i] + flat[j]) : flat[i];
  };
  std::vector<std::pair<Vec2f, Vec2f>> normals(segments);
  for (size_t i = 0; i < segments; ++i) {
    normals[i].first = i > 0 || closed ? meet(i, (i + segments - 1) % segments) : flat[i];
    normals[i].second = i + 1 < segments || closed ? meet(i, (i + 1) % segments) : flat[i];
  }
  return normals;
}

Vec3f Across(Vec3f axis) { return Normalized(Cross(axis, std::abs(axis.z) < 0.9f ? Vec3f{0, 0, 1} : Vec3f{1, 0, 0})); }

}  // namespace

bool SameMaterial(const Material& a, const Material& b) { return Fields(a) == Fields(b); }

AffineTransform Turn(float x_deg, float y_deg, float z_deg, Vec3f p) {
  constexpr double kDeg = std::numbers::pi / 180;
  const Mat3d R = RotationZ(z_deg * kDeg) * RotationY(y_deg * kDeg) * RotationX(x_deg * kDeg);
  AffineTransform X;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X.A.m[i][j] = static_cast<float>(R.m[i][j]);
  }
  X.p = p;
  return X;
}

void PropBuilder::Use(const Material& material) {
  const auto same = [&](const Material& m) { return SameMaterial(m, material); };
  auto it = std::find_if(model_.materials.begin(), model_.materials.end(), same);
  if (it == model_.materials.end()) it = model_.materials.insert(it, material);
  mesh_.SetMaterial(static_cast<MaterialId>(it - model_.materials.begin()));
}

void PropBuilder::Use(Material material, const Texture& base_color, Vec2f tile, const Texture* normal) {
  const auto add = [&](const Texture& texture) {
    auto& all = model_.textures;
    auto it = std::find_if(all.begin(), all.end(), [&](const Texture& t) { return t.name == texture.name; });
    if (it == all.end()) it = all.insert(it, texture);
    return static_cast<TextureId>(it - all.begin());
  };
  material.name += " " + base_color.name;
  material.base_color_texture = add(base_color);
  if (material.emission != Vec3f{}) material.emission_texture = material.base_color_texture;
  if (normal) material.normal_texture = add(*normal);
  material.uv_scale = {1 / tile.x, 1 / tile.y};
  Use(material);
}

void PropBuilder::BevelBox(Vec3f lo, Vec3f hi, float bevel) {
  const Vec3f center = (lo + hi) * 0.5f, half = (hi - lo) * 0.5f;
  const float b = std::min({bevel, half.x, half.y, half.z});
  // The corner vertex of octant `s` (signs) that belongs to the face of axis `a`.
  const auto corner = [&](Vec3f s, int a) {
    Vec3f p;
    for (int i = 0; i < 3; ++i) p[i] = center[i] + s[i] * (half[i] - (i == a ? 0 : b));
    return p;
  };
  const auto axis_normal = [](Vec3f s, int a) {
    Vec3f n;
    n[a] = s[a];
    return n;
  };
  const auto triangle = [&](Vec3f p0, Vec3f n0, Vec3f p1, Vec3f n1, Vec3f p2, Vec3f n2, int u, int v) {
    if (Dot(Cross(p1 - p0, p2 - p0), n0 + n1 + n2) < 0) {
      std::swap(p1, p2);
      std::swap(n1, n2);
    }
    mesh_.SmoothTriangle({p0, p1, p2}, {n0, n1, n2}, {{p0[u], -p0[v]}, {p1[u], -p1[v]}, {p2[u], -p2[v]}});
  };
  // For each axis: two flat faces, four strips to the neighbouring axis along the third one.
  for (int a = 0; a < 3; ++a) {
    const int u = a == 0 ? 1 : 0, v = a == 2 ? 1 : 2, next = (a + 1) % 3, third = (a + 2) % 3;
    for (float sign : {-1.0f, 1.0f}) {
      Vec3f s[4];
      for (int k = 0; k < 4; ++k) {
        s[k][a] = sign;
        s[k][u] = k == 0 || k == 3 ? -1.0f : 1.0f;
        s[k][v] = k < 2 ? -1.0f : 1.0f;
      }
      const Vec3f n = axis_normal(s[0], a);
      triangle(corner(s[0], a), n, corner(s[1], a), n, corner(s[2], a), n, u, v);
      triangle(corner(s[0], a), n, corner(s[2], a), n, corner(s[3], a), n, u, v);
      for (float other : {-1.0f, 1.0f}) {
        Vec3f e0, e1;
        e0[a] = e1[a] = sign;
        e0[next] = e1[next] = other;
        e0[third] = -1;
        e1[third] = 1;
        const Vec3f na = axis_normal(e0, a), nb = axis_normal(e0, next);
        triangle(corner(e0, a), na, corner(e1, a), na, corner(e1, next), nb, u, v);
        triangle(corner(e0, a), na, corner(e1, next), nb, corner(e0, next), nb, u, v);
      }
    }
  }
  for (int k = 0; k < 8; ++k) {
    const Vec3f s{k & 1 ? 1.0f : -1.0f, k & 2 ? 1.0f : -1.0f, k & 4 ? 1.0f : -1.0f};
    triangle(corner(s, 0), axis_normal(s, 0), corner(s, 1), axis_normal(s, 1), corner(s, 2), axis_normal(s, 2), 0, 1);
  }
}

void PropBuilder::Lathe(std::span<const Vec2f> profile, int sides, Vec3f base) {
  const auto normals = ProfileNormals(profile, false);
  float widest = 0;
  for (Vec2f p : profile) widest = std::max(widest, p.x);
  float v = 0;
  for (size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vec2f p0 = profile[i], p1 = profile[i + 1];
    const float v1 = v - std::hypot(p1.x - p0.x, p1.y - p0.y);
    for (int j = 0; j < sides; ++j) {
      const float a0 = kTauF * static_cast<float>(j) / static_cast<float>(sides);
      const float a1 = kTauF * static_cast<float>((j + 1) % sides) / static_cast<float>(sides);
      const auto at = [&](Vec2f rz, float a) { return base + Vec3f{rz.x * std::cos(a), rz.x * std::sin(a), rz.y}; };
      const auto out = [&](Vec2f n, float a) { return Vec3f{n.x * std::cos(a), n.x * std::sin(a), n.y}; };
      const float u0 = widest * kTauF * static_cast<float>(j) / static_cast<float>(sides);
      const float u1 = widest * kTauF * static_cast<float>(j + 1) / static_cast<float>(sides);
      const Vec2f n0 = normals[i].first, n1 = normals[i].second;
      if (p0.x > 0)
        mesh_.SmoothTriangle({at(p0, a0), at(p0, a1), at(p1, a1)}, {out(n0, a0), out(n0, a1), out(n1, a1)}, {{u0, v}, {u1, v}, {u1, v1}});
      if (p1.x > 0)
        mesh_.SmoothTriangle({at(p0, a0), at(p1, a1), at(p1, a0)}, {out(n0, a0), out(n1, a1), out(n1, a0)}, {{u0, v}, {u1, v1}, {u0, v1}});
    }
    v = v1;
  }
}

void PropBuilder::Bar(std::span<const Vec3f> path, std::span<const float> radii, int sides) {
  const size_t n = path.size();
  const auto radius = [&](size_t i) { return radii[std::min(i, radii.size() - 1)]; };
  // A frame per point, carried along without twist.
  std::vector<Vec3f> axis(n), side(n);
  for (size_t i = 0; i < n; ++i) {
    axis[i] = Normalized(path[std::min(i + 1, n - 1)] - path[i > 0 ? i - 1 : 0]);
    const Vec3f s = i > 0 ? side[i - 1] : Across(axis[0]);
    side[i] = Normalized(s - axis[i] * Dot(s, axis[i]));
  }
  const auto spoke = [&](size_t i, int j) {
    const float a = kTauF * static_cast<float>(j % sides) / static_cast<float>(sides);
    return side[i] * std::cos(a) + Cross(axis[i], side[i]) * std::sin(a);
  };
  float v = 0;
  for (size_t i = 0; i + 1 < n; ++i) {
    const float v1 = v - Norm(path[i + 1] - path[i]);
    for (int j = 0; j < sides; ++j) {
      const Vec3f n00 = spoke(i, j), n10 = spoke(i, j + 1), n01 = spoke(i + 1, j), n11 = spoke(i + 1, j + 1);
      const Vec3f p00 = path[i] + n00 * radius(i), p10 = path[i] + n10 * radius(i);
      const Vec3f p01 = path[i + 1] + n01 * radius(i + 1), p11 = path[i + 1] + n11 * radius(i + 1);
      const float u0 = kTauF * radius(0) * static_cast<float>(j) / static_cast<float>(sides);
      const float u1 = kTauF * radius(0) * static_cast<float>(j + 1) / static_cast<float>(sides);
      mesh_.SmoothTriangle({p00, p10, p11}, {n00, n10, n11}, {{u0, v}, {u1, v}, {u1, v1}});
      if (radius(i + 1) > 0) mesh_.SmoothTriangle({p00, p11, p01}, {n00, n11, n01}, {{u0, v}, {u1, v1}, {u0, v1}});
    }
    v = v1;
  }
  for (int j = 0; j < sides; ++j) {
    mesh_.Triangle(path[0], path[0] + spoke(0, j + 1) * radius(0), path[0] + spoke(0, j) * radius(0));
    if (radius(n - 1) > 0)
      mesh_.Triangle(path[n - 1], path[n - 1] + spoke(n - 1, j) * radius(n - 1), path[n - 1] + spoke(n - 1, j + 1) * radius(n - 1));
  }
}

void PropBuilder::Prism(std::span<const Vec2f> outline, float z0, float z1) {
  const auto normals = ProfileNormals(outline, true);
  float u = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vec2f a = outline[i], b = outline[(i + 1) % outline.size()];
    const float u1 = u + std::hypot(b.x - a.x, b.y - a.y);
    const Vec3f na{normals[i].first.x, normals[i].first.y, 0}, nb{normals[i].second.x, normals[i].second.y, 0};
    const Vec3f p[4] = {{a.x, a.y, z0}, {b.x, b.y, z0}, {b.x, b.y, z1}, {a.x, a.y, z1}};
    mesh_.SmoothTriangle({p[0], p[1], p[2]}, {na, nb, nb}, {{u, -z0}, {u1, -z0}, {u1, -z1}});
    mesh_.SmoothTriangle({p[0], p[2], p[3]}, {na, nb, na}, {{u, -z0}, {u1, -z1}, {u, -z1}});
    u = u1;
  }
  mesh_.Polygon(outline, z0, false);
  mesh_.Polygon(outline, z1, true);
}

void PropBuilder::Sheet(int nu, int nv, const std::function<Vec3f(float, float)>& at, Vec2f size) {
  // Normals from differences that stay inside the sheet.
  const auto normal = [&](float u, float v) {
    constexpr float h = 0.01f;
    const float u0 = std::max(0.0f, u - h), u1 = std::min(1.0f, u + h), v0 = std::max(0.0f, v - h), v1 = std::min(1.0f, v + h);
    return Normalized(Cross(at(u1, std::max(v, h)) - at(u0, std::max(v, h)), at(u, v1) - at(u, v0)));
  };
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const Vec2f q[4] = {{static_cast<float>(i), static_cast<float>(j)},
                          {static_cast<float>(i + 1), static_cast<float>(j)},
                          {static_cast<float>(i + 1), static_cast<float>(j + 1)},
                          {static_cast<float>(i), static_cast<float>(j + 1)}};
      Vec3f p[4], n[4];
      Vec2f uv[4];
      for (int k = 0; k < 4; ++k) {
        const float u = q[k].x / static_cast<float>(nu), v = q[k].y / static_cast<float>(nv);
        p[k] = at(u, v);
        n[k] = normal(u, v);
        uv[k] = {u * size.x, (1 - v) * size.y};
      }
      if (p[0] != p[1]) mesh_.SmoothTriangle({p[0], p[1], p[2]}, {n[0], n[1], n[2]}, {uv[0], uv[1], uv[2]});
      if (p[2] != p[3]) mesh_.SmoothTriangle({p[0], p[2], p[3]}, {n[0], n[2], n[3]}, {uv[0], uv[2], uv[3]});
    }
  }
}

void PropBuilder::Picture(Vec3f a, Vec3f b, Vec3f c, Vec3f d) { mesh_.QuadUv(a, b, c, d, {0, 1}, {1, 1}, {1, 0}, {0, 0}); }

Model PropBuilder::Finish() {
  model_.mesh = mesh_.Finish(name_);
  return std::exchange(model_, Model{});
}

std::vector<Vec2f> RoundedRectangle(Vec2f min, Vec2f max, float radius, int steps) {
  std::vector<Vec2f> outline;
  const Vec2f centers[4] = {{max.x - radius, max.y - radius},
                            {min.x + radius, max.y - radius},
                            {min.x + radius, min.y + radius},
                            {max.x - radius, min.y + radius}};
  for (int c = 0; c < 4; ++c) {
    for (int i = 0; i <= steps; ++i) {
      const float a = kTauF / 4 * (static_cast<float>(c) + static_cast<float>(i) / static_cast<float>(steps));
      outline.push_back(centers[c] + Vec2f{std::cos(a), std::sin(a)} * radius);
    }
  }
  return outline;
}

}  // namespace airsim360::internal
