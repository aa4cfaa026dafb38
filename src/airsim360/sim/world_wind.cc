#include "airsim360/sim/world_wind.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

constexpr double kDeficit = 0.8, kRecovery = 25;  // share of the wind lost close behind a wall; metres
constexpr double kFarthest = 4 * kRecovery;       // what is left of the deficit there is 1.5 %
constexpr double kElevationsDeg[] = {2, 12, 25}, kTurnsDeg[] = {-12, 0, 12};
constexpr double kReferenceHeight = 10, kLowest = 0.5;  // metres

}  // namespace

void WorldWind::Visit(ConfigVisitor& v) {
  v.Field("east", "m/s, towards the east, 10 m above the ground", mean_W.x, -60, 60);
  v.Field("north", "m/s, towards the north", mean_W.y, -60, 60);
  v.Field("up", "m/s", mean_W.z, -60, 60);
  v.Field("profile_exponent", "power law over height: 0 none, 0.14 open land, 0.3 town", profile_exponent, 0, 1);
  v.Field("shelter", "buildings upwind slow the air", shelter);
  v.Field("turbulence_6m", "m/s at 6 m: 7.7 light, 15 moderate, 23 severe turbulence", turbulence_6m, 0, 60);
  v.List("gusts", "gusts that swell and die away", gusts, [](ConfigVisitor& e, WindGust& gust) {
    e.Field("start", "seconds", gust.start, 0, 1e9);
    e.Field("rise", "seconds", gust.rise, 1e-3, 1e6);
    e.Field("hold", "seconds", gust.hold, 0, 1e6);
    e.Field("east", "m/s", gust.velocity_W.x, -60, 60);
    e.Field("north", "m/s", gust.velocity_W.y, -60, 60);
    e.Field("up", "m/s", gust.velocity_W.z, -60, 60);
  });
}

WorldWind ReadWindFile(const std::string& file) {
  WorldWind wind;
  if (!file.empty()) ReadYamlFile(file, [&](ConfigVisitor& v) { wind.Visit(v); });
  return wind;
}

double ShelterFactor(const RayTracer& tracer, Vec3d p_W, Vec3d wind_W) {
  const double speed = std::hypot(wind_W.x, wind_W.y);
  if (!(speed > 0)) return 1;
  const double into = std::atan2(-wind_W.y, -wind_W.x);
  double deficit = 0;
  for (const double elevation : kElevationsDeg) {
    for (const double turn : kTurnsDeg) {
      const double e = elevation * kDegree, a = into + turn * kDegree;
      const Vec3d d{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
      const auto hit = tracer.Intersect(VecCast<float>(p_W), VecCast<float>(d), static_cast<float>(kFarthest));
      if (hit) deficit += std::exp(-static_cast<double>(hit->distance) / kRecovery);
    }
  }
  return 1 - kDeficit * deficit / 9;
}

Vec3d WindAtHeight(const WorldWind& wind, Vec3d wind_10m_W, double height) {
  if (wind.profile_exponent == 0) return wind_10m_W;
  return wind_10m_W * std::pow(std::max(height, kLowest) / kReferenceHeight, wind.profile_exponent);
}

}  // namespace airsim360
