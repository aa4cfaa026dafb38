#include "airsim360/sensors/range_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace airsim360 {
namespace {

constexpr size_t kConeRays = 16;

// Directions in S that fill a cone evenly.
std::array<Vec3d, kConeRays> ConeDirections(double half_angle) {
  std::array<Vec3d, kConeRays> directions;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (size_t i = 0; i < kConeRays; ++i) {
    const double angle = half_angle * std::sqrt(static_cast<double>(i) / (kConeRays - 1));
    const double around = golden * static_cast<double>(i);
    directions[i] = {std::cos(angle), std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around)};
  }
  return directions;
}

}  // namespace

void RangeFinderSpec::Visit(ConfigVisitor& v) {
  v.Group("mount", "place and beam direction", [&](ConfigVisitor& g) { mount.Visit(g); });
  v.Field("gimbal", "0 = fixed to the body, n = on the n-th gimbal", gimbal);
  v.Field("rate_hz", "samples a second", rate_hz, 0.01, 1e4);
  v.Field("beam_deg", "full opening of the cone, 0 = one ray", beam_deg, 0, 120);
  v.Field("min_range", "metres", min_range, 0, 1e4);
  v.Field("max_range", "metres", max_range, 0, 1e5);
  v.Field("sigma", "metres", sigma, 0, 100);
  v.Field("sigma_per_metre", "metres a metre of range", sigma_per_metre, 0, 1);
  v.Field("through_panes", "clear glass is not seen", through_panes);
}

RangeReading MeasureRange(const RangeFinderSpec& spec, const SensorKey& key, const RayTracer& tracer, const RigidTransform& X_WS,
                          int64_t t_ns) {
  const size_t count = spec.beam_deg > 0 ? kConeRays : 1;
  const auto directions = ConeDirections(spec.beam_deg / 2 * std::numbers::pi / 180);
  std::array<SensorRay, kConeRays> rays;
  std::array<SensorHit, kConeRays> hits;
  for (size_t i = 0; i < count; ++i) rays[i] = {VecCast<float>(X_WS.p), VecCast<float>(X_WS.R * directions[i])};
  // Noise may bring a hit beyond the reach back into it, so that rays go a little farther.
  const double reach = spec.max_range + 5 * (spec.sigma + spec.sigma_per_metre * spec.max_range);
  TraceRays(tracer, std::span(rays).first(count), 0, static_cast<float>(reach), spec.through_panes, hits);

  const SensorHit* nearest = nullptr;
  for (size_t i = 0; i < count; ++i) {
    if (hits[i].range > 0 && (nearest == nullptr || hits[i].range < nearest->range)) nearest = &hits[i];
  }
  RangeReading reading{.t_ns = t_ns, .range = spec.max_range};
  if (nearest == nullptr) return reading;
  RngStream random = SampleStream(key, "range", static_cast<uint64_t>(t_ns));
  const double range = nearest->range;
  const double noisy = range + random.Normal() * std::hypot(spec.sigma, spec.sigma_per_metre * range);
  if (noisy > spec.max_range) return reading;
  return {t_ns, std::max(noisy, spec.min_range), true, nearest->label.entity, nearest->label.category};
}

}  // namespace airsim360
