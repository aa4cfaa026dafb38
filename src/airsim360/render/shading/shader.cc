#include "airsim360/render/shading/shader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "airsim360/base/log.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/shading/light_cache.h"
#include "airsim360/render/shading/secondary_rays.h"
#include "airsim360/render/shading/shade_view.h"
#include "airsim360/render/shading/shader_impl.h"
#include "airsim360/render/shading/town_light.h"
#include "airsim360/render/shared/dimmest_white.h"
#include "airsim360/scene/luminance.h"

namespace airsim360 {
namespace {

using internal::kBatch;
using internal::LightSet;
using internal::Pad;
using internal::RaySet;
using internal::SurfaceSet;
static_assert(HitBatch::kCapacity == kBatch);

// Of what is polished, in tier `fast`: reflectance of the skin from which the mirrored ray counts, and counts alone; roughness up to
// which it counts alone, and from which it does not; radians of the lobe (to both sides of its middle) per alpha.
constexpr float kLeastPolished = 0.05f, kWholePolished = 0.085f;
constexpr float kPolished = 0.2f, kSatin = 0.3f;
constexpr float kLobeWidth = 1.4f;
constexpr float kMirroredThing = 0.35f;  // m: what a lobe as wide makes half as clear

// Input of the tone curve for sunlit ground of reflectance 0.18.
constexpr float kGreyLevel = 0.38f;
// Irradiance to which pictures get brighter: far below a moonless night.
constexpr float kDarkest = 1e-8f;

// An environment without what the light does not depend on: how wet and snowy surfaces are.
Environment LightPart(Environment environment) {
  environment.wetness = environment.snow_depth = 0;
  return environment;
}

// Without what lies before the sky, too.
Environment SkyTablePart(const Environment& environment) {
  Environment part = LightPart(environment);
  part.haze = 1;
  part.visibility_m = part.rain_mm_h = part.snowfall_mm_h = 0;
  return part;
}

std::string KeyOf(const Environment& environment) {
  CacheKey key("light", 1);
  AddToKey(key, environment);
  return key.Name();
}

// Everything that a sky depends on.
internal::LightCache SkyCache(const Environment& environment, Vec3f place, float town) {
  CacheKey key("any_scene", 1);
  AddToKey(key, LightPart(environment));
  return internal::LightCache(key.Add(place.x).Add(place.y).Add(place.z).Add(town));
}

}  // namespace

Shader::Impl::Impl(std::shared_ptr<const RayTracer> t, const Environment& environment)
    : tracer(std::move(t)), tables(tracer->scene(), environment.lamps_on()), lights(tracer->scene(), tables, environment), built(tracer) {
  SetLight(environment);
}

void Shader::Impl::SetLight(const Environment& environment) {
  using internal::Sky, internal::LampGrid, internal::LightProbes;
  const Scene& scene = tracer->scene();
  const std::string key = KeyOf(LightPart(environment)), table_key = KeyOf(SkyTablePart(environment));
  auto same = std::ranges::find(last_lights, key, &Light::key);
  if (same != last_lights.end()) {
    std::rotate(same, same + 1, last_lights.end());
  } else {
    // Sky, lamps by its light, probes by both.
    Light light;
    light.key = key, light.table_key = table_key;
    const internal::LightCache cache(*tracer, environment);
    // Rooms that glow by themselves have a sky in name alone: what is seen through the holes of a scan.
    if (scene.sky_entity != kNoEntity && scene.interior_light == Vec3f{}) {
      const auto like = std::ranges::find(last_lights, table_key, &Light::table_key);
      const Sky* table = like == last_lights.end() ? nullptr : like->sky.get();
      const Vec3f place = scene.spawn.value_or(Vec3f{});
      // By day no lamp lights the sky, so that scenes with other lamps share one.
      const float town = environment.lamps_on() ? internal::TownLight(scene, lights) : 0;
      const auto make = [&] { return Sky(environment, place, table, town); };
      // People, drones or a model of one's own change no sky. Where the scene is not kept only its first is: weather that
      // changes all day would fill the disk.
      const bool keeps = cache.enabled() || last_lights.empty();
      light.sky = std::make_shared<const Sky>(keeps ? SkyCache(environment, place, town).Get<Sky>("sky", make) : make());
    }
    light.lamps = std::make_shared<const LampGrid>(*tracer, lights, light.sky ? light.sky->GroundIlluminance() : 0.0f);
    if (!scene.instances.empty()) {
      const internal::ProbeLight around{*tracer, tables, light.sky.get(), &lights, light.lamps.get()};
      light.probes = std::make_shared<const LightProbes>(
          cache.Get<LightProbes>("light_probes", [&] { return LightProbes(around, LightProbes::Options{}); }));
    }
    if (last_lights.size() == kMostLights) last_lights.erase(last_lights.begin());
    last_lights.push_back(std::move(light));
  }
  this->environment = environment;
  sky = last_lights.back().sky, lamps = last_lights.back().lamps, probes = last_lights.back().probes;
  view = internal::MakeShadeView(scene, tables, sky.get(), probes.get(), &environment);
  view.lamps = lamps->view();
  FindRoofs();
  exposure = ChooseExposure(scene, environment.lamps_on());
  indoor = last_lights.back().indoor;
  if (wants_indoor && !indoor) FindIndoors();
}

void Shader::Impl::FindRoofs() {
  if (!sky || view.air.weather + view.wetness + view.snow <= 0 || built->scene().instances.empty()) return;
  if (!roofs) roofs = std::make_shared<const internal::RoofMap>(*internal::StaticTracer(built), tables);
  view.roofs = roofs->view();
}

void Shader::Impl::FindIndoors() {
  using internal::IndoorCache, internal::Enclosure;
  wants_indoor = true;
  if (!enclosure) enclosure = std::make_shared<const Enclosure>(*built);
  if (!enclosure->any() || indoor) return;
  moving = internal::MovingInstances(built->scene());
  const auto still = internal::StaticTracer(built);
  const auto around = [this](Vec3f p, Vec3f n) {
    if (probes && probes->Covers(p)) return probes->Irradiance(p, n);
    return sky ? sky->Irradiance(n) * 0.5f + sky->ground_radiance() * (kPiF * (0.25f - 0.25f * n.z)) : Vec3f{};
  };
  const internal::IndoorWorld world{*still, tables, sky.get(), &lights, lamps.get(), around};
  const auto make = [&] {
    const LongTask lighting("lighting the rooms of " + built->scene().name);
    return IndoorCache(internal::LightSolver(world, *enclosure, {}));
  };
  IndoorCache kept = internal::LightCache(*built, environment).Get<IndoorCache>("indoor_light", make);
  if (!kept.Sound()) kept = make();
  indoor = last_lights.back().indoor = std::make_shared<const IndoorCache>(std::move(kept));
}

bool Shader::Impl::LookIndoors(const RaySet& rays, const SurfaceSet& s, internal::IndoorLight& light) const {
  if (!indoor) return false;
  kernels.indoors(indoor->view(), s, rays.count, light);
  bool any = false;
  for (int i = 0; i < rays.count; ++i) {
    if (moving[rays.instance[i]]) light.share[i] = 0;
    any |= light.share[i] > 0;
  }
  return any;
}

float Shader::Impl::Daylight() const {
  if (!sky) return 0;
  return sky->GroundIlluminance();
}

// Grey ground in full light comes out the same by day; towards night the picture may get darker, but not as
// fast as the light. Where lamps bring more than the sky the eye is used to their light.
float Shader::Impl::ChooseExposure(const Scene& scene, bool lamps_on) const {
  float of_lamps = lamps->TypicalLight();
  if (!sky) {
    const float light = Luminance(scene.interior_light) + of_lamps / kPiF;
    return light > 0 ? kGreyLevel / (0.30f * light) : 1.0f;
  }
  // Signs and windows light streets too, which the probes alone have gathered.
  if (lamps_on && probes) of_lamps = std::max(of_lamps, probes->TypicalLight());
  const float light = std::max(Daylight(), of_lamps);
  constexpr float kNoon = 14.0f;
  // A camera meters the sky too, which is far brighter than the ground where neither sun nor lamps throw
  // shadows.
  constexpr float kClearShare = 0.15f, kWeight = 0.6f;
  const float diffuse = Luminance(sky->Irradiance({0, 0, 1})) / std::max(light, kDarkest);
  const float metered = 1 / (1 + kWeight * std::max(0.0f, diffuse - kClearShare));
  return metered * kGreyLevel * kPiF / (0.18f * kNoon) * std::pow(kNoon / std::max(light, kDarkest), 0.85f);
}

Shader::Shader(std::shared_ptr<const RayTracer> tracer, const Environment& environment)
    : impl_(std::make_unique<Impl>(std::move(tracer), environment)) {}
Shader::~Shader() = default;

void Shader::SetEnvironment(const Environment& environment) { impl_->SetLight(environment); }

void Shader::PrepareIndoors() { impl_->FindIndoors(); }
bool Shader::HasRooms() const {
  if (!impl_->enclosure) impl_->enclosure = std::make_shared<const internal::Enclosure>(*impl_->built);
  return impl_->enclosure->any();
}

bool Shader::IsIndoors(Vec3f p) const { return HasRooms() && impl_->enclosure->Holds(*impl_->built, p); }

void Shader::Apply(std::shared_ptr<const RayTracer> tracer) {
  impl_->tables.Apply(tracer->scene(), tracer->moved(), tracer->deformed());
  impl_->tracer = std::move(tracer);
  impl_->FollowLamps();
}

void Shader::Impl::FollowLamps() {
  const std::vector<MovedInstance> away = internal::AwayFromHome(*tracer);
  std::vector<uint32_t> instances;
  for (const MovedInstance& moved : away) instances.push_back(moved.instance);
  view.lamps = lamps->ViewWithout(instances, still_lamps);
  moving_lamps.Follow(*tracer, tables, environment, away, Daylight());
  view.moving_lamps = moving_lamps.view();
}

float Shader::Exposure() const { return impl_->exposure; }

double Shader::MostExposure() const { return impl_->sky ? 1 / (kDimmestWhite * kNit) : std::numeric_limits<double>::infinity(); }

void Shader::Impl::FollowRays(const RaySet& rays, SurfaceSet& s, const SunNeighbours* around, SunPixel* sun) const {
  if (around != nullptr) internal::GuessReflections(*around, rays, s);
  RaySet hits, misses;
  LightSet light;
  std::optional<internal::PaneTint> panes;
  if (indoor) panes.emplace(internal::PaneTint{tables});
  internal::PaneTint* const tint = panes ? &*panes : nullptr;
  // Radiance of the rays just traced, handed to `put` with the surface that sent each.
  const auto shade = [&](auto keep) {
    const auto put = [&](uint32_t slot, float r, float g, float b) {
      if (tint != nullptr) r *= tint->of[slot].x, g *= tint->of[slot].y, b *= tint->of[slot].z;
      keep(slot, r, g, b);
    };
    if (hits.count > 0) ShadeSurfaces(hits, 1, light);
    for (int i = 0; i < hits.count; ++i) put(hits.slot[i], light.r[i], light.g[i], light.b[i]);
    Pad(misses);
    if (misses.count > 0) kernels.sky(view, misses, false, light);
    for (int i = 0; i < misses.count; ++i) put(misses.slot[i], light.r[i], light.g[i], light.b[i]);
  };
  internal::TraceReflections(*tracer, rays, s, tint, hits, misses);
  shade([&](uint32_t slot, float r, float g, float b) {
    s.reflected_r[slot] = r, s.reflected_g[slot] = g, s.reflected_b[slot] = b;
    s.traced[slot] = 1;
  });
  if (sun != nullptr) internal::KeepReflections(rays, s, sun);
  internal::TraceClear(*tracer, rays, s, tint, hits, misses);
  shade([&](uint32_t slot, float r, float g, float b) {
    s.behind_r[slot] = r, s.behind_g[slot] = g, s.behind_b[slot] = b;
    s.clear[slot] = 1;
  });
}

namespace {

// How much of what a surface mirrors is a ray's.
float PolishedShare(const RaySet& rays, const SurfaceSet& s, int i) {
  using namespace internal;
  if (s.kind[i] > 0.5f || s.coat[i] > 0.05f || s.traced[i] != 0 || s.roughness[i] >= kSatin) return 0;
  const scalar::Bsdf bsdf = scalar::bsdf_make(0.0f, {s.ar[i], s.ag[i], s.ab[i]}, s.metallic[i], s.roughness[i], 0.0f, 0.0f, 0.0f);
  const float facing = -(s.nx[i] * rays.dx[i] + s.ny[i] * rays.dy[i] + s.nz[i] * rays.dz[i]);
  const float skin = Luminance(scalar::bsdf_reflected(scalar::bsdf_side(bsdf, std::max(facing, 0.02f))));
  const auto ramp = [](float x, float none, float all) { return std::clamp((x - none) / (all - none), 0.0f, 1.0f); };
  return ramp(skin, kLeastPolished, kWholePolished) * ramp(s.roughness[i], kSatin, kPolished);
}

// Without those that `leave` names.
template <class Leave>
void LeaveOut(RaySet& set, const Leave& leave) {
  int kept = 0;
  for (int i = 0; i < set.count; ++i) {
    if (leave(i)) continue;
    set.ox[kept] = set.ox[i], set.oy[kept] = set.oy[i], set.oz[kept] = set.oz[i];
    set.dx[kept] = set.dx[i], set.dy[kept] = set.dy[i], set.dz[kept] = set.dz[i];
    set.distance[kept] = set.distance[i], set.width[kept] = set.width[i], set.u[kept] = set.u[i], set.v[kept] = set.v[i];
    set.instance[kept] = set.instance[i], set.triangle[kept] = set.triangle[i], set.slot[kept] = set.slot[i], set.key[kept] = set.key[i];
    ++kept;
  }
  set.count = kept;
}

}  // namespace

void Shader::Impl::FollowPolished(const RaySet& rays, const internal::IndoorLight& room, SurfaceSet& s) const {
  float share[kBatch];
  bool any = false;
  for (int i = 0; i < rays.count; ++i) {
    share[i] = room.share[i] > 0.5f ? PolishedShare(rays, s, i) : 0;
    any |= share[i] > 0;
  }
  if (!any) return;
  for (int i = 0; i < rays.count; ++i) s.mirror[i] = share[i] > 0 ? 1.0f : 0.0f;
  RaySet hits, misses;
  internal::PaneTint tint{tables};
  internal::TraceReflections(*tracer, rays, s, &tint, hits, misses);
  // What one ray meets is blurred as far as that can be without more of them: textures, small things, and things far away.
  const auto lobe = [&](int i) { return kLobeWidth * s.roughness[hits.slot[i]] * s.roughness[hits.slot[i]] * hits.distance[i]; };
  // Lamps of the grid shine highlights as wide as the lobe.
  LeaveOut(hits, [&](int i) {
    const uint32_t lamp = lights.LampOf(hits.instance[i], hits.triangle[i]);
    return lamp != internal::LightTable::kNoLamp && (lamps->Holds(lamp) || lights.lamps()[lamp].radius < lobe(i));
  });
  for (int i = 0; i < hits.count; ++i) {
    const float width = lobe(i), relative = width / kMirroredThing;
    hits.width[i] += width;
    share[hits.slot[i]] /= 1 + relative * relative;
  }
  const auto put = [&](const RaySet& set, const LightSet& light) {
    for (int i = 0; i < set.count; ++i) {
      const uint32_t k = set.slot[i];
      const Vec3f all = Vec3f{room.r[k], room.g[k], room.b[k]} * (1 / kPiF);
      const Vec3f seen = all + (Vec3f{light.r[i], light.g[i], light.b[i]} * tint.of[k] - all) * share[k];
      s.reflected_r[k] = seen.x, s.reflected_g[k] = seen.y, s.reflected_b[k] = seen.z;
      s.traced[k] = 1;
    }
  };
  LightSet light;
  if (hits.count > 0) ShadeSurfaces(hits, 1, light), put(hits, light);
  Pad(misses);
  if (misses.count > 0) kernels.sky(view, misses, false, light), put(misses, light);
}

void Shader::Impl::LightByLamps(const RaySet& rays, int count, const float* in_room, SurfaceSet& s) const {
  if (view.lamps.lamps == nullptr) return;
  internal::LampRays wanted;
  kernels.lamps(view, rays, count, in_room, s, wanted);
  internal::TraceLamps(*tracer, tables, rays, wanted, count, s);
}

void Shader::Impl::LightByMovingLamps(const RaySet& rays, int count, SurfaceSet& s) const {
  if (view.moving_lamps.lamps == nullptr) return;
  if (view.lamps.lamps == nullptr) {
    for (float* sum :
         {s.lamp_r, s.lamp_g, s.lamp_b, s.lamp_back_r, s.lamp_back_g, s.lamp_back_b, s.lamp_shine_r, s.lamp_shine_g, s.lamp_shine_b})
      std::fill_n(sum, kBatch, 0.0f);
  }
  internal::LampRays wanted;
  if (kernels.moving_lamps(view, rays, count, s, wanted)) internal::TraceLamps(*tracer, tables, rays, wanted, count, s);
}

void Shader::Impl::FindSun(const RaySet& rays, SurfaceSet& s, const SunNeighbours* around, SunPixel* sun) const {
  if (around == nullptr && sun == nullptr) {
    internal::TraceSun(*tracer, tables, rays, s);
    return;
  }
  bool asked[kBatch];
  float known[kBatch];
  for (int i = 0; i < rays.count; ++i) {
    asked[i] = s.sunlit[i] != 0;
    known[i] = asked[i] && around != nullptr ? internal::GuessSun(*around, rays, s, i) : -1;
    if (known[i] >= 0) s.sunlit[i] = 0;
  }
  internal::TraceSun(*tracer, tables, rays, s);
  for (int i = 0; i < rays.count; ++i) {
    if (known[i] >= 0) s.sunlit[i] = known[i];
  }
  if (sun != nullptr) internal::KeepSun(rays, s, asked, sun);
}

void Shader::Impl::ShadeSurfaces(RaySet& rays, int bounce, LightSet& light, const SunNeighbours* around, SunPixel* sun) const {
  SurfaceSet surfaces;
  Pad(rays);  // sets that come from tracing are not yet
  kernels.prepare(view, rays, surfaces);
  if (sky) FindSun(rays, surfaces, around, sun);
  // What is seen in a mirror does without rays to lamps.
  internal::IndoorLight room;
  const bool indoors = LookIndoors(rays, surfaces, room);
  const int lamp_rays = bounce == 0 ? internal::kLampRays : 0;
  LightByLamps(rays, lamp_rays, indoors ? room.share : nullptr, surfaces);
  if (indoors && view.lamps.lamps != nullptr) kernels.mix_lamps(room, rays.count, surfaces);
  LightByMovingLamps(rays, lamp_rays, surfaces);
  if (bounce == 0) {
    internal::TraceContact(*tracer, rays, surfaces);
    FollowRays(rays, surfaces, around, sun);
    if (indoors) FollowPolished(rays, room, surfaces);
  }
  if (indoors)
    kernels.light_indoors(view, rays, surfaces, room, light);
  else
    kernels.light(view, rays, surfaces, light);
}

namespace {

// Puts the slots of hits on one material side by side, materials in the order of their first hit, so that
// vectors of lanes do the same work.
void SortByMaterial(const internal::ShadeView& view, const HitBatch& hits, uint32_t* slots, int count) {
  constexpr uint32_t kHash = 512, kFree = ~0u;
  uint32_t material_at[kHash];
  uint16_t group_at[kHash];
  uint16_t group[kBatch], begin[kBatch + 1] = {};
  uint32_t sorted[kBatch];
  std::fill_n(material_at, kHash, kFree);
  int groups = 0;
  for (int i = 0; i < count; ++i) {
    const uint32_t k = slots[i];
    const uint32_t material =
        view.triangles[view.instances[hits.instance[k]].first_triangle + hits.triangle[k]].material & ~internal::kMirroredUv;
    uint32_t at = material * 0x9e3779b1u >> 23;
    while (material_at[at] != material && material_at[at] != kFree) at = (at + 1) % kHash;
    if (material_at[at] == kFree) material_at[at] = material, group_at[at] = static_cast<uint16_t>(groups++);
    group[i] = group_at[at];
    ++begin[group[i] + 1];
  }
  if (groups <= 1) return;
  for (int g = 0; g < groups; ++g) begin[g + 1] = static_cast<uint16_t>(begin[g + 1] + begin[g]);
  for (int i = 0; i < count; ++i) sorted[begin[group[i]]++] = slots[i];
  std::copy_n(sorted, count, slots);
}

}  // namespace

void internal::SplitHits(const HitBatch& hits, RaySet& surfaces, RaySet& sky, const ShadeView* sort) {
  int found = 0, missed = 0;
  for (int k = 0; k < hits.count; ++k) missed += hits.instance[k] == kMiss ? 1 : 0;
  if (missed == 0 || missed == hits.count) {
    uint32_t* slot = missed == 0 ? surfaces.slot : sky.slot;
    for (int k = 0; k < hits.count; ++k) slot[k] = static_cast<uint32_t>(k);
    found = hits.count - missed;
  } else {
    missed = 0;
    for (int k = 0; k < hits.count; ++k) {
      const bool miss = hits.instance[k] == kMiss;
      surfaces.slot[found] = sky.slot[missed] = static_cast<uint32_t>(k);
      found += miss ? 0 : 1, missed += miss ? 1 : 0;
    }
  }
  surfaces.count = found, sky.count = missed;
  if (sort != nullptr) SortByMaterial(*sort, hits, surfaces.slot, found);
  // Array by array, which compilers make vectors of; the sky needs directions alone.
  for (RaySet* set : {&surfaces, &sky}) {
    const int count = set->count;
    const uint32_t* slot = set->slot;
    if (count == 0) continue;
    const bool all = count == hits.count && sort == nullptr;
    const auto take = [&](const auto* from, auto* to) {
      if (all) {
        std::copy_n(from, count, to);
      } else {
        for (int i = 0; i < count; ++i) to[i] = from[slot[i]];
      }
    };
    take(hits.direction_x, set->dx), take(hits.direction_y, set->dy), take(hits.direction_z, set->dz);
    std::fill_n(set->ox, count, hits.origin.x), std::fill_n(set->oy, count, hits.origin.y);
    std::fill_n(set->oz, count, hits.origin.z);
    take(hits.sample_key, set->key);
    if (set == &sky) {
      std::fill_n(set->distance, count, 0.0f);
      std::fill_n(set->width, count, 0.0f);
      std::fill_n(set->u, count, 0.0f), std::fill_n(set->v, count, 0.0f);
      std::fill_n(set->instance, count, kMiss), std::fill_n(set->triangle, count, 0u);
    } else {
      take(hits.distance, set->distance);
      for (int i = 0; i < count; ++i) set->width[i] = set->distance[i] * hits.cone_angle;
      take(hits.u, set->u), take(hits.v, set->v);
      take(hits.instance, set->instance), take(hits.triangle, set->triangle);
    }
    Pad(*set);
  }
}

void Shader::Shade(const HitBatch& hits, RadianceBatch& radiance, const SunNeighbours* around, SunPixel* sun) const {
  RaySet surfaces, sky;
  const bool sort = around != nullptr;  // edge samples: neighbours lie on many materials
  internal::SplitHits(hits, surfaces, sky, sort ? &impl_->view : nullptr);
  const auto put = [&](const RaySet& set, const LightSet& light) {
    if (set.count == hits.count && !sort) {  // none was left out, so the order is the same
      std::copy_n(light.r, set.count, radiance.r);
      std::copy_n(light.g, set.count, radiance.g);
      std::copy_n(light.b, set.count, radiance.b);
      return;
    }
    for (int i = 0; i < set.count; ++i) {
      const uint32_t slot = set.slot[i];
      radiance.r[slot] = light.r[i], radiance.g[slot] = light.g[i], radiance.b[slot] = light.b[i];
    }
  };
  LightSet light;
  const internal::ShadeView& view = impl_->view;
  const bool falling = view.air.rain + view.air.snow > 0;
  if (surfaces.count > 0) {
    impl_->ShadeSurfaces(surfaces, 0, light, around, sun);
    if (falling) impl_->kernels.precipitation(view, surfaces, false, hits.cone_angle, light);
    put(surfaces, light);
  }
  for (int i = 0; sun != nullptr && i < sky.count; ++i) sun[sky.slot[i]] = {};
  if (sky.count > 0) {
    impl_->kernels.sky(view, sky, true, light);
    if (falling) impl_->kernels.precipitation(view, sky, true, hits.cone_angle, light);
    put(sky, light);
  }
}

void Shader::ToneMap(const float* r, const float* g, const float* b, int count, double exposure_ev, Rgb8* out, ToneCurve tone) const {
  impl_->kernels.tone(r, g, b, count, Exposure() * static_cast<float>(std::exp2(exposure_ev)), static_cast<int>(tone), out);
}

}  // namespace airsim360
