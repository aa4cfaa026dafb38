// One capture: all products of a frame from the same rays through one camera at one instant.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>

#include "airsim360/image/image.h"
#include "airsim360/math/transform.h"
#include "airsim360/projection/camera.h"
#include "airsim360/render/products.h"
#include "airsim360/render/render_settings.h"
#include "airsim360/scene/scene.h"
#include "airsim360/scene/scene_state.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// One picture of one camera, made as the settings say.
struct RenderRequest : RenderSettings {
  Camera camera = {};
  RigidTransform X_WC = {};  ///< pose of the camera in W
  Products products = {};

  /// What has moved; nullptr = nothing. Shared with the flow's second instant below.
  std::shared_ptr<const SceneState> state = nullptr;
  /// The instant that flow leads to: pose of the camera and what has moved by then; next_state nullptr = as
  /// `state`, only the camera moves.
  std::optional<RigidTransform> X_WC_next = {};
  std::shared_ptr<const SceneState> next_state = nullptr;

  // Tiers high and reference.
  bool latitude_sampling = true;  ///< fewer samples where rows of a panorama are shorter
  bool temporal = false;          ///< high: reuse the last frame of this renderer; off = frames are independent
  bool light = false;             ///< also Frame::light and Frame::daylight, of which a look makes a picture (render/look)
};

/// A request that leaves all other settings as they are by default.
inline RenderRequest MakeRequest(const Camera& camera, const RigidTransform& X_WC, Tier tier, const Products& products = {}) {
  RenderRequest request{{}, camera, X_WC, products};
  request.tier = tier;
  return request;
}

/// Colour samples of a pixel on an edge. Tier `fast` takes two if nothing else is asked for, `high` eight, with which it
/// is level with 16 paths of a pixel; four where shares of entities are a product of another tier (coverage).
inline int EdgeSamples(const RenderRequest& request) {
  const int usual = request.tier == Tier::kHigh ? 8 : request.tier == Tier::kFast && !request.products.coverage ? 2 : 4;
  return std::clamp(request.edge_samples > 0 ? request.edge_samples : usual, 1, kMaxEdgeSamples);
}

/// Where the surface point of a pixel is at the next instant. The sky is infinitely far away: it only turns.
struct FlowPixel {
  float dx = 0, dy = 0;  ///< pixels; across the seam of a panorama the short way, so |dx| <= W / 2; 0 where
                         ///< the next picture has no pixel for it
  float range = 0;       ///< to that point then, metres; 0 = sky
  uint8_t occluded = 0;  ///< 1: something else hides it then, it vanishes or leaves the picture; always 1 in
                         ///< pixels without a ray
  Vec3f motion;          ///< scene flow: displacement of the point in W, metres
  friend bool operator==(const FlowPixel&, const FlowPixel&) = default;
};

/// The entities in a pixel by the share of its area, largest first, of equal ones the lower id; entity
/// kNoEntity = no more. Shares are multiples of 1 / EdgeSamples on silhouettes (fewer where the pixel has
/// points without a ray), 1 elsewhere.
struct CoveragePixel {
  static constexpr int kEntities = 4;
  EntityId entity[kEntities] = {};
  float share[kEntities] = {};  ///< sums to 1 with what is left out
  friend bool operator==(const CoveragePixel&, const CoveragePixel&) = default;
};

/// The light of the sky where a camera stands, in units of Sky.
struct Daylight {
  Vec3f to_sun{0, 0, 1};  ///< unit, in W; by night to the moon
  Rgb32f sun;             ///< its irradiance on a plane facing it, outside of cloud shadows; black: there is none
  float sun_seen = 0;     ///< share of its light that meets the camera, 0 (hidden) … 1
  Rgb32f sky;             ///< irradiance of level open ground by the sky without it
};

/// The products asked for; the others are empty, and so is rgb of tier labels. Images keep their memory
/// between captures of the same size. A pixel without a ray (outside a fisheye's circle) has range 0, entity
/// 0, semantic void, black.
struct Frame {
  Image<Rgb8> rgb;             ///< sRGB
  Image<float> range;          ///< metres along the ray through the pixel centre, 0 = nothing hit
  Image<CategoryId> semantic;  ///< leaf category
  Image<EntityId> entity;
  Image<Vec3f> normal;            ///< unit geometric normal in W towards the camera; (0, 0, 0) = nothing hit
  Image<Vec3f> position;          ///< of the point hit, in W; (0, 0, 0) = nothing hit
  Image<Rgb32f> albedo;           ///< linear base colour of the surface, textures included; 0 = sky
  Image<uint16_t> material;       ///< index into Scene::materials plus 1; 0 = nothing hit
  Image<FlowPixel> flow;          ///< to the next instant
  Image<CoveragePixel> coverage;  ///< soft edges
  Image<Rgb32f> radiance;         ///< linear light, units of Sky
  float exposure = 1;             ///< radiance times this is what the tone curve was given
  Image<Rgb32f> light;            ///< as radiance, but of tier fast too with edges as smooth as those of rgb
  Daylight daylight;              ///< set with `light`
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
  /// columns. InputError for a camera without pixels.
  virtual RenderStats Render(const RenderRequest& request, Frame& frame) = 0;
};

struct RendererOptions {
  Tier tier = Tier::kLabels;                    ///< what it needs beyond tracing (sky, lights, probes) is made at construction
  std::optional<Environment> environment = {};  ///< instead of the scene's own
};

/// CPU renderer on Embree. What a tier other than the one announced needs is made at its first capture.
std::unique_ptr<Renderer> MakeCpuRenderer(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options = {});
/// Renderer for tests of everything above: sky everywhere, range 0, no rays.
std::unique_ptr<Renderer> MakeNullRenderer(std::shared_ptr<const Scene> scene);

}  // namespace airsim360
