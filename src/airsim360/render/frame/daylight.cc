#include "airsim360/render/frame/daylight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/render/frame/packet_tracer.h"
#include "airsim360/render/shading/shader_impl.h"

namespace airsim360::internal {
namespace {

constexpr int kSunRays = 64;

// Mean of the radiance of rays spread evenly over the sun's disc (Vogel's spiral).
Rgb32f SeenSun(const RayTracer& tracer, const Shader& shader, const LabelView& labels, Vec3f origin, const SunLight& sun) {
  const TileKernels kernels;
  HitBatch hits;
  hits.origin = origin;
  hits.cone_angle = sun.angular_radius / 4;
  hits.count = kSunRays;
  std::fill_n(hits.sample_key, kSunRays, 0u);
  const Vec3f side = Normalized(Cross(sun.direction, std::fabs(sun.direction.z) < 0.9f ? Vec3f{0, 0, 1} : Vec3f{1, 0, 0}));
  const Vec3f up = Cross(side, sun.direction);
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  RayHit16 packet;
  alignas(64) int valid[16];
  kernels.init(origin.x, origin.y, origin.z, packet);
  for (int i = 0; i < kSunRays; ++i) {
    const double radius = sun.angular_radius * std::sqrt((i + 0.5) / kSunRays), angle = golden * i;
    const Vec3f d =
        Normalized(sun.direction + side * static_cast<float>(radius * std::cos(angle)) + up * static_cast<float>(radius * std::sin(angle)));
    packet.direction_x[i % 16] = d.x, packet.direction_y[i % 16] = d.y, packet.direction_z[i % 16] = d.z;
    if (i % 16 < 15) continue;
    TraceLanes(tracer, labels.sky_entity != kNoEntity, 16, valid, packet);
    kernels.append_hits(labels, packet, valid, i / 16, hits);
  }
  RadianceBatch light;
  shader.Shade(hits, light);
  Rgb32f sum;
  for (int i = 0; i < kSunRays; ++i) sum.r += light.r[i], sum.g += light.g[i], sum.b += light.b[i];
  return {sum.r / kSunRays, sum.g / kSunRays, sum.b / kSunRays};
}

}  // namespace

Daylight DaylightAt(const RayTracer& tracer, const Shader& shader, const LabelView& labels, Vec3f origin) {
  Daylight day;
  const std::shared_ptr<const Sky>& sky = shader.impl().sky;
  if (!sky) return day;
  const Vec3f by_sky = sky->Irradiance({0, 0, 1});
  day.sky = {by_sky.x, by_sky.y, by_sky.z};
  const SunLight sun = sky->sun();
  const float whole = sun.radiance.x + sun.radiance.y + sun.radiance.z;
  if (!(whole > 0)) return day;
  day.to_sun = sun.direction;
  day.sun = {sun.irradiance.x, sun.irradiance.y, sun.irradiance.z};
  const Rgb32f seen = SeenSun(tracer, shader, labels, origin, sun);
  day.sun_seen = std::clamp((seen.r + seen.g + seen.b) / whole, 0.0f, 1.0f);
  return day;
}

}  // namespace airsim360::internal
