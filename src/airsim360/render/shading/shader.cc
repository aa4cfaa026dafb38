#include "airsim360/render/shading/shader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "airsim360/render/shading/light_probes.h"
#include "airsim360/render/shading/shade_view.h"
#include "airsim360/render/shading/shading_kernels.h"
#include "airsim360/render/shading/sky.h"
#include "airsim360/render/shading/surface_tables.h"

namespace airsim360 {
namespace {

using internal::kBatch;
using internal::LightSet;
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

// Offset of secondary rays: above the rounding errors of hit points.
float OffsetAt(Vec3f p, float distance) {
  return 1e-3f + 4e-6f * (std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z) + distance);
}

// Fills the tail of a set so that whole vectors read sane values.
void Pad(RaySet& set) {
  if (set.count == 0) return;
  const int from = set.count - 1;
  for (int i = set.count; i < kBatch && i % 16 != 0; ++i) {
    set.ox[i] = set.ox[from], set.oy[i] = set.oy[from], set.oz[i] = set.oz[from];
    set.dx[i] = set.dx[from], set.dy[i] = set.dy[from], set.dz[i] = set.dz[from];
    set.distance[i] = set.distance[from], set.width[i] = set.width[from];
    set.u[i] = set.u[from], set.v[i] = set.v[from];
    set.instance[i] = set.instance[from], set.triangle[i] = set.triangle[from], set.key[i] = set.key[from];
  }
}

// Sixteen rays collected one by one, with the place where each answer goes.
struct RayQueue {
  RayHit16 rays{};
  alignas(64) int valid[16] = {};
  int lane[16] = {};
  int count = 0;

  void Add(Vec3f p, Vec3f d, int index) {
    const int i = count++;
    rays.origin_x[i] = p.x, rays.origin_y[i] = p.y, rays.origin_z[i] = p.z;
    rays.direction_x[i] = d.x, rays.direction_y[i] = d.y, rays.direction_z[i] = d.z;
    rays.t_near[i] = 0, rays.t_far[i] = INFINITY, rays.mask[i] = UINT32_MAX;
    lane[i] = index;
  }
  // Marks the lanes in use; the others repeat the last ray.
  void Close() {
    for (int i = 0; i < 16; ++i) {
      valid[i] = i < count ? -1 : 0;
      if (i < count) continue;
      rays.origin_x[i] = rays.origin_x[0], rays.origin_y[i] = rays.origin_y[0], rays.origin_z[i] = rays.origin_z[0];
      rays.direction_x[i] = rays.direction_x[0], rays.direction_y[i] = rays.direction_y[0], rays.direction_z[i] = rays.direction_z[0];
      rays.t_near[i] = 0, rays.t_far[i] = INFINITY, rays.mask[i] = UINT32_MAX;
    }
  }
};

}  // namespace

struct Shader::Impl {
  explicit Impl(std::shared_ptr<const RayTracer> t) : tracer(std::move(t)), tables(tracer->scene()) {
    const Scene& scene = tracer->scene();
    if (scene.sky_entity != kNoEntity) sky.emplace(scene.daylight);
    if (!scene.instances.empty()) probes.emplace(*tracer, tables, sky ? &*sky : nullptr, internal::LightProbes::Options{});
    view = internal::MakeShadeView(scene, tables, sky ? &*sky : nullptr, probes ? &*probes : nullptr);
    exposure = ChooseExposure(scene);
  }

  // Grey ground in full light comes out the same by day; towards night the picture may get darker, but not as fast as the light.
  float ChooseExposure(const Scene& scene) const {
    const auto luminance = [](Vec3f c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; };
    if (!sky) {
      const float light = luminance(scene.interior_light);
      return light > 0 ? kGreyLevel / (0.30f * light) : 1.0f;
    }
    const float light = luminance(sky->Irradiance({0, 0, 1}) + sky->sun_irradiance() * std::max(0.0f, sky->to_sun().z));
    constexpr float kNoon = 14.0f;
    return kGreyLevel * kPi / (0.18f * kNoon) * std::pow(kNoon / std::max(light, 1e-3f), 0.9f);
  }

  void TraceSun(const RaySet& rays, SurfaceSet& s) const;
  void TraceReflections(const RaySet& rays, SurfaceSet& s) const;
  void ShadeSurfaces(RaySet& rays, int bounce, LightSet& light) const;

  std::shared_ptr<const RayTracer> tracer;
  internal::SurfaceTables tables;
  std::optional<internal::Sky> sky;
  std::optional<internal::LightProbes> probes;
  ShadeView view{};
  Kernels kernels;
  float exposure = 1;
};

Shader::Shader(std::shared_ptr<const RayTracer> tracer) : impl_(std::make_unique<const Impl>(std::move(tracer))) {}
Shader::~Shader() = default;

float Shader::Exposure() const { return impl_->exposure; }

// Turns `sunlit` from "may matter" to "is seen".
void Shader::Impl::TraceSun(const RaySet& rays, SurfaceSet& s) const {
  RayQueue queue;
  const auto flush = [&] {
    bool occluded[16] = {};
    queue.Close();
    tracer->Occluded16(queue.valid, queue.rays, occluded, true);
    for (int i = 0; i < queue.count; ++i) s.sunlit[queue.lane[i]] = occluded[i] ? 0.0f : 1.0f;
    queue.count = 0;
  };
  for (int i = 0; i < rays.count; ++i) {
    if (s.sunlit[i] == 0) continue;
    const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]}, l{s.lx[i], s.ly[i], s.lz[i]};
    const float side = Dot(g, l) < 0 ? -1.0f : 1.0f;
    queue.Add(p + g * (side * OffsetAt(p, rays.distance[i])), l, i);
    if (queue.count == 16) flush();
  }
  if (queue.count > 0) flush();
}

// Follows the reflections of panes, water and mirrors to what they show.
void Shader::Impl::TraceReflections(const RaySet& rays, SurfaceSet& s) const {
  RaySet hits, misses;
  hits.count = misses.count = 0;
  RayQueue queue;
  const auto flush = [&] {
    queue.Close();
    tracer->Intersect16(queue.valid, queue.rays, false);
    for (int k = 0; k < queue.count; ++k) {
      const RayHit16& r = queue.rays;
      const int from = queue.lane[k];
      const bool miss = r.geometry[k] == kMiss;
      RaySet& set = miss ? misses : hits;
      const int i = set.count++;
      set.ox[i] = r.origin_x[k], set.oy[i] = r.origin_y[k], set.oz[i] = r.origin_z[k];
      set.dx[i] = r.direction_x[k], set.dy[i] = r.direction_y[k], set.dz[i] = r.direction_z[k];
      set.slot[i] = static_cast<uint32_t>(from);
      set.key[i] = 0;
      if (miss) continue;
      const SurfaceRef ref = tracer->Resolve(r.geometry[k], r.instance[k], r.primitive[k]);
      set.distance[i] = r.t_far[k];
      set.width[i] = rays.width[from] * (1 + r.t_far[k] / std::max(rays.distance[from], 0.01f));
      set.u[i] = r.u[k], set.v[i] = r.v[k];
      set.instance[i] = ref.instance, set.triangle[i] = ref.triangle;
    }
    queue.count = 0;
  };
  for (int i = 0; i < rays.count; ++i) {
    if (s.mirror[i] == 0) continue;
    const Vec3f p{s.px[i], s.py[i], s.pz[i]}, g{s.gx[i], s.gy[i], s.gz[i]};
    queue.Add(p + g * OffsetAt(p, rays.distance[i]), {s.rx[i], s.ry[i], s.rz[i]}, i);
    if (queue.count == 16) flush();
  }
  if (queue.count > 0) flush();

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
  if (sky) TraceSun(rays, surfaces);
  if (bounce == 0) TraceReflections(rays, surfaces);
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

void Shader::ToneMap(const float* r, const float* g, const float* b, int count, double exposure_ev, Rgb8* out) const {
  impl_->kernels.tone(r, g, b, count, Exposure() * static_cast<float>(std::exp2(exposure_ev)), out);
}

}  // namespace airsim360
