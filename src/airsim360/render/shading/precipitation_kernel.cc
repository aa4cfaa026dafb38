// Kernel: rain and snow in the air before the picture.
#include "airsim360/render/shared/precipitation_simd.h"
#include "airsim360/render/shared/shading_kernels.h"

namespace airsim360::internal::AIRSIM360_ISA {
void AddPrecipitation(const ShadeView& view, const RaySet& rays, bool sky, float cone_angle, LightSet& light) {
  for (int i = 0; i < rays.count; i += kLanes) {
    const real3 o = load3(rays.ox + i, rays.oy + i, rays.oz + i), d = load3(rays.dx + i, rays.dy + i, rays.dz + i);
    const real reach = sky ? real(kFarAir) : load(rays.distance + i);
    const real hidden = precipitation_hides(view.roofs, view.air.rain, view.air.snow, o, d, reach, cone_angle);
    const real3 before = load3(light.r + i, light.g + i, light.b + i);
    store3(light.r + i, light.g + i, light.b + i, before * (1.0f - hidden) + ufloat3_of(view.air.drop_light) * hidden);
  }
}

}  // namespace airsim360::internal::AIRSIM360_ISA
