#include "airsim360/render/shading/town_light.h"

#include <algorithm>

#include "airsim360/render/shading/probe_rays.h"
#include "airsim360/render/sky/atmosphere.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {

float LampsPerArea(const Scene& scene, const LightTable& lights) {
  double lumens = 0;
  for (const Lamp& lamp : lights.lamps()) lumens += Luminance(lamp.power) * kLuxPerUnit;
  const Box3f box = DetailBounds(scene);
  if (box.empty()) return 0;
  const Vec3f size = box.size();
  return static_cast<float>(lumens / std::max(size.x * size.y, 1.0f));
}

float TownLight(const Scene& scene, const LightTable& lights) { return std::min(LampsPerArea(scene, lights) / kTownLamps, 1.0f); }

}  // namespace airsim360::internal
