// Lamps that are large or near: what rays of surfaces meet of them counts beside the rays that look for lamps.
#pragma once

#include <vector>

#include "airsim360/render/indoor/indoor_world.h"

namespace airsim360::internal {

/// Lamps that shine alike to all sides of their front. Both ways to find their light have the weights of the balance heuristic
/// (Veach 1997, section 9.2): where glowing walls meet, rays that look for lamps alone would find too little but for rare specks.
class PlainLamps {
 public:
  explicit PlainLamps(const IndoorWorld& world);
  bool Holds(uint32_t lamp) const { return lamp < plain_.size() && plain_[lamp] != 0; }

 private:
  std::vector<uint8_t> plain_;  ///< by lamp
};

/// How many rays of either kind a place sends: to lamps, and spread as the cosine. plain == nullptr: the former find all light.
struct LampMix {
  const PlainLamps* plain = nullptr;
  int to_lamps = 0, even = 0;

  /// Share of the light that is left to rays to lamps. Densities per area of the lamp.
  float OfLampRays(float lamp_density, float even_density) const {
    const float a = static_cast<float>(to_lamps) * lamp_density, b = static_cast<float>(even) * even_density;
    return a > 0 ? a / (a + b) : 0;
  }
};

/// Radiance of the lamp under a ray, black where there is none that shines alike to all sides.
Vec3f PlainGlow(const IndoorWorld& world, const PlainLamps& plain, const RayPacket& packet, int lane, const MetSurface& met);

/// What an even ray from a surface that faces `normal` brings of the lamp that it met, if one: radiance less the share that is left
/// to rays to lamps. Those were chosen for the place `chosen_for` on that surface.
struct MetGlow {
  Vec3f radiance;
  bool held = false;  ///< by the lamp grid
};
MetGlow GlowUnder(const IndoorWorld& world, const LampMix& rays, const RayPacket& packet, int lane, const MetSurface& met, Vec3f normal,
                  Vec3f chosen_for);

}  // namespace airsim360::internal
