// Puts the parts of a scene's shading together for the kernels.
#pragma once

#include "airsim360/render/shading/light_probes.h"
#include "airsim360/render/shared/shading_data.h"
#include "airsim360/render/sky/sky.h"
#include "airsim360/render/surface/surface_tables.h"

namespace airsim360::internal {

/// Refers to everything given, which must outlive it. `sky` and `probes` may be nullptr: then ambient light
/// is the same everywhere. `environment`: whose weather lies on the surfaces; nullptr = the scene's.
ShadeView MakeShadeView(const Scene& scene, const SurfaceTables& tables, const Sky* sky, const LightProbes* probes,
                        const Environment* environment = nullptr);

}  // namespace airsim360::internal
