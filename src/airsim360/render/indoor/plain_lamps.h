// Lamps that are large or near: what rays of surfaces meet of them counts beside the rays that look for lamps.
#pragma once

#include <vector>

#include "airsim360/render/indoor/indoor_world.h"
#include "airsim360/render/indoor/lamp_guide.h"

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
  const LampGuide* guide = nullptr;         ///< chooses most of the lamps; nullptr: the tree chooses all
  std::vector<FoundLamp>* found = nullptr;  ///< gets what each ray to a lamp has brought, unless nullptr

  /// Share of the light that is left to rays to lamps. Densities per area of the lamp.
  float OfLampRays(float lamp_density, float even_density) const {
    const float a = static_cast<float>(to_lamps) * lamp_density, b = static_cast<float>(even) * even_density;
    return a > 0 ? a / (a + b) : 0;
  }
  /// Probability with which a ray to lamps from a surface at p chooses that one.
  float ChanceOf(const LightTable& lights, Vec3f p, Vec3f normal, uint32_t lamp) const {
    const float of_tree = lights.tree().Probability(p, normal, lamp);
    if (guide == nullptr) return of_tree;
    return guide->tree_share() * of_tree + (1 - guide->tree_share()) * guide->Probability(lamp);
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
