#include "airsim360/render/high/high_shading.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "airsim360/render/high/high_gloss.h"
#include "airsim360/render/high/high_rays.h"
#include "airsim360/render/shading/sampling.h"
#include "airsim360/render/shading/secondary_rays.h"
#include "airsim360/render/shading/shader_impl.h"
#include "airsim360/render/shading/stretched_surfaces.h"

namespace airsim360::internal {
namespace {

constexpr int kTermCount = sizeof(LightTerms) / sizeof(float) / kBatch;

// Random numbers of each surface for its reflection; rough ones need none.
void ReflectionPoints(const RaySet& rays, const SurfaceSet& s, const TileSampling* sampling, float* u, float* v) {
  for (int i = 0; i < rays.count; ++i) {
    const uint32_t slot = rays.slot[i];
    Vec2f point{};
    if (s.roughness[i] < 0.5f || s.metallic[i] > kShinyMetal) {
      point = sampling != nullptr ? SobolPoint(16 * sampling->tile + sampling->layout->phase[slot], sampling->seed ^ 0x51ed270bu)
                                  : SobolPoint(0, rays.key[i]);
    }
    u[i] = point.x, v[i] = point.y;
  }
  for (int i = rays.count; i % 16 != 0; ++i) u[i] = v[i] = 0;
}

// One number for every hit of a set; all of them are often one after the other.
template <class Number>
void Put(const RaySet& set, bool all, const Number* from, Number* to) {
  if (all) {
    std::copy_n(from, set.count, to);
  } else {
    for (int i = 0; i < set.count; ++i) to[set.slot[i]] = from[i];
  }
}

constexpr float kZeros[kBatch] = {};
constexpr uint8_t kZeroBytes[kBatch] = {};

void PutSky(const RaySet& sky, bool all, const LightSet& light, LightTerms& terms, HighTile& tile) {
  for (float* plane : {terms.ambient_r, terms.ambient_g, terms.ambient_b, terms.sun_r, terms.sun_g, terms.sun_b, tile.sun_seen,
                       tile.normal_x, tile.normal_y, tile.normal_z, tile.light_r, tile.light_g, tile.light_b})
    Put(sky, all, kZeros, plane);
  Put(sky, all, light.r, terms.rest_r), Put(sky, all, light.g, terms.rest_g);
  Put(sky, all, light.b, terms.rest_b);
  Put(sky, all, kZeroBytes, tile.light_samples), Put(sky, all, kZeroBytes, tile.penumbra);
}

void PutSurfaces(const RaySet& rays, bool all, const SurfaceSet& s, HighTile& tile) {
  Put(rays, all, s.nx, tile.normal_x), Put(rays, all, s.ny, tile.normal_y), Put(rays, all, s.nz, tile.normal_z);
  Put(rays, all, s.sunlit, tile.sun_seen);
}

void PutTerms(const RaySet& rays, const LightTerms& from, LightTerms& to) {
  for (int t = 0; t < kTermCount; ++t) Put(rays, false, &from.ambient_r[0] + t * kBatch, &to.ambient_r[0] + t * kBatch);
}

// Sun on scattered surfaces: where it can matter and is not known.
void TraceUnknownSun(const Shader::Impl& impl, const RaySet& rays, const float* known, SurfaceSet& s) {
  bool asked[kBatch];
  for (int i = 0; i < rays.count; ++i) {
    asked[i] = s.sunlit[i] != 0;
    if (known[rays.slot[i]] >= 0) s.sunlit[i] = 0;
  }
  TraceSun(*impl.tracer, impl.tables, rays, s);
  for (int i = 0; i < rays.count; ++i) {
    if (asked[i] && known[rays.slot[i]] >= 0) s.sunlit[i] = known[rays.slot[i]];
  }
}

// In rooms rays of the skin meet the lamps themselves: their highlights would count twice.
void LeaveLampsToRays(const IndoorLight& room, const float* sharp, int count, SurfaceSet& s) {
  for (int i = 0; i < count; ++i)
    if (room.share[i] > 0.5f && sharp[i] == 0 && s.mirror[i] != 0) s.lamp_shine_r[i] = s.lamp_shine_g[i] = s.lamp_shine_b[i] = 0;
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

void ShadeHigh(const Shader& shader, const SunMapView& sun_map, const HitBatch& hits, const TileSampling* sampling, const float* sun_known,
               LightTerms& terms, HighTile& tile, GlossPixels* gloss) {
  const Shader::Impl& impl = shader.impl();
  const bool falling = impl.view.air.rain + impl.view.air.snow > 0;
  RaySet rays, sky;
  SplitHits(hits, rays, sky);
  if (sky.count > 0) {
    LightSet light;
    impl.kernels.sky(impl.view, sky, true, light);
    if (falling) impl.kernels.precipitation(impl.view, sky, true, hits.cone_angle, light);
    PutSky(sky, rays.count == 0, light, terms, tile);
  }
  if (rays.count == 0) return;

  SurfaceSet surfaces;
  const bool all = sky.count == 0;
  static const auto prepare = AIRSIM360_SELECT_KERNEL(PrepareStretched);
  prepare(impl.view, rays, surfaces);
  Put(rays, all, kZeroBytes, tile.penumbra);
  if (impl.sky) {
    if (sampling != nullptr)
      TraceSunDisc(impl, *sampling, rays, surfaces, tile.penumbra);
    else
      TraceUnknownSun(impl, rays, sun_known, surfaces);
  }
  IndoorLight room;
  const bool indoors = impl.LookIndoors(rays, surfaces, room);
  impl.LightByLamps(rays, kLampRays, indoors ? room.share : nullptr, surfaces);
  if (indoors && impl.view.lamps.lamps != nullptr) impl.kernels.mix_lamps(room, rays.count, surfaces);
  impl.LightByMovingLamps(rays, kLampRays, surfaces);
  alignas(64) float u[kBatch], v[kBatch];
  ReflectionPoints(rays, surfaces, sampling, u, v);
  float sharp[kBatch];
  std::copy_n(surfaces.mirror, rays.count, sharp);
  impl.kernels.scatter(rays, u, v, surfaces);
  GlossSet glossy;
  if (indoors && gloss != nullptr) FindGloss(impl, rays, room, sharp, surfaces, glossy);
  if (indoors) LeaveLampsToRays(room, sharp, rays.count, surfaces);
  impl.FollowRays(rays, surfaces);

  LightTerms scattered, &own = all ? terms : scattered;  // in the order of `rays`
  impl.kernels.split(impl.view, rays, surfaces, own);
  if (falling) DrawPrecipitation(impl, rays, hits.cone_angle, own);
  if (!all) PutTerms(rays, own, terms);
  PutSurfaces(rays, all, surfaces, tile);
  if (glossy.any) GatherGloss(impl, sampling, rays, surfaces, room, glossy, *gloss);
  if (sampling != nullptr) GatherAmbient(impl, sun_map, *sampling, rays, surfaces, own, indoors ? &room : nullptr, tile);
}

}  // namespace airsim360::internal
