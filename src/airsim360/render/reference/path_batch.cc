#include "airsim360/render/reference/path_batch.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/render/reference/path_rays.h"
#include "airsim360/render/shading/secondary_rays.h"
#include "airsim360/render/shared/precipitation_scalar.h"
#include "airsim360/render/shared/shading_constants.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

// Pairs of numbers of one step: where on the sun, where in the sky, where next (two pairs), where on which
// lamp (two pairs).
constexpr uint32_t kPairsPerStep = 6, kFirstPair = 1;

// The normal that lamps are chosen for: leaves take light from both sides.
Vec3f LampNormal(const SurfaceSet& s, int i) { return s.kind[i] == kFoliage ? Vec3f{} : Vec3f{s.gx[i], s.gy[i], s.gz[i]}; }

Vec3f DirectionAt(const RaySet& r, int i) { return {r.dx[i], r.dy[i], r.dz[i]}; }

}  // namespace

void PathBatch::Run() {
  active_.resize(paths_.size());
  for (size_t i = 0; i < paths_.size(); ++i) active_[i] = static_cast<int>(i);
  RaySet rays, misses;
  for (int step = 0; !active_.empty() && step < max_bounces_ + kMostPanes; ++step) {
    FillRays(rays);
    TraceNearest(scene_.tracer, rays, step == 0, at_, misses);
    for (int i = 0; i < at_.count; ++i) at_.width[i] += at_.distance[i] * paths_[at_.slot[i]].spread;
    Pad(at_);
    Pad(misses);
    if (step == 0 && scene_.view.air.rain + scene_.view.air.snow > 0) {
      camera_hits_ = at_;
      camera_misses_ = misses;
    }
    active_.clear();
    if (misses.count > 0) Escape(misses);
    if (at_.count > 0) Arrive(at_, static_cast<uint32_t>(step));
  }
  if (scene_.view.air.rain + scene_.view.air.snow > 0) {
    AddPrecipitation(camera_hits_, false);
    AddPrecipitation(camera_misses_, true);
  }
}

// Rain and snow before what the camera sees, as in the other tiers.
void PathBatch::AddPrecipitation(const RaySet& rays, bool sky) {
  if (rays.count == 0) return;
  LightSet light;
  for (int i = 0; i < rays.count; ++i) {
    const Vec3f c = paths_[rays.slot[i]].radiance;
    light.r[i] = c.x, light.g[i] = c.y, light.b[i] = c.z;
  }
  scene_.kernels.precipitation(scene_.view, rays, sky, cone_angle_, light);
  for (int i = 0; i < rays.count; ++i) paths_[rays.slot[i]].radiance = {light.r[i], light.g[i], light.b[i]};
}

void PathBatch::FillRays(RaySet& rays) const {
  rays.count = static_cast<int>(active_.size());
  for (int i = 0; i < rays.count; ++i) {
    const Path& path = paths_[active_[i]];
    rays.ox[i] = path.origin.x, rays.oy[i] = path.origin.y, rays.oz[i] = path.origin.z;
    rays.dx[i] = path.direction.x, rays.dy[i] = path.direction.y, rays.dz[i] = path.direction.z;
    rays.width[i] = path.width;
    rays.slot[i] = static_cast<uint32_t>(active_[i]);
  }
}

// The sky and the sun's disc, which a scattered path shares with the rays that were sent there (balance
// heuristic: Veach 1997).
void PathBatch::Escape(RaySet& misses) {
  LightSet sky;
  scene_.kernels.sky(scene_.view, misses, false, sky);
  for (int i = 0; i < misses.count; ++i) {
    Path& path = paths_[misses.slot[i]];
    const Vec3f d = DirectionAt(misses, i);
    float of_sky = 1, of_sun = 1;
    if (path.pdf > 0 && next_event_) {
      of_sky = path.pdf / (path.pdf + scene_.lights.SkyPdf(path.from, d));
      of_sun = path.pdf / (path.pdf + scene_.lights.SunPdf(d));
    }
    path.radiance += path.throughput * (Vec3f{sky.r[i], sky.g[i], sky.b[i]} * of_sky + scene_.lights.SunRadiance(path.origin, d) * of_sun);
  }
}

void PathBatch::Arrive(RaySet& hits, uint32_t step) {
  scene_.kernels.prepare(scene_.view, hits, surfaces_);
  const SurfaceSet& s = surfaces_;
  const ShadeView& view = scene_.view;
  bool any = false;
  for (int i = 0; i < hits.count; ++i) {
    Path& path = paths_[hits.slot[i]];
    const float t = hits.distance[i];
    // The air on the way here.
    if (view.has_sky > 0.5f) {
      const Vec3f d = DirectionAt(hits, i);
      const float free = view.air.weather > 0 ? scalar::roofed_way(view.roofs, {hits.ox[i], hits.oy[i], hits.oz[i]}, d, t) : 0.0f;
      const scalar::AirEffect air = scalar::air_to_surface(view.air, hits.oz[i], d, t, free);
      path.radiance += path.throughput * air.added;
      path.throughput = path.throughput * air.kept;
    }
    path.radiance += path.throughput * Vec3f{s.er[i], s.eg[i], s.eb[i]} * EmissionWeight(path, i);
    const bool lit_by_room = path.bounces > 0 && path.pdf < kMirrorPdf && Luminance(scene_.room_light) > 0;
    if (lit_by_room) path.radiance += path.throughput * scene_.room_light * (kRoomNear + kRoomFar * t * t / (t * t + 0.5f));
    if (lit_by_room) path.throughput = {};
    // After its last bounce a path may still pass clear panes.
    any |= Luminance(path.throughput) > 0 && (path.bounces < max_bounces_ || scene_.clear_panes);
  }
  if (!any) return;
  if (next_event_ && scene_.lights.has_sun()) JoinSun(step);
  if (next_event_ && scene_.lights.has_sky()) JoinSky(step);
  if (next_event_ && scene_.lights.has_lamps()) JoinLamps(step);
  Scatter(step);
}

// Share of a lamp's light that a path brings which might have been joined to it.
float PathBatch::EmissionWeight(const Path& path, int i) const {
  if (!next_event_ || path.pdf == 0 || surfaces_.er[i] + surfaces_.eg[i] + surfaces_.eb[i] == 0) return 1;
  const Vec3f p{surfaces_.px[i], surfaces_.py[i], surfaces_.pz[i]}, g{surfaces_.gx[i], surfaces_.gy[i], surfaces_.gz[i]};
  const float lamp =
      scene_.lights.LampPdf(path.from, path.from_normal, at_.instance[i], at_.triangle[i], Norm(p - path.from), -Dot(g, path.direction));
  return path.pdf / (path.pdf + lamp);
}

void PathBatch::SetLight(int i, const LightRay& ray) {
  scatter_.x[i] = ray.direction.x, scatter_.y[i] = ray.direction.y, scatter_.z[i] = ray.direction.z;
  lights_[i] = ray;
}

void PathBatch::JoinSun(uint32_t step) {
  for (int i = 0; i < at_.count; ++i) {
    const Path& path = paths_[at_.slot[i]];
    const Vec3f p{surfaces_.px[i], surfaces_.py[i], surfaces_.pz[i]};
    SetLight(i, scene_.lights.SampleSun(p, path.sampler.Pair(path.sample, kFirstPair + step * kPairsPerStep)));
  }
  JoinLights(false);
}

void PathBatch::JoinSky(uint32_t step) {
  for (int i = 0; i < at_.count; ++i) {
    const Path& path = paths_[at_.slot[i]];
    const Vec3f p{surfaces_.px[i], surfaces_.py[i], surfaces_.pz[i]};
    SetLight(i, scene_.lights.SampleSky(p, path.sampler.Pair(path.sample, kFirstPair + 1 + step * kPairsPerStep)));
  }
  JoinLights(true);
}

void PathBatch::JoinLamps(uint32_t step) {
  for (int i = 0; i < at_.count; ++i) {
    const Path& path = paths_[at_.slot[i]];
    const uint32_t pair = kFirstPair + 4 + step * kPairsPerStep;
    const Vec2f where = path.sampler.Pair(path.sample, pair), which = path.sampler.Pair(path.sample, pair + 1);
    const Vec3f p{surfaces_.px[i], surfaces_.py[i], surfaces_.pz[i]};
    SetLight(i, scene_.lights.SampleLamp(p, LampNormal(surfaces_, i), {which.x, where.x, where.y}));
  }
  JoinLights(false);
}

// Adds the light from the directions in scatter_ where nothing hides it; the sky's radiance is looked up for
// what is seen, the sun's is in light_ already.
void PathBatch::JoinLights(bool of_sky) {
  // Lanes beyond the last surface need sane numbers.
  for (int i = at_.count; i % 16 != 0 && i < kBatch; ++i)
    scatter_.x[i] = scatter_.x[0], scatter_.y[i] = scatter_.y[0], scatter_.z[i] = scatter_.z[0];
  scene_.evaluate(at_, surfaces_, scatter_);

  // Those that would bring something: BSDF times radiance over density, with the weight of the balance
  // heuristic.
  RaySet& shadow = shadow_.rays;
  shadow.count = 0;
  for (int i = 0; i < at_.count; ++i) {
    const Path& path = paths_[at_.slot[i]];
    const Vec3f light = path.throughput * Vec3f{scatter_.r[i], scatter_.g[i], scatter_.b[i]} * lights_[i].radiance *
                        (1 / (lights_[i].pdf + scatter_.pdf[i]));
    if (path.bounces >= max_bounces_ || lights_[i].pdf == 0 || !(Luminance(light) > 0)) continue;
    const int k = shadow.count++;
    const Vec3f d{scatter_.x[i], scatter_.y[i], scatter_.z[i]}, from = LeaveSurface(at_, surfaces_, i, d);
    shadow.ox[k] = from.x, shadow.oy[k] = from.y, shadow.oz[k] = from.z;
    shadow.dx[k] = d.x, shadow.dy[k] = d.y, shadow.dz[k] = d.z;
    shadow.width[k] = 0;
    shadow.slot[k] = at_.slot[i];
    shadow_.light[k] = light;
    // Not to the lamp itself, which rounding may put before the point chosen on it.
    shadow_.reach[k] = lights_[i].reach * kShadowReach - 2 * OffsetOf(at_, surfaces_, i);
  }
  if (shadow.count == 0) return;
  if (scene_.clear_panes) {
    DimByPanes(scene_, shadow_);
  } else {
    DropHidden(scene_.tracer, shadow_);
  }
  LightSet radiance;
  if (of_sky) {
    Pad(shadow);
    scene_.kernels.sky(scene_.view, shadow, false, radiance);
  }
  for (int k = 0; k < shadow.count; ++k) {
    const Vec3f seen = of_sky ? Vec3f{radiance.r[k], radiance.g[k], radiance.b[k]} : Vec3f{1, 1, 1};
    paths_[shadow.slot[k]].radiance += shadow_.light[k] * seen;
  }
}

void PathBatch::Scatter(uint32_t step) {
  ScatterNumbers numbers;
  Vec2f rest[kBatch];
  for (int i = 0; i < at_.count; ++i) {
    const Path& path = paths_[at_.slot[i]];
    const uint32_t pair = kFirstPair + 2 + step * kPairsPerStep;
    const Vec2f where = path.sampler.Pair(path.sample, pair);
    rest[i] = path.sampler.Pair(path.sample, pair + 1);
    numbers.choice[i] = rest[i].x, numbers.u[i] = where.x, numbers.w[i] = where.y;
  }
  for (int i = at_.count; i % 16 != 0 && i < kBatch; ++i) {
    numbers.choice[i] = numbers.choice[0], numbers.u[i] = numbers.u[0], numbers.w[i] = numbers.w[0];
  }
  scene_.sample(at_, surfaces_, numbers, scatter_);

  for (int i = 0; i < at_.count; ++i) {
    Path& path = paths_[at_.slot[i]];
    path.throughput = path.throughput * Vec3f{scatter_.r[i], scatter_.g[i], scatter_.b[i]};
    const bool straight = scatter_.event[i] > kStraightEvent;
    if (scatter_.event[i] == 0 || !(Luminance(path.throughput) > 0)) continue;
    if (path.bounces >= max_bounces_ && !straight) continue;
    const Vec3f d{scatter_.x[i], scatter_.y[i], scatter_.z[i]};
    path.origin = LeaveSurface(at_, surfaces_, i, d);
    path.direction = d;
    path.width = at_.width[i];
    // Through a pane a path goes on as what it was.
    if (!straight) {
      path.pdf = scatter_.pdf[i];
      path.from = {surfaces_.px[i], surfaces_.py[i], surfaces_.pz[i]};
      path.from_normal = LampNormal(surfaces_, i);
      path.spread = std::clamp(kPathLobe / std::sqrt(kPiF * path.pdf), path.spread, kPathWidest);
      ++path.bounces;
    }
    if (path.bounces >= kFirstRoulette) {
      const float survival = std::min(kMostSurvival, std::max({path.throughput.x, path.throughput.y, path.throughput.z}));
      if (rest[i].y >= survival) continue;
      path.throughput = path.throughput * (1 / survival);
    }
    active_.push_back(static_cast<int>(at_.slot[i]));
  }
}

}  // namespace airsim360::internal
