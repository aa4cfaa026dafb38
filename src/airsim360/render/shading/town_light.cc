#include "airsim360/render/shading/town_light.h"

#include <algorithm>

#include "airsim360/render/shading/probe_rays.h"
#include "airsim360/render/sky/atmosphere.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {

float LampsPerArea(const Scene& scene, const LightTable& lights) {
  constexpr float kReach = 500;
  const Box3f box = DetailAround(scene, kReach);
  if (box.empty()) return 0;
  double lumens = 0;
  for (const Lamp& lamp : lights.lamps()) {
    const Vec3f p = lamp.center;
    const bool around = p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y;
    if (around) lumens += Luminance(lamp.power) * kLuxPerUnit;
  }
  const Vec3f size = box.size();
  return static_cast<float>(lumens / std::max(size.x * size.y, 1.0f));
}

float TownLight(const Scene& scene, const LightTable& lights) { return std::min(LampsPerArea(scene, lights) / kTownLamps, 1.0f); }

}  // namespace airsim360::internal
