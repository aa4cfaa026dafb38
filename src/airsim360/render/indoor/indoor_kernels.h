// The kernel of rooms' light.
#pragma once

#include "airsim360/base/kernel_isa.h"
#include "airsim360/render/shared/indoor_data.h"

/// Light of `count` surfaces; what is beyond up to a full vector is filled, too.
AIRSIM360_DECLARE_KERNEL(void LookUpIndoors(const IndoorView& view, const SurfaceSet& surfaces, int count, IndoorLight& light))
/// Replaces lamp_* of surfaces by the surfels' light of lamps, as far as their share says; highlights dim as much as
/// surfels know of shadows.
AIRSIM360_DECLARE_KERNEL(void MixLampsIndoors(const IndoorLight& light, int count, SurfaceSet& surfaces))
/// As LightSurfaces (shading_kernels.h), with ambient light of surfels as far as their share says.
AIRSIM360_DECLARE_KERNEL(void LightSurfacesIndoors(const ShadeView& view, const RaySet& rays, const SurfaceSet& surfaces,
                                                   const IndoorLight& indoor, LightSet& light))
