// Tier `reference`: unbiased path tracing with next-event estimation and multiple importance sampling.
#pragma once

#include <cstdint>
#include <functional>

#include "airsim360/render/frame/camera_rays.h"
#include "airsim360/render/shading/shader.h"
#include "airsim360/render/shared/shading_constants.h"

namespace airsim360::internal {

struct PathTracerOptions {
  static constexpr int kDefaultSamples = 64;
  int samples = kDefaultSamples;  ///< paths of a pixel (of every pixel of the box filter, jittered)
  int max_bounces = kMaxBounces;  ///< Russian roulette from kFirstRoulette on
  uint64_t seed = 0;
  bool next_event = true;  ///< false: light is found by chance alone; for tests
  /// Called now and then, on any thread, with the share that is done, (0, 1]; empty = never.
  std::function<void(double)> progress = {};
};

/// Linear radiance of every pixel, box filter of one pixel; `variance` of the mean where not nullptr (of
/// independent samples: ours are stratified, which makes the true one smaller). Pixels without a ray are
/// black. The same bytes with any number of threads. Uses the shader's tables, sky and BSDFs, so that what
/// differs from the other tiers is the light transport alone. A closed room's ambient light meets every
/// bounce ray where it ends, less where that is near, as in the light probes.
void TracePaths(const RayTracer& tracer, const Shader& shader, const CameraRays& rays, Vec3f origin, const PathTracerOptions& options,
                Image<Rgb32f>& radiance, Image<Rgb32f>* variance = nullptr);

}  // namespace airsim360::internal
