// Equal vertices of a mesh, kept once.
#pragma once

#include <cstdint>
#include <cstring>
#include <unordered_map>

#include "airsim360/scene/mesh.h"

namespace airsim360::internal {

/// Adds vertices with normal and uv to a mesh; one that was added before gives its number again. Make one for each part of a
/// mesh: parts share no vertices.
class VertexWelder {
 public:
  /// `mesh` must outlive it.
  explicit VertexWelder(Mesh& mesh) : mesh_(mesh) {}

  uint32_t Add(Vec3f p, Vec3f n, Vec2f uv) {
    const auto [it, fresh] = seen_.try_emplace({p, n, uv}, static_cast<uint32_t>(mesh_.positions.size()));
    if (fresh) {
      mesh_.positions.push_back(p);
      mesh_.normals.push_back(n);
      mesh_.uvs.push_back(uv);
    }
    return it->second;
  }

 private:
  struct Vertex {
    Vec3f p, n;
    Vec2f uv;
    friend bool operator==(const Vertex&, const Vertex&) = default;
  };
  struct VertexHash {
    size_t operator()(const Vertex& v) const {
      uint64_t h = 0xcbf29ce484222325ull;
      uint32_t words[sizeof(Vertex) / 4];
      std::memcpy(words, &v, sizeof(v));
      for (uint32_t w : words) h = (h ^ w) * 0x100000001b3ull;
      return h ^ (h >> 29);
    }
  };

  Mesh& mesh_;
  std::unordered_map<Vertex, uint32_t, VertexHash> seen_;
};

}  // namespace airsim360::internal
