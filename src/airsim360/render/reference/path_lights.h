// The lights that paths are joined to: the sun's disc, the sky, lamps.
#pragma once

#include "airsim360/math/vector.h"
#include "airsim360/render/reference/portals.h"
#include "airsim360/render/shading/shader_impl.h"

namespace airsim360::internal {

/// What a shadow ray goes for. Densities are per solid angle.
struct LightRay {
  Vec3f direction;  ///< unit
  Vec3f radiance;   ///< from there; of the sky (1, 1, 1), to be looked up when it is seen
  float pdf = 0;    ///< 0: there is no light that way
  float reach;      ///< distance of a lamp, else infinity
};

/// Immutable; refers to the shader's parts.
class PathLights {
 public:
  explicit PathLights(const Shader::Impl& parts);

  bool has_sky() const { return sky_ != nullptr; }
  bool has_sun() const { return has_sun_; }
  bool has_lamps() const { return !lamps_.empty(); }

  /// A point of the sun's disc as seen from p, u in [0, 1)^2; even over its solid angle.
  LightRay SampleSun(Vec3f p, Vec2f u) const;
  /// Density of SampleSun: 0 beside the disc.
  float SunPdf(Vec3f direction) const;
  /// Radiance of the disc, darker towards its limb: the same as LookUpSky adds (light_kernel.cc), in the
  /// shadow of clouds at p.
  Vec3f SunRadiance(Vec3f p, Vec3f direction) const;

  LightRay SampleSky(Vec2f u) const;
  float SkyPdf(Vec3f direction) const { return sky_ != nullptr ? sky_->Pdf(direction) : 0.0f; }
  /// The same for a surface at p: in rooms most go for their panes.
  LightRay SampleSky(Vec3f p, Vec2f u) const;
  float SkyPdf(Vec3f p, Vec3f direction) const;

  /// A point of a lamp for a surface at p; a zero normal takes light from all sides.
  LightRay SampleLamp(Vec3f p, Vec3f normal, Vec3f u) const;
  /// Density with which SampleLamp at (p, normal) finds the triangle that a ray has met after `distance` with
  /// cosine `cos_lamp`.
  float LampPdf(Vec3f p, Vec3f normal, uint32_t instance, uint32_t triangle, float distance, float cos_lamp) const;

 private:
  const Sky* sky_;
  const LightTable& lamps_;
  Portals portals_;
  Vec3f to_sun_, sun_radiance_, sun_right_, sun_up_;
  bool has_sun_ = false;
};

}  // namespace airsim360::internal
