// What an imported file may ask for at most. Every size that a file claims is held against these before
// memory is taken.
#pragma once

#include <cstdint>

namespace airsim360::internal {

struct ImportLimits {
  uint64_t max_vertices = uint64_t{1} << 27;        ///< of all meshes together, also the elements of one accessor
  uint64_t max_triangles = uint64_t{1} << 27;       ///< of all meshes together
  uint64_t max_nodes = uint64_t{1} << 22;           ///< scene nodes, GPU instances included
  uint64_t max_texture_pixels = uint64_t{1} << 29;  ///< of all textures together
  uint64_t max_buffer_bytes = uint64_t{4} << 30;    ///< of all decoded buffers together
  int max_depth = 256;                              ///< of the node hierarchy
};

/// Coordinates of a world stay below this (metres), so that products of three of them stay finite in float.
inline constexpr float kMaxCoordinate = 1e9f;

}  // namespace airsim360::internal
