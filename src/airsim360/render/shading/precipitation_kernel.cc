// Kernel: rain and snow in the air before the picture.
#include "airsim360/render/shared/roofs_simd.h"
#include "airsim360/render/shared/shading_kernels.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

// A flake is opaque. A drop is before a point of its streak for a part of the exposure alone (Garg & Nayar, "Vision and Rain", 2007),
// a fiftieth for these lengths; six times as much, so that a light rain shows.
constexpr float kDropOpacity = 0.12f;

/// Share of places that hold a drop, for a rate in mm/h: the number of drops grows with a power of the rate
/// (Marshall & Palmer 1948: N ~ R^0.21 times their size; drawn are those large enough to see).
KERNEL float Keep(float rate, float per_place, float most) { return rate * per_place < most ? rate * per_place : most; }

KERNEL real Rain(const RoofView& roofs, float rate, real3 o, real3 d, real reach, float spread) {
  // In the leaning frame drops fall straight down.
  const real x = o.x - o.z * kRainLean;
  const real3 s = make3(d.x - d.z * kRainLean, d.y, d.z);
  const float keep = Keep(rate, 0.09f, 0.95f);
  const real near = drops_cover(roofs, kRainLean, x, o.y, o.z, s, reach, spread, 0.40f, 0.48f, 0.30f, 0.0016f, keep, 5.0f, 3.0f);
  const real far = drops_cover(roofs, kRainLean, x, o.y, o.z, s, reach, spread, 1.1f, 0.8f, 0.45f, 0.0045f, keep, 15.0f, 41.0f);
  return (1.0f - (1.0f - near) * (1.0f - far)) * kDropOpacity;
}

KERNEL real Snow(const RoofView& roofs, float rate, real3 o, real3 d, real reach, float spread) {
  const float keep = Keep(rate, 0.28f, 0.95f);
  const real near = drops_cover(roofs, 0.0f, o.x, o.y, o.z, d, reach, spread, 0.30f, 0.13f, 0.0f, 0.0040f, keep, 4.5f, 5.0f);
  const real far = drops_cover(roofs, 0.0f, o.x, o.y, o.z, d, reach, spread, 0.75f, 0.24f, 0.0f, 0.0085f, keep, 11.0f, 53.0f);
  return 1.0f - (1.0f - near) * (1.0f - far);
}

}  // namespace

void AddPrecipitation(const ShadeView& view, const RaySet& rays, bool sky, float cone_angle, LightSet& light) {
  for (int i = 0; i < rays.count; i += kLanes) {
    const real3 o = load3(rays.ox + i, rays.oy + i, rays.oz + i), d = load3(rays.dx + i, rays.dy + i, rays.dz + i);
    const real reach = sky ? real(kFarAir) : load(rays.distance + i);
    real hidden = real(0.0f);
    if (view.air.rain > 0.0f) hidden = Rain(view.roofs, view.air.rain, o, d, reach, cone_angle);
    if (view.air.snow > 0.0f) hidden = hidden + (1.0f - hidden) * Snow(view.roofs, view.air.snow, o, d, reach, cone_angle);
    const real3 before = load3(light.r + i, light.g + i, light.b + i);
    store3(light.r + i, light.g + i, light.b + i, before * (1.0f - hidden) + ufloat3_of(view.air.drop_light) * hidden);
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
