// From ray hits to the colours of tier `fast`: textured surfaces under sun, sky and one bounce of both.
#pragma once

#include <cstdint>
#include <memory>

#include "airsim360/image/image.h"
#include "airsim360/math/vector.h"
#include "airsim360/render/renderer.h"
#include "airsim360/render/sky/sun_pixels.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

/// Up to kCapacity rays from one point and what they met. Neighbours in the batch should be neighbours on the
/// sphere.
struct alignas(64) HitBatch {
  static constexpr int kCapacity = 256;
  int count = 0;
  Vec3f origin;          ///< camera, in W
  float cone_angle = 0;  ///< angle between neighbouring pixels, radians (pi / H of a panorama)
  alignas(64) float direction_x[kCapacity], direction_y[kCapacity], direction_z[kCapacity];  ///< unit, in W
  alignas(64) float distance[kCapacity];
  alignas(64) float u[kCapacity], v[kCapacity];                   ///< barycentrics as in RayHit16
  alignas(64) uint32_t instance[kCapacity], triangle[kCapacity];  ///< as in SurfaceRef; instance kMiss = sky
  alignas(64) uint32_t sample_key[kCapacity];                     ///< 0 = pixel centre; others choose a point of the sun's disc
};

/// Linear radiance towards the camera, one per hit; units of Sky (sunlit white is about 20 / pi).
struct alignas(64) RadianceBatch {
  float r[HitBatch::kCapacity], g[HitBatch::kCapacity], b[HitBatch::kCapacity];
};

/// Immutable but for Apply; Shade may run concurrently and does not depend on the order of hits in a
/// batch.
class Shader {
 public:
  Shader(std::shared_ptr<const RayTracer> tracer, const Environment& environment);
  ~Shader();

  /// Another environment with the same lamps on, between frames and with nothing applied: from then on it is as one made for
  /// that environment. What of the light is the same as for one of the last few is not computed again.
  void SetEnvironment(const Environment& environment);
  /// Makes the light of rooms, where the scene has any: what tiers fast and high show of them from then on.
  void PrepareIndoors();
  /// Whether the scene has rooms: paths in them bounce more often. Not to be called by several threads at once.
  bool HasRooms() const;
  /// Whether a camera at p stands in a room. Not to be called by several threads at once.
  bool IsIndoors(Vec3f p) const;
  /// Follows what moves, between frames: `tracer` is the one of construction or one that a DynamicTracer made
  /// of it. Light probes and lamps stay as built.
  void Apply(std::shared_ptr<const RayTracer> tracer);
  /// `sun`, if wanted, gets what was learned of the sun at every hit; `around` spares rays to the sun where
  /// the pixels around a hit agree about it.
  void Shade(const HitBatch& hits, RadianceBatch& radiance, const SunNeighbours* around = nullptr, SunPixel* sun = nullptr) const;
  /// Factor from radiance to the input of the tone curve: fixed by the environment's daylight, the same for
  /// the whole sphere.
  float Exposure() const;
  /// What a picture's own exposure goes up to: kDimmestWhite comes out white. Infinite in scenes without a sky, whose
  /// light may have any unit.
  double MostExposure() const;
  /// Display colours of `count` radiances: exposure * 2^exposure_ev, tone curve, sRGB.
  void ToneMap(const float* r, const float* g, const float* b, int count, double exposure_ev, Rgb8* out,
               ToneCurve tone = ToneCurve::kFilmic) const;

  struct Impl;
  /// For the other tiers: shader_impl.h.
  const Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360
