#include "airsim360/rpc/session/start_place.h"

#include <cmath>
#include <numbers>

namespace airsim360 {

std::string StartFault(const RayTracer& tracer, Vec3d p_W, double radius) {
  // The ground that it stands on is near: what is level with its upper side counts.
  const Vec3f above = VecCast<float>(p_W + Vec3d{0, 0, radius});
  if (tracer.Clearance(above, static_cast<float>(radius)) < 0.9f * static_cast<float>(radius)) return "in something or against it";
  return tracer.Intersect(above, {0, 0, -1}) ? "" : "over no ground";
}

std::optional<Vec3d> NearestStart(const RayTracer& tracer, Vec3d p_W, double radius) {
  constexpr double kFarthest = 50, kGrowth = 1.25;
  constexpr int kAround = 32;
  for (double distance = radius; distance < kFarthest; distance *= kGrowth) {
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2 * std::numbers::pi * k / kAround;
      const Vec3d place = p_W + Vec3d{distance * std::cos(angle), distance * std::sin(angle), 0};
      if (StartFault(tracer, place, radius).empty()) return place;
    }
  }
  return std::nullopt;
}

}  // namespace airsim360
