// Tier `reference`: unbiased path tracing with next-event estimation and multiple importance sampling.
#pragma once

#include <cstdint>

#include "airsim360/render/cpu/camera_rays.h"
#include "airsim360/render/shading/shader.h"

namespace airsim360::internal {

struct PathTracerOptions {
  int samples = 64;     ///< paths of a pixel (of every pixel of the box filter, jittered)
  int max_bounces = 8;  ///< Russian roulette from the third on
  uint64_t seed = 0;
};

/// Linear radiance of every pixel, box filter of one pixel; `variance` of the mean where not null. The same
/// bytes with any number of threads. Uses the shader's tables, sky, lights and BSDFs, so that what differs
/// from the other tiers is the light transport alone.
void TracePaths(const RayTracer& tracer, const Shader& shader, const CameraRays& rays, Vec3f origin,
                const PathTracerOptions& options, Image<Rgb32f>& radiance, Image<Rgb32f>* variance = nullptr);

}  // namespace airsim360::internal
