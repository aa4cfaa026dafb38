// Lamps that somebody puts into a world that is built.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "airsim360/scene/scene.h"

namespace airsim360 {

/// A glowing ball.
struct PlacedLamp {
  std::string name = "lamp";
  double x = 0, y = 0, z = 3;  ///< its middle, metres of W
  double lumens = 1500;        ///< to all sides
  double kelvin = 3000;        ///< its white, 2000 ... 9000
  double radius = 0.12;        ///< metres
  bool always = false;         ///< by day too; else while the lamps of the world burn
};
inline constexpr size_t kMostPlacedLamps = 1000;

/// InputError naming a lamp that is outside of the scene, or more than kMostPlacedLamps.
void CheckLamps(const Scene& scene, std::span<const PlacedLamp> lamps);

/// The scene with the lamps as entities furniture/lighting/lamp after all that it has, so that ids of everything else stay.
/// The luminance is the same everywhere on the ball: flux = pi luminance area. InputError as CheckLamps.
std::shared_ptr<const Scene> WithLamps(std::shared_ptr<const Scene> scene, std::span<const PlacedLamp> lamps);

}  // namespace airsim360
