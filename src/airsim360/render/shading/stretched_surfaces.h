// PrepareSurfaces for tier `high`, which has time to look longer.
#pragma once

#include "airsim360/base/kernel_isa.h"
#include "airsim360/render/shared/shading_data.h"

/// As PrepareSurfaces, but base colours of slanted surfaces are means over the long axis of the pixel, of up to
/// SURFACE_MOST_TAPS places: joints of paving and bricks keep the contrast that they have in a photograph.
AIRSIM360_DECLARE_KERNEL(void PrepareStretched(const ShadeView& view, const RaySet& rays, SurfaceSet& surfaces))
