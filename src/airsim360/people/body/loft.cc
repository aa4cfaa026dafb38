#include "airsim360/people/body/loft.h"

#include <algorithm>
#include <numbers>

#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

// Catmull-Rom through b at t = 0 and c at t = 1.
double Spline(double a, double b, double c, double d, double t) {
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

LoftRing Between(std::span<const LoftRing> rings, size_t k, double t) {
  if (t == 0) return rings[k];
  const LoftRing &b = rings[k], &c = rings[k + 1];
  const LoftRing &a = k > 0 ? rings[k - 1] : b, &d = k + 2 < rings.size() ? rings[k + 2] : c;
  LoftRing r;
  for (int i = 0; i < 3; ++i) r.center[i] = Spline(a.center[i], b.center[i], c.center[i], d.center[i], t);
  r.half = std::max(0.0, Spline(a.half, b.half, c.half, d.half, t));
  r.front = Spline(a.front, b.front, c.front, d.front, t);
  r.back = Spline(a.back, b.back, c.back, d.back, t);
  r.power = b.power + (c.power - b.power) * t;
  r.bones = MixBones(b.bones, c.bones, t);
  r.v = b.v + (c.v - b.v) * t;
  return r;
}

double SignedPower(double x, double power) { return std::copysign(std::pow(std::abs(x), power), x); }

}  // namespace

Influences Bone(Joint joint) { return {{static_cast<uint8_t>(joint)}, {1}}; }

Influences MixBones(const Influences& a, const Influences& b, double t) {
  // All that occur, heaviest first.
  std::array<std::pair<float, uint8_t>, 8> all{};
  int count = 0;
  const auto add = [&](uint8_t joint, double weight) {
    if (weight <= 0) return;
    for (int i = 0; i < count; ++i) {
      if (all[static_cast<size_t>(i)].second == joint) {
        all[static_cast<size_t>(i)].first += static_cast<float>(weight);
        return;
      }
    }
    all[static_cast<size_t>(count++)] = {static_cast<float>(weight), joint};
  };
  for (size_t i = 0; i < 4; ++i) add(a.joint[i], a.weight[i] * (1 - t));
  for (size_t i = 0; i < 4; ++i) add(b.joint[i], b.weight[i] * t);
  std::stable_sort(all.begin(), all.begin() + count, [](auto x, auto y) { return x.first > y.first; });
  count = std::min(count, 4);
  float sum = 0;
  for (int i = 0; i < count; ++i) sum += all[static_cast<size_t>(i)].first;
  Influences mix;
  for (size_t i = 0; i < static_cast<size_t>(count); ++i) {
    mix.joint[i] = all[i].second;
    mix.weight[i] = all[i].first / sum;
  }
  return mix;
}

uint32_t LoftMesh::Add(Vec3d p, Vec2f uv, const Influences& bones) {
  const auto index = static_cast<uint32_t>(level_.mesh.positions.size());
  level_.mesh.positions.push_back(VecCast<float>(p));
  level_.mesh.uvs.push_back(uv);
  level_.influences.push_back(prop_ == Prop::kNone ? bones : Influences{{prop_bone_}, {1}});
  same_.push_back(index);
  return index;
}

void LoftMesh::Face(uint32_t a, uint32_t b, uint32_t c, uint32_t material) {
  triangles_.push_back({{a, b, c}, material, static_cast<uint32_t>(prop_)});
}

void LoftMesh::Loft(std::span<const LoftRing> rings, const LoftStyle& style) {
  const int n = style.segments;
  const Vec3d axis = rings.back().center - rings.front().center;
  const bool flip = Dot(Cross(style.v, style.u), axis) < 0;
  const auto face = [&](uint32_t a, uint32_t b, uint32_t c) {
    if (flip) std::swap(b, c);
    Face(a, b, c, style.material);
  };

  // Rings of n + 1 vertices, the last on the first: the seam of uv lies behind.
  const int total = static_cast<int>(rings.size() - 1) * style.steps;
  double along = 0;
  Vec3d previous = rings.front().center;
  uint32_t first = 0, last = 0;
  for (int k = 0; k <= total; ++k) {
    const LoftRing ring = Between(rings, static_cast<size_t>(k / style.steps), static_cast<double>(k % style.steps) / style.steps);
    along += Norm(ring.center - previous);
    previous = ring.center;
    const auto start = static_cast<uint32_t>(level_.mesh.positions.size());
    if (k == 0) first = start;
    for (int i = 0; i <= n; ++i) {
      const double theta = kTau * (static_cast<double>(i % n) / n - 0.5);
      const double c = SignedPower(std::cos(theta), 2 / ring.power), s = SignedPower(std::sin(theta), 2 / ring.power);
      LoftVertex vertex{ring.center + style.u * (ring.half * s) + style.v * (c > 0 ? ring.front * c : ring.back * c), theta, ring.bones};
      if (style.deform) style.deform(vertex);
      const double around = static_cast<double>(i) / n;
      const double girth = kTau * (rings[rings.size() / 2].half + rings[rings.size() / 2].front) / 2;
      const Vec2f uv = style.uv_metres > 0
                           ? Vec2f{static_cast<float>(around * girth / style.uv_metres), static_cast<float>(along / style.uv_metres)}
                           : Vec2f{static_cast<float>(around), static_cast<float>(ring.v >= 0 ? ring.v : k / static_cast<double>(total))};
      const uint32_t index = Add(vertex.p, uv, vertex.bones);
      if (i == n) same_[index] = start;
    }
    for (uint32_t i = 0; k > 0 && i < static_cast<uint32_t>(n); ++i) {
      face(last + i, last + i + 1, start + i + 1);
      face(last + i, start + i + 1, start + i);
    }
    last = start;
  }
  // Ends are closed by a fan round the middle of the ring.
  for (const bool end : {false, true}) {
    if (!(end ? style.cap_last : style.cap_first)) continue;
    const LoftRing& ring = end ? rings.back() : rings.front();
    const uint32_t base = end ? last : first;
    Vec3d middle{};
    for (uint32_t i = 0; i < static_cast<uint32_t>(n); ++i) middle += VecCast<double>(level_.mesh.positions[base + i]) / n;
    const uint32_t center = Add(middle, level_.mesh.uvs[base + static_cast<uint32_t>(n) / 2], ring.bones);
    for (uint32_t i = 0; i < static_cast<uint32_t>(n); ++i) {
      if (end)
        face(base + i, base + i + 1, center);
      else
        face(base + i + 1, base + i, center);
    }
  }
}

void LoftMesh::Ellipsoid(Vec3d center, Vec3d radii, Joint bone, uint32_t material, int segments) {
  std::vector<LoftRing> rings;
  const int count = std::max(3, segments / 2);
  for (int k = 0; k <= count; ++k) {
    const double a = std::numbers::pi * k / count, s = std::max(0.02, std::sin(a));
    rings.push_back({center - Vec3d{0, 0, radii.z * std::cos(a)}, radii.y * s, radii.x * s, radii.x * s, 2, Bone(bone), -1});
  }
  Loft(rings, {.material = material, .segments = segments, .steps = 1, .cap_first = true});
}

void LoftMesh::BeginProp(Prop prop, uint8_t bone) {
  if (prop_ == Prop::kNone) level_.body_vertices = static_cast<uint32_t>(level_.mesh.positions.size());
  prop_ = prop;
  prop_bone_ = bone;
}

void LoftMesh::Box(Vec3d center, Vec3d half, const Mat3d& R, uint32_t material) {
  constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& corners : kFaces) {
    uint32_t v[4];
    for (int i = 0; i < 4; ++i) {
      const int c = corners[i];
      const Vec3d p{(c & 1 ? 1 : -1) * half.x, (c & 2 ? 1 : -1) * half.y, (c & 4 ? 1 : -1) * half.z};
      v[i] = Add(center + R * p, {i == 1 || i == 2 ? 1.0f : 0.0f, i > 1 ? 1.0f : 0.0f}, {});
    }
    Face(v[0], v[1], v[2], material);
    Face(v[0], v[2], v[3], material);
  }
}

void LoftMesh::Bar(Vec3d a, Vec3d b, double radius_a, double radius_b, int segments, uint32_t material) {
  const Vec3d axis = Normalized(b - a);
  const Vec3d u = Normalized(Cross(axis, std::abs(axis.z) < 0.9 ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0}));
  const LoftRing rings[] = {{a, radius_a, radius_a, radius_a, 2, {}, -1}, {b, radius_b, radius_b, radius_b, 2, {}, -1}};
  Loft(rings, {.material = material, .segments = segments, .steps = 1, .u = u, .v = Cross(axis, u), .cap_first = true});
}

BodyLevel LoftMesh::Finish(std::string name) {
  Mesh& mesh = level_.mesh;
  mesh.name = std::move(name);
  if (prop_ == Prop::kNone) level_.body_vertices = static_cast<uint32_t>(mesh.positions.size());

  // Smooth normals, one for all vertices of a seam.
  std::vector<Vec3f> sums(mesh.positions.size());
  for (const Triangle& t : triangles_) {
    const Vec3f p = mesh.positions[t.vertices.x];
    const Vec3f area = Cross(mesh.positions[t.vertices.y] - p, mesh.positions[t.vertices.z] - p);
    for (uint32_t v : {t.vertices.x, t.vertices.y, t.vertices.z}) sums[same_[v]] += area;
  }
  for (size_t v = 0; v < sums.size(); ++v) {
    const Vec3f n = Normalized(sums[same_[v]]);
    mesh.normals.push_back(n == Vec3f{} ? Vec3f{0, 0, 1} : n);
  }

  // Parts: one for each (prop, material).
  std::stable_sort(triangles_.begin(), triangles_.end(),
                   [](const Triangle& a, const Triangle& b) { return a.prop != b.prop ? a.prop < b.prop : a.material < b.material; });
  for (const Triangle& t : triangles_) {
    const auto index = static_cast<uint32_t>(mesh.triangles.size());
    if (mesh.parts.empty() || mesh.parts.back().material != t.material || mesh.parts.back().entity != t.prop)
      mesh.parts.push_back({index, 0, t.material, t.prop});
    ++mesh.parts.back().triangle_count;
    mesh.triangles.push_back(t.vertices);
  }
  // Props lie behind the body, each in one run.
  for (const MeshPart& part : mesh.parts) {
    if (part.entity == 0) continue;
    uint32_t low = ~0u, high = 0;
    for (uint32_t k = part.first_triangle; k < part.first_triangle + part.triangle_count; ++k) {
      const Vec3u t = mesh.triangles[k];
      low = std::min({low, t.x, t.y, t.z});
      high = std::max({high, t.x, t.y, t.z});
    }
    const Prop prop = static_cast<Prop>(part.entity);
    if (!level_.props.empty() && level_.props.back().prop == prop) {
      PropRange& range = level_.props.back();
      const uint32_t end = std::max(range.first_vertex + range.vertex_count, high + 1);
      range.first_vertex = std::min(range.first_vertex, low);
      range.vertex_count = end - range.first_vertex;
    } else {
      level_.props.push_back({prop, low, high + 1 - low});
    }
  }
  return std::move(level_);
}

void AppendLevel(const BodyLevel& props, BodyLevel& level) {
  Mesh& mesh = level.mesh;
  const auto vertices = static_cast<uint32_t>(mesh.positions.size());
  const auto triangles = static_cast<uint32_t>(mesh.triangles.size());
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(mesh.positions, props.mesh.positions);
  append(mesh.normals, props.mesh.normals);
  append(mesh.uvs, props.mesh.uvs);
  append(level.influences, props.influences);
  for (const Vec3u& t : props.mesh.triangles) mesh.triangles.push_back({t.x + vertices, t.y + vertices, t.z + vertices});
  for (MeshPart part : props.mesh.parts) {
    part.first_triangle += triangles;
    mesh.parts.push_back(part);
  }
  for (PropRange range : props.props) {
    range.first_vertex += vertices;
    level.props.push_back(range);
  }
}

}  // namespace airsim360::internal
