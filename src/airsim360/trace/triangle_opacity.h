// How the triangles of a mesh meet rays, for tracers other than Embree's.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/scene/scene.h"

namespace airsim360 {

enum class TriangleOpacity : uint8_t {
  kOpaque,  ///< every ray
  kClear,   ///< none: a hole all over (AlphaMode::kMask)
  kMixed,   ///< it depends on where
};

/// One for each triangle, the same for which RayTracer tests alpha.
std::vector<TriangleOpacity> TriangleOpacities(const Scene& scene, const Mesh& mesh);

}  // namespace airsim360
