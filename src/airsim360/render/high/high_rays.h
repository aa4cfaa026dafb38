// The rays of tier `high` whose directions the pixels of a tile share.
#pragma once

#include "airsim360/render/high/high_shading.h"
#include "airsim360/render/shading/shader_impl.h"

namespace airsim360::internal {

/// Turns `sunlit` from "may matter" to the share of the sun's disc that is seen: one ray each, eight where
/// neighbours on the same plane disagree: these start all over the pixel, so that edges of shadows are smooth.
/// `penumbra` gets, at the surfaces' slots, what HighTile says.
void TraceSunDisc(const Shader::Impl& shader, const TileSampling& sampling, const RaySet& rays, SurfaceSet& surfaces, uint8_t* penumbra);

/// `room`, if not nullptr: what is known by surfels needs no rays.
/// Sends the ambient rays of a tile and leaves their mean and number in `light_*` and `light_samples`.
void GatherAmbient(const Shader::Impl& shader, const SunMapView& sun_map, const TileSampling& sampling, const RaySet& rays,
                   const SurfaceSet& surfaces, const LightTerms& terms, const IndoorLight* room, HighTile& tile);

}  // namespace airsim360::internal
