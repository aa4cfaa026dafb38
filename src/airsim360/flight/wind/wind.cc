#include "airsim360/flight/wind/wind.h"

#include <cmath>
#include <numbers>

namespace airsim360 {

WindState StartWind(uint64_t seed, uint64_t id) { return {RngStream(seed, "wind", id), {}}; }

Vec3d GustVelocity(const WindGust& gust, double t) {
  const auto swell = [&](double s) { return 0.5 * (1 - std::cos(std::numbers::pi * s / gust.rise)); };
  const double into = t - gust.start, left = 2 * gust.rise + gust.hold - into;
  if (into <= 0 || left <= 0) return {};
  if (into < gust.rise) return gust.velocity_W * swell(into);
  return left < gust.rise ? gust.velocity_W * swell(left) : gust.velocity_W;
}

WindSample StepWind(const WindSettings& settings, double t, double dt, double height, Vec3d v_WB, double span, WindState& state) {
  WindSample out{settings.mean_W, {}};
  for (const WindGust& gust : settings.gusts) out.velocity_W += GustVelocity(gust, t);
  if (settings.wind_6m <= 0) return out;

  const DrydenScales scales = LowAltitudeDryden(height, settings.wind_6m);
  const DrydenSample air = StepDryden(scales, Norm(v_WB - settings.mean_W), span, dt, state.random, state.turbulence);
  const double level = std::hypot(settings.mean_W.x, settings.mean_W.y);
  const double c = level > 0 ? settings.mean_W.x / level : 1, s = level > 0 ? settings.mean_W.y / level : 0;
  const auto to_world = [&](Vec3d a) { return Vec3d{c * a.x - s * a.y, s * a.x + c * a.y, a.z}; };
  out.velocity_W += to_world(air.velocity);
  out.rate_W = to_world(air.rate);
  return out;
}

}  // namespace airsim360
