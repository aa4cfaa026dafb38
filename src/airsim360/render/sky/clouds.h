// All clouds of a sky: how they look, and what they leave of the sun.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/render/sky/atmosphere.h"
#include "airsim360/render/sky/cloud_layer.h"
#include "airsim360/render/sky/cloud_sheets.h"
#include "airsim360/render/sky/field_shade.h"
#include "airsim360/scene/environment.h"

namespace airsim360::internal {

/// What clouds need to know of the light.
struct CloudLight {
  Vec3f to_sun;                        ///< unit, W
  std::function<Vec3f(float)> sun_at;  ///< irradiance facing the sun, by altitude in metres
  Vec3f sky;                           ///< mean radiance of the clear sky
  Vec3f ground;                        ///< radiance of the ground below a clear sky
  Vec3f town;                          ///< radiance of its lamps, whatever stands above
  ClearAir air;                        ///< before the clouds
  float overcast;                      ///< what a closed deck gives level ground, units
};

/// Immutable: the same for the same environment and light on every machine. The observer stands at the origin. Volumes of cumulus,
/// stratocumulus and altocumulus, cirrus above, or a closed deck below all else. Below 0.55 of low cloud the field is moved so that
/// the sun is free from the origin; above it chance decides whether it is free, veiled or hidden.
class Clouds {
 public:
  Clouds(const Environment& environment, const CloudLight& light);

  /// Radiance of a direction above the horizon with the clouds before the clear sky `behind` (with its stars); `air` is the light
  /// of the clear sky there, which lies before the clouds in part. `dither` in [0, 1) shifts the steps.
  Vec3f Over(Vec3f direction, Vec3f behind, Vec3f air, float dither) const;
  /// Share of the sun's direct light that reaches a point of the level through the origin. Half of what a cloud scatters goes on
  /// within a few degrees (diffraction), and counts as direct: exp(-depth / 2). `step`: of the march, metres of height.
  float SunAt(float x, float y, float step = 45) const;
  /// A deck hides the sun and all sky.
  bool closed() const { return deck_.has_value(); }
  bool any() const { return closed() || !layers_.empty() || cirrus_.any(); }

 private:
  struct LayerLight {
    Vec3f sun, sky, ground;  // irradiance facing the sun; radiances from above and below
    FieldShade shade;        // of the sun, by clouds further than DepthToSun looks
  };
  struct Ray;
  void AddLow(const Environment& environment, Vec2f wind, uint32_t seed);
  void LightLayers();
  void PlaceTheSun(float cover, uint32_t seed);
  float SunThrough(Vec3f direction) const;
  float DepthToSun(const CloudLayer& layer, Vec3f p, float altitude, float dither) const;
  float DepthAlongSun(const CloudLayer& layer, float x, float y, float step) const;
  float SunScattered(const CloudLayer& layer, const Ray& ray, Vec3f p, float altitude, float dither) const;
  Vec3f AmbientScattered(const CloudLayer& layer, const LayerLight& light, float altitude) const;
  void March(const CloudLayer& layer, const LayerLight& light, Ray& ray) const;
  void AddCirrus(Ray& ray) const;
  void Put(Ray& ray, Vec3f light, float share, float distance) const;

  CloudLight light_;
  std::vector<CloudLayer> layers_;  // from the lowest up
  std::vector<LayerLight> lights_;
  Cirrus cirrus_;
  Vec3f cirrus_sun_;
  std::optional<StratusDeck> deck_;
  float deck_base_ = 0, cover_ = 0;
};

}  // namespace airsim360::internal
