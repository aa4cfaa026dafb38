// Vertex colours: our meshes have none, so triangles of like colour become parts of their own with a tinted
// material.
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "airsim360/assets/gltf_parts.h"

namespace airsim360::internal {
namespace {

using Key = std::tuple<int, int, int>;

// Level of a linear channel on an even scale of its square root, near to what the eye tells apart.
int Level(float linear, int levels) {
  return static_cast<int>(
      std::lround(std::sqrt(std::clamp(linear, 0.0f, 1.0f)) * static_cast<float>(levels)));
}

float Linear(int level, int levels) {
  const float root = static_cast<float>(level) / static_cast<float>(levels);
  return root * root;
}

}  // namespace

std::vector<ColorGroup> GroupByColor(const GltfPrimitive& primitive) {
  constexpr size_t kMostGroups = 256;
  if (primitive.colors.empty()) return {{{1, 1, 1}, primitive.triangles}};

  // As fine as stays below the limit; the coarsest scale always does.
  std::map<Key, std::vector<Vec3u>> groups;
  int levels = 0;
  for (int candidate : {64, 16, 5}) {
    levels = candidate;
    groups.clear();
    for (const Vec3u& t : primitive.triangles) {
      const Vec3f mean = (primitive.colors[t.x] + primitive.colors[t.y] + primitive.colors[t.z]) / 3.0f;
      groups[{Level(mean.x, levels), Level(mean.y, levels), Level(mean.z, levels)}].push_back(t);
      if (groups.size() > kMostGroups) break;
    }
    if (groups.size() <= kMostGroups) break;
  }
  std::vector<ColorGroup> out;
  for (auto& [key, triangles] : groups) {
    const auto& [r, g, b] = key;
    out.push_back({{Linear(r, levels), Linear(g, levels), Linear(b, levels)}, std::move(triangles)});
  }
  return out;
}

}  // namespace airsim360::internal
