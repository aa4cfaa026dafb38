// The kernels of tier `fast`: one copy per instruction set, bit for bit the same results.
#pragma once

#include "airsim360/image/image.h"
#include "airsim360/render/kernel_isa.h"
#include "airsim360/render/shading/shading_data.h"

/// Looks up geometry, material and textures of every ray's surface; fills all of `surfaces` but the traced
/// reflections.
AIRSIM360_DECLARE_KERNEL(void PrepareSurfaces(const ShadeView& view, const RaySet& rays,
                                              SurfaceSet& surfaces))
/// Radiance towards the viewer: sun where seen, ambient light of the probes, reflections, haze of the way.
AIRSIM360_DECLARE_KERNEL(void LightSurfaces(const ShadeView& view, const RaySet& rays,
                                            const SurfaceSet& surfaces, LightSet& light))
/// Radiance of rays that met nothing; `sun_disc`: also the sun itself.
AIRSIM360_DECLARE_KERNEL(void LookUpSky(const ShadeView& view, const RaySet& rays, bool sun_disc,
                                        LightSet& light))
/// Display colours: times `exposure`, tone curve (ToneCurve as a number), sRGB.
AIRSIM360_DECLARE_KERNEL(void ToneMapRow(const float* r, const float* g, const float* b, int count,
                                         float exposure, int curve, Rgb8* out))
