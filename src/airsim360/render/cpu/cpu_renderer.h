// The CPU renderer as other renderers are compared with it.
#pragma once

#include <memory>

#include "airsim360/render/renderer.h"

namespace airsim360 {

/// As MakeCpuRenderer, but rooms have the light of probes and rays, as everything has outdoors, and the exposure of the
/// day: what the GPU renderer draws.
std::unique_ptr<Renderer> MakeCpuRendererWithoutRooms(std::shared_ptr<const RayTracer> tracer, const RendererOptions& options = {});

}  // namespace airsim360
