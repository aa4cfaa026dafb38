// What the light of rooms asks of a scene: what a ray of light meets, and the light that gets to a place directly.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "airsim360/render/indoor/ray_packet.h"
#include "airsim360/render/lights/lamp_grid.h"
#include "airsim360/render/lights/light_table.h"
#include "airsim360/render/sky/sky.h"
#include "airsim360/render/surface/surface_tables.h"

namespace airsim360::internal {

/// Scene and lights. `sky`, `lights`, `lamps` and `around` may be nullptr.
struct IndoorWorld {
  const RayTracer& tracer;  ///< StaticTracer
  const SurfaceTables& tables;
  const Sky* sky = nullptr;
  const LightTable* lights = nullptr;
  const LampGrid* lamps = nullptr;  ///< lamps that it holds are shaded by it, others are part of the surfels' light
  /// Irradiance of what is not the sun at places without surfels.
  std::function<Vec3f(Vec3f p, Vec3f normal)> around = nullptr;
};

/// The sky along d, black without one. Not the blurred sky: halls see but the lowest of it, where a blur mixes in what is higher.
inline Vec3f SkyAlong(const IndoorWorld& world, Vec3f d) { return world.sky == nullptr ? Vec3f{} : world.sky->Radiance(d); }

/// `tracer` without what moves on its own (people, drones): it has no part in light that is kept.
std::shared_ptr<const RayTracer> StaticTracer(std::shared_ptr<const RayTracer> tracer);
/// Whether an instance does so.
std::vector<uint8_t> MovingInstances(const Scene& scene);

/// Share of even light that a surface gives back, by material: base colour times `slope` plus `rest`.
struct Reflectance {
  explicit Reflectance(const SurfaceTables& tables);
  /// Below kWhitest, so that light between white walls comes to an end.
  Vec3f Of(uint32_t material, Vec3f base) const {
    const Vec3f r = slope[material] * base + rest[material];
    return Min(r, Vec3f{kWhitest, kWhitest, kWhitest});
  }
  static constexpr float kWhitest = 0.98f;
  std::vector<Vec3f> slope, rest;
};

/// A surface under a ray.
struct MetSurface {
  Vec3f point, normal;  ///< geometric normal towards the ray's origin
  Vec3f base;           ///< mean colour
  uint32_t material;
  bool behind;  ///< met from the back
  bool mirror;  ///< reflects all it gets in one direction
};
MetSurface SurfaceUnder(const IndoorWorld& world, const RayPacket& packet, int lane);

struct LampMix;  // plain_lamps.h

/// Light that arrives directly at a place that faces `normal`, the mean over `points` on its surface.
struct DirectLight {
  Vec3f sun;                  ///< irradiance
  Vec3f held;                 ///< of lamps that the grid holds
  Vec3f others;               ///< of the others
  float held_difference = 0;  ///< of the luminance of `held`: that of every other ray less that of the rest
};
/// Irradiance of the sun, likewise.
Vec3f SunFromAbove(const IndoorWorld& world, std::span<const Vec3f> points, Vec3f normal, uint32_t seed, int rays);
/// `lamps`: how many rays look for them, and what is left to other rays from the same points.
DirectLight LampsAround(const IndoorWorld& world, std::span<const Vec3f> points, Vec3f normal, const LampMix& lamps, uint32_t seed);
inline constexpr int kSunRays = 16;

/// Points of the unit square that fill it evenly, the i-th of a sequence (Roberts 2018); `shift` turns it.
Vec2f EvenPoint(uint32_t i, Vec2f shift);
/// Two numbers in [0, 1) of a seed.
Vec2f ShiftOf(uint64_t seed);
/// (tangent, bitangent) of a unit normal.
void TangentFrame(Vec3f n, Vec3f& t, Vec3f& b);

}  // namespace airsim360::internal
