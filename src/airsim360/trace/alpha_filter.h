// Alpha-tested triangles as Embree sees them: a filter that lets rays pass through the holes.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <span>
#include <vector>

#include "airsim360/scene/scene.h"

namespace airsim360::internal {

/// What a triangle shows of its alpha texture.
enum class Opacity : uint8_t { kOpaque, kClear, kMixed };

/// Opacity of one material: where it is a hole. Pointers stay valid as long as the scene.
class AlphaTest {
 public:
  AlphaTest(const Material& material, std::span<const Texture> textures);
  /// Whether a ray that meets the surface at mesh coordinates `uv`, where vertices cover the share `coverage`,
  /// hits it: base alpha * (texture alpha * coverage) >= cutoff, the texture read bilinearly at full size.
  bool Solid(Vec2f uv, float coverage = 1) const;
  /// kOpaque only where Solid is true at every point of the triangle, kClear only where it is nowhere.
  /// Conservative: a triangle that comes within rounding of the other kind, or that spans more texels than
  /// are worth looking at, is kMixed.
  Opacity Classify(const Mesh& mesh, uint32_t triangle) const;

 private:
  const Texture* texture_;  // nullptr = alpha 1 everywhere
  UvTransform transform_;
  float scale_, cutoff_;
};

/// Whether rays can pass anywhere through a surface of this material on such a mesh: it then needs a filter.
bool NeedsAlphaTest(const Material& material, const Mesh& mesh);

/// User data of an alpha-tested Embree geometry.
struct AlphaGeometry {
  const Mesh* mesh;
  std::span<const uint32_t> triangles;   // primitive -> triangle of the mesh; empty = the same number
  std::vector<uint32_t> primitive_test;  // primitive -> index into tests
  std::vector<AlphaTest> tests;
};

/// Embree filter for intersection and occlusion, any packet width; user data: AlphaGeometry.
void FilterAlpha(const RTCFilterFunctionNArguments* args);

}  // namespace airsim360::internal
