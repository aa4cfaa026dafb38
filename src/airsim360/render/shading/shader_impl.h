// The inside of a Shader, for the tiers that are made of the same parts.
#pragma once

#include <memory>
#include <optional>

#include "airsim360/render/shading/light_probes.h"
#include "airsim360/render/shading/shader.h"
#include "airsim360/render/shading/shading_kernels.h"
#include "airsim360/render/shading/sky.h"
#include "airsim360/render/shading/surface_tables.h"

namespace airsim360 {

struct Shader::Impl {
  /// The kernels of shading_kernels.h for this machine.
  struct Kernels {
    decltype(&internal::isa_sse42::PrepareSurfaces) prepare = AIRSIM360_SELECT_KERNEL(PrepareSurfaces);
    decltype(&internal::isa_sse42::LightSurfaces) light = AIRSIM360_SELECT_KERNEL(LightSurfaces);
    decltype(&internal::isa_sse42::SplitLight) split = AIRSIM360_SELECT_KERNEL(SplitLight);
    decltype(&internal::isa_sse42::ScatterReflections) scatter = AIRSIM360_SELECT_KERNEL(ScatterReflections);
    decltype(&internal::isa_sse42::AmbientRays) ambient_rays = AIRSIM360_SELECT_KERNEL(AmbientRays);
    decltype(&internal::isa_sse42::ShadeAmbient) shade_ambient = AIRSIM360_SELECT_KERNEL(ShadeAmbient);
    decltype(&internal::isa_sse42::LookUpSky) sky = AIRSIM360_SELECT_KERNEL(LookUpSky);
    decltype(&internal::isa_sse42::ToneMapRow) tone = AIRSIM360_SELECT_KERNEL(ToneMapRow);
  };

  Impl(std::shared_ptr<const RayTracer> tracer, const Environment& environment);

  float ChooseExposure(const Scene& scene) const;
  /// Traces the rays that mirrors and clear panes send on (where the surfaces say so) and shades what they
  /// meet in the same way, once.
  void FollowRays(const internal::RaySet& rays, internal::SurfaceSet& surfaces) const;
  /// Radiance of surfaces; `bounce` 0 = seen by the camera, 1 = seen in another surface.
  void ShadeSurfaces(internal::RaySet& rays, int bounce, internal::LightSet& light) const;

  std::shared_ptr<const RayTracer> tracer;
  internal::SurfaceTables tables;
  std::optional<internal::Sky> sky;
  std::optional<internal::LightProbes> probes;
  internal::ShadeView view{};
  Kernels kernels;
  float exposure = 1;
};

namespace internal {
/// Splits a batch into rays that met a surface and rays that met nothing, packed and padded; `slot` is the
/// index in the batch.
void SplitHits(const HitBatch& hits, RaySet& surfaces, RaySet& sky);
}  // namespace internal

}  // namespace airsim360
