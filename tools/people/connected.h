// Which parts of a mesh hang together.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace airsim360::bake {

/// By vertex, a vertex that stands for its connected part; faces connect their corners. `Face`: a range of numbers of
/// vertices, all below `vertices`.
template <class Face>
std::vector<uint32_t> ConnectedParts(size_t vertices, const std::vector<Face>& faces) {
  std::vector<uint32_t> root(vertices);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const Face& face : faces) {
    for (const auto corner : face) root[find(static_cast<uint32_t>(corner))] = find(static_cast<uint32_t>(face[0]));
  }
  for (uint32_t v = 0; v < vertices; ++v) root[v] = find(v);
  return root;
}

}  // namespace airsim360::bake
