// Fair-weather clouds: a volume of cumulus, altocumulus and cirrus as sheets above it. Own composition;
// lighting after Wrenninge et al. (2013).
#pragma once

#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/render/sky/noise.h"

namespace airsim360::internal {

/// What a cloud needs to know of the light.
struct CloudLight {
  Vec3f to_sun;    ///< unit, W
  Vec3f sun;       ///< irradiance facing the sun, at the height of cumulus
  Vec3f sun_high;  ///< the same at the height of cirrus
  Vec3f ambient;   ///< mean radiance of the clear sky
};

/// Immutable. Coverage grows with distance, so that a bank stands low around the horizon and only puffs hang
/// overhead; the field is shifted so that the sun is free from the origin.
class Clouds {
 public:
  /// Environment::cloud_cover and cirrus_cover; at 0 there are none.
  Clouds(double cover, double cirrus, const CloudLight& light);

  /// Radiance of a sky direction with clouds before a clear sky: `behind` is the clear radiance there, `haze`
  /// that of the air between. `dither` in [0, 1) shifts the steps.
  Vec3f Over(Vec3f direction, Vec3f behind, Vec3f haze, float dither) const;
  /// Share of the sun's light that reaches a point of the ground past the cumulus.
  float SunAt(float x, float y) const;

 private:
  float Coverage(float x, float y) const;
  float Density(Vec3f p, int detail) const;
  float DepthTowardsSun(Vec3f p, float dither) const;
  float CirrusAlpha(float x, float y) const;
  float PuffAlpha(float x, float y) const;
  Vec3f AddCirrus(Vec3f direction, Vec3f behind) const;
  Vec3f AddPuffs(Vec3f direction, Vec3f behind) const;
  void FreeTheSun();
  void BakeCoverage();

  CloudLight light_;
  float cover_, cirrus_;
  float offset_x_ = 400, offset_y_ = 0;
  CloudNoise noise_;
  std::vector<float> coverage_;
};

}  // namespace airsim360::internal
