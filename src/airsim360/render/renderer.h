// One capture: all products of a frame from the same rays through one camera at one instant.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "airsim360/image/image.h"
#include "airsim360/math/transform.h"
#include "airsim360/projection/camera.h"
#include "airsim360/scene/scene.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

enum class Tier { kLabels, kFast, kHigh, kReference };
inline constexpr const char* kTierNames[] = {"labels", "fast", "high", "reference"};
/// Tier of a name; InputError naming the nearest if there is none.
Tier ParseTier(std::string_view name);

/// Which images a capture fills. Labels cost nothing beside each other: they come from the same rays.
struct Products {
  bool rgb = true, range = true, semantic = true, entity = true, normal = false;
};

struct RenderRequest {
  Camera camera = {};
  RigidTransform X_WC = {};  ///< pose of the camera in W
  Tier tier = Tier::kFast;
  Products products = {};
  double exposure_ev =
      0;  ///< stops added to the scene's fixed daylight exposure; one exposure for the whole sphere
  int aa_samples = 4;  ///< colour samples of a pixel on an edge, the centre ray included; 1 = none
};

/// The products asked for; the others are empty, and so is rgb of tier labels. Images keep their memory
/// between captures of the same size. A pixel without a ray (outside a fisheye's circle) has range 0, entity
/// 0, semantic void, black.
struct Frame {
  Image<Rgb8> rgb;             ///< sRGB
  Image<float> range;          ///< metres along the ray through the pixel centre, 0 = nothing hit
  Image<CategoryId> semantic;  ///< leaf category
  Image<EntityId> entity;
  Image<Vec3f> normal;  ///< unit geometric normal in W towards the camera; (0, 0, 0) = nothing hit
};

/// Counters of the last capture.
struct RenderStats {
  uint64_t rays = 0;     ///< from the camera: pixels and antialiasing samples
  double render_ms = 0;  ///< rays and shading alone
};

class Renderer {
 public:
  virtual ~Renderer() = default;
  /// Fills `frame`. The same request gives the same bytes with any number of threads. Turning an
  /// equirectangular camera about its own vertical axis by k columns rolls every product by exactly k
  /// columns. InputError for a tier this renderer does not have or a camera without pixels.
  virtual RenderStats Render(const RenderRequest& request, Frame& frame) = 0;
};

/// CPU renderer on Embree: tiers labels and fast. What `tier` needs beyond tracing (sky, light probes) is
/// made here; what another tier needs, at its first capture.
std::unique_ptr<Renderer> MakeCpuRenderer(std::shared_ptr<const RayTracer> tracer, Tier tier = Tier::kLabels);
/// Renderer for tests of everything above: sky everywhere, range 0, no rays.
std::unique_ptr<Renderer> MakeNullRenderer(std::shared_ptr<const Scene> scene);

}  // namespace airsim360
