#include "airsim360/render/shading/shader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "airsim360/render/shading/light_probes.h"
#include "airsim360/render/shading/secondary_rays.h"
#include "airsim360/render/shading/shade_view.h"
#include "airsim360/render/shading/shading_kernels.h"
#include "airsim360/render/shading/sky.h"
#include "airsim360/render/shading/surface_tables.h"

namespace airsim360 {
namespace {

using internal::kBatch;
using internal::LightSet;
using internal::Pad;
using internal::RaySet;
using internal::ShadeView;
using internal::SurfaceSet;
static_assert(HitBatch::kCapacity == kBatch);

constexpr float kPi = 3.14159265f;
// Input of the tone curve for sunlit ground of reflectance 0.18.
constexpr float kGreyLevel = 0.38f;

struct Kernels {
  decltype(&internal::isa_sse42::PrepareSurfaces) prepare = AIRSIM360_SELECT_KERNEL(PrepareSurfaces);
  decltype(&internal::isa_sse42::LightSurfaces) light = AIRSIM360_SELECT_KERNEL(LightSurfaces);
  decltype(&internal::isa_sse42::LookUpSky) sky = AIRSIM360_SELECT_KERNEL(LookUpSky);
  decltype(&internal::isa_sse42::ToneMapRow) tone = AIRSIM360_SELECT_KERNEL(ToneMapRow);
};

}  // namespace

struct Shader::Impl {
  Impl(std::shared_ptr<const RayTracer> t, const Environment& environment)
      : tracer(std::move(t)), tables(tracer->scene()) {
    const Scene& scene = tracer->scene();
    if (scene.sky_entity != kNoEntity) sky.emplace(environment);
    if (!scene.instances.empty())
      probes.emplace(*tracer, tables, sky ? &*sky : nullptr, internal::LightProbes::Options{});
    view = internal::MakeShadeView(scene, tables, sky ? &*sky : nullptr, probes ? &*probes : nullptr,
                                   &environment);
    exposure = ChooseExposure(scene);
  }

  // Grey ground in full light comes out the same by day; towards night the picture may get darker, but not as
  // fast as the light.
  float ChooseExposure(const Scene& scene) const {
    const auto luminance = [](Vec3f c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; };
    if (!sky) {
      const float light = luminance(scene.interior_light);
      return light > 0 ? kGreyLevel / (0.30f * light) : 1.0f;
    }
    const float light =
        luminance(sky->Irradiance({0, 0, 1}) + sky->sun_irradiance() * std::max(0.0f, sky->to_sun().z));
    constexpr float kNoon = 14.0f;
    return kGreyLevel * kPi / (0.18f * kNoon) * std::pow(kNoon / std::max(light, 1e-3f), 0.9f);
  }

  void ShadeReflections(const RaySet& rays, SurfaceSet& s) const;  // fills reflected_*, traced
  void ShadeSurfaces(RaySet& rays, int bounce, LightSet& light) const;

  std::shared_ptr<const RayTracer> tracer;
  internal::SurfaceTables tables;
  std::optional<internal::Sky> sky;
  std::optional<internal::LightProbes> probes;
  ShadeView view{};
  Kernels kernels;
  float exposure = 1;
};

Shader::Shader(std::shared_ptr<const RayTracer> tracer, const Environment& environment)
    : impl_(std::make_unique<const Impl>(std::move(tracer), environment)) {}
Shader::~Shader() = default;

float Shader::Exposure() const { return impl_->exposure; }

void Shader::Impl::ShadeReflections(const RaySet& rays, SurfaceSet& s) const {
  RaySet hits, misses;
  internal::TraceReflections(*tracer, rays, s, hits, misses);
  const auto put = [&](const RaySet& set, const LightSet& light) {
    for (int i = 0; i < set.count; ++i) {
      const uint32_t slot = set.slot[i];
      s.reflected_r[slot] = light.r[i], s.reflected_g[slot] = light.g[i], s.reflected_b[slot] = light.b[i];
      s.traced[slot] = 1;
    }
  };
  LightSet light;
  if (hits.count > 0) {
    ShadeSurfaces(hits, 1, light);
    put(hits, light);
  }
  if (misses.count > 0) {
    Pad(misses);
    kernels.sky(view, misses, false, light);
    put(misses, light);
  }
}

void Shader::Impl::ShadeSurfaces(RaySet& rays, int bounce, LightSet& light) const {
  SurfaceSet surfaces;
  Pad(rays);
  kernels.prepare(view, rays, surfaces);
  if (sky) internal::TraceSun(*tracer, rays, surfaces);
  if (bounce == 0) {
    internal::TraceContact(*tracer, rays, surfaces);
    ShadeReflections(rays, surfaces);
  }
  kernels.light(view, rays, surfaces, light);
}

void Shader::Shade(const HitBatch& hits, RadianceBatch& radiance) const {
  // Surfaces and sky apart.
  RaySet surfaces, sky;
  surfaces.count = sky.count = 0;
  for (int k = 0; k < hits.count; ++k) {
    const bool miss = hits.instance[k] == kMiss;
    RaySet& set = miss ? sky : surfaces;
    const int i = set.count++;
    set.ox[i] = hits.origin.x, set.oy[i] = hits.origin.y, set.oz[i] = hits.origin.z;
    set.dx[i] = hits.direction_x[k], set.dy[i] = hits.direction_y[k], set.dz[i] = hits.direction_z[k];
    set.slot[i] = static_cast<uint32_t>(k);
    set.key[i] = hits.sample_key[k];
    set.distance[i] = miss ? 0 : hits.distance[k];
    set.width[i] = set.distance[i] * hits.cone_angle;
    set.u[i] = hits.u[k], set.v[i] = hits.v[k];
    set.instance[i] = hits.instance[k], set.triangle[i] = hits.triangle[k];
  }

  const auto put = [&](const RaySet& set, const LightSet& light) {
    for (int i = 0; i < set.count; ++i) {
      const uint32_t slot = set.slot[i];
      radiance.r[slot] = light.r[i], radiance.g[slot] = light.g[i], radiance.b[slot] = light.b[i];
    }
  };
  LightSet light;
  if (surfaces.count > 0) {
    impl_->ShadeSurfaces(surfaces, 0, light);
    put(surfaces, light);
  }
  if (sky.count > 0) {
    Pad(sky);
    impl_->kernels.sky(impl_->view, sky, true, light);
    put(sky, light);
  }
}

void Shader::ToneMap(const float* r, const float* g, const float* b, int count, double exposure_ev,
                     Rgb8* out) const {
  impl_->kernels.tone(r, g, b, count, Exposure() * static_cast<float>(std::exp2(exposure_ev)), out);
}

}  // namespace airsim360
