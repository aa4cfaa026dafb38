#include "airsim360/assets/normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace airsim360::internal {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

// Faces around positions: for each welded position the corners (3 * triangle + k) that touch it.
struct Fans {
  std::vector<uint32_t> weld;   // vertex -> welded position
  std::vector<uint32_t> first;  // welded position -> first corner in `corners`, one more at the end
  std::vector<uint32_t> corners;
};

std::vector<uint32_t> WeldByPosition(const std::vector<Vec3f>& positions) {
  std::vector<uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](uint32_t i) { return std::tie(positions[i].x, positions[i].y, positions[i].z); };
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  std::vector<uint32_t> weld(positions.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    weld[order[i]] = same ? weld[order[i - 1]] : order[i];
  }
  return weld;
}

Fans MakeFans(const Mesh& mesh) {
  Fans fans;
  fans.weld = WeldByPosition(mesh.positions);
  fans.first.assign(mesh.positions.size() + 1, 0);
  for (const Vec3u& t : mesh.triangles) {
    for (uint32_t v : {t.x, t.y, t.z}) ++fans.first[fans.weld[v] + 1];
  }
  std::partial_sum(fans.first.begin(), fans.first.end(), fans.first.begin());
  fans.corners.resize(mesh.triangles.size() * 3);
  std::vector<uint32_t> next(fans.first.begin(), fans.first.end() - 1);
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vec3u t = mesh.triangles[i];
      const uint32_t vertex = k == 0 ? t.x : k == 1 ? t.y : t.z;
      fans.corners[next[fans.weld[vertex]]++] = 3 * i + static_cast<uint32_t>(k);
    }
  }
  return fans;
}

// Unit normal of each face (zero if it has no area), and the angle of each corner.
struct Faces {
  std::vector<Vec3f> normals;
  std::vector<float> angles;
};

Faces MakeFaces(const Mesh& mesh) {
  Faces faces;
  faces.normals.reserve(mesh.triangles.size());
  faces.angles.reserve(mesh.triangles.size() * 3);
  for (const Vec3u& t : mesh.triangles) {
    const Vec3d p[3] = {VecCast<double>(mesh.positions[t.x]), VecCast<double>(mesh.positions[t.y]), VecCast<double>(mesh.positions[t.z])};
    faces.normals.push_back(VecCast<float>(Normalized(Cross(p[1] - p[0], p[2] - p[0]))));
    for (int k = 0; k < 3; ++k) {
      const Vec3d a = p[(k + 1) % 3] - p[k];
      const Vec3d b = p[(k + 2) % 3] - p[k];
      faces.angles.push_back(static_cast<float>(std::atan2(Norm(Cross(a, b)), Dot(a, b))));
    }
  }
  return faces;
}

// Normal of a corner from the fan around its position. In fans of very many faces each is left flat: time
// stays linear.
Vec3f CornerNormal(const Fans& fans, const Faces& faces, uint32_t weld, uint32_t corner, float cos_crease) {
  constexpr uint32_t kLargestFan = 256;
  const uint32_t begin = fans.first[weld];
  const uint32_t end = fans.first[weld + 1];
  const Vec3f own = faces.normals[corner / 3];
  Vec3f sum{};
  if (end - begin > kLargestFan) {
    sum = own;
  } else {
    for (uint32_t i = begin; i < end; ++i) {
      const uint32_t other = fans.corners[i];
      const Vec3f n = faces.normals[other / 3];
      if (other == corner || Dot(n, own) >= cos_crease || own == Vec3f{}) sum += n * faces.angles[other];
    }
  }
  const Vec3f n = Normalized(sum);
  return n == Vec3f{} ? Vec3f{0, 0, 1} : n;
}

bool IsMissing(Vec3f n) {
  const float length = Norm(n);
  return !std::isfinite(length) || length < 1e-12f;
}

}  // namespace

void FillMissingNormals(Mesh& mesh, double crease_deg) {
  // Which vertices lack a normal?
  const auto vertices = static_cast<uint32_t>(mesh.positions.size());
  mesh.normals.resize(vertices);
  std::vector<bool> missing(vertices);
  for (uint32_t i = 0; i < vertices; ++i) {
    missing[i] = IsMissing(mesh.normals[i]);
    // Those of length one stay as they are, to the last bit.
    if (missing[i])
      mesh.normals[i] = {0, 0, 1};
    else if (std::abs(Dot(mesh.normals[i], mesh.normals[i]) - 1) > 1e-6f)
      mesh.normals[i] = Normalized(mesh.normals[i]);
  }
  if (std::find(missing.begin(), missing.end(), true) == missing.end()) return;

  const Fans fans = MakeFans(mesh);
  const Faces faces = MakeFaces(mesh);
  const auto cos_crease = static_cast<float>(std::cos(crease_deg * 3.14159265358979323846 / 180));

  // The first corner of a vertex sets its normal; each other normal gets a copy of the vertex, kept in a
  // chain.
  std::vector<uint32_t> next(vertices, kNone);
  std::vector<bool> set(vertices);
  const auto vertex_with = [&](uint32_t vertex, Vec3f normal) {
    if (!set[vertex]) {
      set[vertex] = true;
      mesh.normals[vertex] = normal;
      return vertex;
    }
    int steps = 0;
    for (uint32_t i = vertex; i != kNone && steps < 64; i = next[i], ++steps) {
      if (Dot(mesh.normals[i], normal) > 0.99999f) return i;
    }
    const auto copy = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.push_back(mesh.positions[vertex]);
    mesh.normals.push_back(normal);
    if (!mesh.uvs.empty()) mesh.uvs.push_back(mesh.uvs[vertex]);
    if (!mesh.colors.empty()) mesh.colors.push_back(mesh.colors[vertex]);
    next.push_back(next[vertex]);
    next[vertex] = copy;
    return copy;
  };
  for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    Vec3u& t = mesh.triangles[i];
    uint32_t corner = 3 * i;
    for (uint32_t* vertex : {&t.x, &t.y, &t.z}) {
      if (missing[*vertex]) *vertex = vertex_with(*vertex, CornerNormal(fans, faces, fans.weld[*vertex], corner, cos_crease));
      ++corner;
    }
  }
}

}  // namespace airsim360::internal
