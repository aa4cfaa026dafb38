// Clouds without visible thickness: ice high up, and the closed deck of an overcast day.
#pragma once

#include <cstdint>

#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// Cirrus: patches of fibres that turn with the wind over tens of kilometres. Immutable.
class Cirrus {
 public:
  /// `cover` as Environment::cirrus_cover; `wind`: unit, where it blows to.
  Cirrus(float cover, Vec2f wind, uint32_t seed);
  /// Optical depth straight up over a point of the plane (metres), 0 … about 1.
  float Depth(float x, float y) const;
  float height() const { return height_; }
  bool any() const { return cover_ > 0; }

 private:
  float cover_, height_ = 8500;
  Vec2f wind_;
  int seed_;
};

/// A closed deck of stratus: the CIE overcast sky (1 : 3 from horizon to zenith) times a structure of thick and thin places.
/// Immutable.
class StratusDeck {
 public:
  /// `illuminance` is what the deck gives level ground, in units; where it is thin the sun at `to_sun` glows through.
  StratusDeck(float base, float illuminance, Vec3f to_sun, Vec2f wind, uint32_t seed);
  /// Radiance of a direction above the horizon.
  Vec3f Radiance(Vec3f direction) const;
  /// Share of the light from below that a direction sends back: what its water does not let through.
  float Reflectance(Vec3f direction) const { return 1 - Through(Depth(direction)); }
  /// Of the air below it, at the horizon; `below` is the radiance of the ground's own lamps.
  Vec3f AirLight(Vec3f below) const;

 private:
  float Depth(Vec3f direction) const;
  static float Through(float depth) { return 1 / (1 + 0.105f * depth); }  // the two-stream form
  float Light(Vec3f direction) const;

  float base_, zenith_ = 1, mean_ = 1, reflectance_ = 0;
  Vec3f to_sun_;
  Vec2f wind_;
  int seed_;
  float depth_, contrast_, glow_;  // drawn by the seed: mean optical depth, of its variation, of the sun's place
};

}  // namespace airsim360::internal
