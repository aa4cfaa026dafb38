#include "airsim360/trace/triangle_opacity.h"

#include "airsim360/trace/alpha_filter.h"

namespace airsim360 {

std::vector<TriangleOpacity> TriangleOpacities(const Scene& scene, const Mesh& mesh) {
  std::vector<TriangleOpacity> out(mesh.triangles.size(), TriangleOpacity::kOpaque);
  for (const MeshPart& part : mesh.parts) {
    const Material& material = scene.materials[part.material];
    if (!internal::NeedsAlphaTest(material, mesh)) continue;
    const internal::AlphaTest test(material, scene.textures);
    for (uint32_t i = part.first_triangle; i < part.first_triangle + part.triangle_count; ++i) {
      switch (test.Classify(mesh, i)) {
        case internal::Opacity::kOpaque:
          break;
        case internal::Opacity::kClear:
          out[i] = TriangleOpacity::kClear;
          break;
        case internal::Opacity::kMixed:
          out[i] = TriangleOpacity::kMixed;
          break;
      }
    }
  }
  return out;
}

}  // namespace airsim360
