// The kernels of the tiers `fast` and `high`: one copy per instruction set, bit for bit the same results.
#pragma once

#include "airsim360/base/kernel_isa.h"
#include "airsim360/image/image.h"
#include "airsim360/render/shared/shading_data.h"
#include "airsim360/trace/ray_tracer.h"

/// Looks up geometry, material and textures of every ray's surface; fills all of `surfaces` but the traced
/// reflections.
AIRSIM360_DECLARE_KERNEL(void PrepareSurfaces(const ShadeView& view, const RaySet& rays, SurfaceSet& surfaces))
/// Rays of directions (x, y, z)[16] from the surfaces `first` to `first` + 15, lifted off them as by RayOffset:
/// fills origin and direction.
AIRSIM360_DECLARE_KERNEL(void LiftRays(const RaySet& rays, const SurfaceSet& surfaces, int first, const float* x, const float* y,
                                       const float* z, RayHit16& out))
/// Which of the surfaces `first` to `first` + 15 ask for a ray to the sun, and which for one straight up (level
/// ones, at most `farthest` away), as bits.
AIRSIM360_DECLARE_KERNEL(uint32_t AskSun(const SurfaceSet& surfaces, int first))
AIRSIM360_DECLARE_KERNEL(uint32_t AskContact(const RaySet& rays, const SurfaceSet& surfaces, int first, float farthest))
/// Radiance towards the viewer: sun where seen, ambient light of the probes, reflections, haze of the way.
AIRSIM360_DECLARE_KERNEL(void LightSurfaces(const ShadeView& view, const RaySet& rays, const SurfaceSet& surfaces, LightSet& light))
/// The same in parts, for tier `high`: ambient light and the sun's visibility come later.
AIRSIM360_DECLARE_KERNEL(void SplitLight(const ShadeView& view, const RaySet& rays, const SurfaceSet& surfaces, LightTerms& terms))
/// Turns the reflected direction of surfaces that reflect visibly, but not sharply, to a random one of their
/// microfacets (u, v in [0, 1) for each) and marks them as mirrors.
AIRSIM360_DECLARE_KERNEL(void ScatterReflections(const RaySet& rays, const float* u, const float* v, SurfaceSet& surfaces))
/// Collects `surfaces[index[i]]` for the following.
AIRSIM360_DECLARE_KERNEL(void GatherOrigins(const RaySet& rays, const SurfaceSet& surfaces, const int* index, AmbientOrigins& origins))
/// Directions of sixteen rays spread as the cosine over the hemispheres of `origins`, on the front (side 1)
/// or the back (side -1); `sphere` is a unit vector, the same for all so that rays of flat ground are
/// parallel: normal + sphere is distributed as the cosine if sphere is even. Fills origin and direction.
AIRSIM360_DECLARE_KERNEL(void AmbientRays(const AmbientOrigins& origins, const float* side, const float* sphere, RayHit16& out))
/// Radiance that such rays bring: sky (its sharpest blurred table), or the light of what they met once
/// reflected: sun by `sun_map`, irradiance of a probe near by, lamps, emission.
AIRSIM360_DECLARE_KERNEL(void ShadeAmbient(const ShadeView& view, const SunMapView& sun_map, const RayHit16& rays, const AmbientHits& hits,
                                           float* r, float* g, float* b))
/// Light of the lamps around every surface with the visibility that the grid knows (fills lamp_*), and the
/// `count` rays of each that would tell better. `in_room`: for each surface the share of its light that is kept for rooms, which
/// knows what lamps bring, so that rays go where highlights stand out; nullptr outdoors.
AIRSIM360_DECLARE_KERNEL(void LightByLamps(const ShadeView& view, const RaySet& rays, int count, const float* in_room, SurfaceSet& surfaces,
                                           LampRays& wanted))
/// Adds the light of ShadeView::moving_lamps in the same way; false: there is none on any of the surfaces.
AIRSIM360_DECLARE_KERNEL(bool LightByMovingLamps(const ShadeView& view, const RaySet& rays, int count, SurfaceSet& surfaces,
                                                 LampRays& wanted))
/// Radiance of rays that met nothing; `sun_disc`: also the sun itself.
AIRSIM360_DECLARE_KERNEL(void LookUpSky(const ShadeView& view, const RaySet& rays, bool sun_disc, LightSet& light))
/// Rain and snow before what camera rays show: up to the surface, or of sky where `sky`. `cone_angle` is the
/// angle between neighbouring pixels.
AIRSIM360_DECLARE_KERNEL(void AddPrecipitation(const ShadeView& view, const RaySet& rays, bool sky, float cone_angle, LightSet& light))
/// Display colours: times `exposure`, tone curve (ToneCurve as a number), sRGB.
AIRSIM360_DECLARE_KERNEL(void ToneMapRow(const float* r, const float* g, const float* b, int count, float exposure, int curve, Rgb8* out))
