// Rays of paths, and those from paths to lights.
#pragma once

#include "airsim360/render/reference/path_kernels.h"
#include "airsim360/render/reference/path_lights.h"

namespace airsim360::internal {

/// What all paths of an image share. Refers to tracer and shader.
struct PathScene {
  PathScene(const RayTracer& tracer, const Shader& shader);

  const RayTracer& tracer;
  const ShadeView& view;
  const Shader::Impl::Kernels& kernels;
  PathLights lights;
  Vec3f room_light;          ///< ambient light of closed rooms
  bool clear_panes = false;  ///< shadow rays may pass some surfaces
  decltype(&isa_sse42::EvaluateScatter) evaluate = AIRSIM360_SELECT_KERNEL(EvaluateScatter);
  decltype(&isa_sse42::SampleScatter) sample = AIRSIM360_SELECT_KERNEL(SampleScatter);
  decltype(&isa_sse42::PassStraight) pass_straight = AIRSIM360_SELECT_KERNEL(PassStraight);
};

/// Rays with what each brings to its path where nothing hides it.
struct ShadowRays {
  RaySet rays;
  Vec3f light[kBatch];
  float reach[kBatch];  ///< how far it goes
};

/// Splits rays into those that meet a surface and those that do not; `width` and `slot` are copied. `reach`,
/// if not nullptr, is how far each goes.
void TraceNearest(const RayTracer& tracer, const RaySet& rays, bool coherent, RaySet& hits, RaySet& misses, const float* reach = nullptr);
/// Blackens the light of rays that meet anything.
void DropHidden(const RayTracer& tracer, ShadowRays& shadow);
/// The same, but clear panes let their part through.
void DimByPanes(const PathScene& scene, ShadowRays& shadow);
/// How far rays start from surface i.
float OffsetOf(const RaySet& rays, const SurfaceSet& surfaces, int i);
/// Origin of a ray in direction `d` from surface i, on the side that it leaves to.
Vec3f LeaveSurface(const RaySet& rays, const SurfaceSet& surfaces, int i, Vec3f d);

}  // namespace airsim360::internal
