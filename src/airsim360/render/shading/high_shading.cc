#include "airsim360/render/shading/high_shading.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "airsim360/render/shading/high_rays.h"
#include "airsim360/render/shading/sampling.h"
#include "airsim360/render/shading/secondary_rays.h"
#include "airsim360/render/shading/shader_impl.h"

namespace airsim360::internal {
namespace {

constexpr int kTermCount = sizeof(LightTerms) / sizeof(float) / kBatch;

// Random numbers of each surface for its reflection; rough ones need none.
void ReflectionPoints(const RaySet& rays, const SurfaceSet& s, const TileSampling* sampling, float* u,
                      float* v) {
  for (int i = 0; i < rays.count; ++i) {
    const uint32_t slot = rays.slot[i];
    Vec2f point{};
    if (s.roughness[i] < 0.5f || s.metallic[i] > 0.2f) {
      point = sampling != nullptr ? SobolPoint(16 * sampling->tile + sampling->layout->phase[slot],
                                               sampling->seed ^ 0x51ed270bu)
                                  : SobolPoint(0, rays.key[i]);
    }
    u[i] = point.x, v[i] = point.y;
  }
  for (int i = rays.count; i % 16 != 0; ++i) u[i] = v[i] = 0;
}

void PutSky(const RaySet& sky, const LightSet& light, HighTile& tile) {
  for (int i = 0; i < sky.count; ++i) {
    const uint32_t k = sky.slot[i];
    float* terms = &tile.terms.ambient_r[k];
    for (int t = 0; t < kTermCount; ++t) terms[t * kBatch] = 0;
    tile.terms.rest_r[k] = light.r[i], tile.terms.rest_g[k] = light.g[i], tile.terms.rest_b[k] = light.b[i];
    tile.sun_seen[k] = 0;
    tile.normal_x[k] = tile.normal_y[k] = tile.normal_z[k] = 0;
    tile.light_r[k] = tile.light_g[k] = tile.light_b[k] = 0;
    tile.light_samples[k] = tile.penumbra[k] = 0;
  }
}

void PutSurfaces(const RaySet& rays, const SurfaceSet& s, const LightTerms& terms, HighTile& tile) {
  for (int t = 0; t < kTermCount; ++t) {
    const float* from = &terms.ambient_r[0] + t * kBatch;
    float* to = &tile.terms.ambient_r[0] + t * kBatch;
    for (int i = 0; i < rays.count; ++i) to[rays.slot[i]] = from[i];
  }
  for (int i = 0; i < rays.count; ++i) {
    const uint32_t k = rays.slot[i];
    tile.normal_x[k] = s.nx[i], tile.normal_y[k] = s.ny[i], tile.normal_z[k] = s.nz[i];
    tile.sun_seen[k] = s.sunlit[i];
  }
}

// Drops and flakes before a surface hide a share of every term and add their own light.
void DrawPrecipitation(const Shader::Impl& impl, const RaySet& rays, float cone_angle, LightTerms& terms) {
  LightSet black{}, own;
  std::copy(std::begin(terms.rest_r), std::end(terms.rest_r), own.r);
  std::copy(std::begin(terms.rest_g), std::end(terms.rest_g), own.g);
  std::copy(std::begin(terms.rest_b), std::end(terms.rest_b), own.b);
  impl.kernels.precipitation(impl.view, rays, false, cone_angle, own);
  impl.kernels.precipitation(impl.view, rays, false, cone_angle, black);
  const Vec3f drop{impl.view.air.drop_light[0], impl.view.air.drop_light[1], impl.view.air.drop_light[2]};
  for (int i = 0; i < rays.count; ++i) {
    terms.rest_r[i] = own.r[i], terms.rest_g[i] = own.g[i], terms.rest_b[i] = own.b[i];
    const float kept = drop.y > 0 ? 1 - black.g[i] / drop.y : 1;
    terms.ambient_r[i] *= kept, terms.ambient_g[i] *= kept, terms.ambient_b[i] *= kept;
    terms.sun_r[i] *= kept, terms.sun_g[i] *= kept, terms.sun_b[i] *= kept;
  }
}

}  // namespace

void ShadeHigh(const Shader& shader, const SunMapView& sun_map, const HitBatch& hits,
               const TileSampling* sampling, HighTile& tile) {
  const Shader::Impl& impl = shader.impl();
  const bool falling = impl.view.air.rain + impl.view.air.snow > 0;
  RaySet rays, sky;
  SplitHits(hits, rays, sky);
  if (sky.count > 0) {
    LightSet light;
    impl.kernels.sky(impl.view, sky, true, light);
    if (falling) impl.kernels.precipitation(impl.view, sky, true, hits.cone_angle, light);
    PutSky(sky, light, tile);
  }
  if (rays.count == 0) return;

  SurfaceSet surfaces;
  impl.kernels.prepare(impl.view, rays, surfaces);
  for (int i = 0; i < rays.count; ++i) tile.penumbra[rays.slot[i]] = 0;
  if (impl.sky) {
    if (sampling != nullptr)
      TraceSunDisc(impl, *sampling, rays, surfaces, tile.penumbra);
    else
      TraceSun(*impl.tracer, impl.tables, rays, surfaces);
  }
  impl.LightByLamps(rays, kLampRays, surfaces);
  alignas(64) float u[kBatch], v[kBatch];
  ReflectionPoints(rays, surfaces, sampling, u, v);
  impl.kernels.scatter(rays, u, v, surfaces);
  impl.FollowRays(rays, surfaces);

  LightTerms terms;
  impl.kernels.split(impl.view, rays, surfaces, terms);
  if (falling) DrawPrecipitation(impl, rays, hits.cone_angle, terms);
  PutSurfaces(rays, surfaces, terms, tile);
  if (sampling != nullptr) GatherAmbient(impl, sun_map, *sampling, rays, surfaces, terms, tile);
}

}  // namespace airsim360::internal
