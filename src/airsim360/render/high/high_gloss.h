// What floors, furniture and metal of middling gloss mirror in rooms: a few rays of the lobe at every pixel, whose neighbours'
// rays are stratified with them, so that means over a lobe's own width on the picture are free of noise.
#pragma once

#include <cstdint>

#include "airsim360/render/high/high_shading.h"
#include "airsim360/render/shading/shader_impl.h"

namespace airsim360::internal {

/// Which of a tile's surfaces mirror so, and how. In the order of a RaySet.
struct GlossSet {
  bool any = false;
  bool is[kBatch] = {};
  Vec3f skin[kBatch];   ///< radiance seen per radiance mirrored, air included
  float share[kBatch];  ///< of it that rays look for: the rest mirrors the light of all sides
};

/// Finds surfaces of middling gloss in rooms, for which ScatterReflections or nobody has asked a ray, and takes them out of what
/// FollowRays sends. `sharp`: SurfaceSet::mirror before ScatterReflections. Lamps that rays will meet shine no highlight any more.
void FindGloss(const Shader::Impl& shader, const RaySet& rays, const IndoorLight& room, const float* sharp, SurfaceSet& s, GlossSet& gloss);

/// Sends the rays and fills `pixels` at the surfaces' slots. Without `sampling` no rays are sent: as if the light of all sides were
/// mirrored.
void GatherGloss(const Shader::Impl& shader, const TileSampling* sampling, const RaySet& rays, const SurfaceSet& s, const IndoorLight& room,
                 const GlossSet& gloss, GlossPixels& pixels);

}  // namespace airsim360::internal
