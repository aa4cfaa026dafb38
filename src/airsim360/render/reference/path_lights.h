// The lights that paths are joined to: the sun's disc and the sky.
#pragma once

#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/render/shading/shading_data.h"
#include "airsim360/render/shading/sky.h"

namespace airsim360::internal {

/// Immutable. Directions only: what lies in the way and the sky's radiance are the tracer's to find.
class PathLights {
 public:
  /// Both must outlive it; `sky` nullptr = a closed room.
  PathLights(const ShadeView& view, const Sky* sky);

  bool has_sky() const { return !density_.empty(); }
  bool has_sun() const { return has_sun_; }

  /// A point of the sun's disc, u in [0, 1)^2; even over its solid angle.
  Vec3f SampleSun(Vec2f u) const;
  /// Density of SampleSun: 0 beside the disc.
  float SunPdf(Vec3f direction) const;
  /// Radiance of the disc, darker towards its limb: the same as LookUpSky adds (light_kernel.cc).
  Vec3f SunRadiance(Vec3f direction) const;

  /// A direction of the whole sphere with density about proportional to the sky's luminance, u in [0, 1)^2.
  Vec3f SampleSky(Vec2f u) const;
  float SkyPdf(Vec3f direction) const;

 private:
  Vec3f to_sun_, sun_radiance_;
  Vec3f sun_right_, sun_up_;
  bool has_sun_ = false;
  std::vector<float> density_, cumulative_, rows_;  // per solid angle; within rows; of rows
};

}  // namespace airsim360::internal
