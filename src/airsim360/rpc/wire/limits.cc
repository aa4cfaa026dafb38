#include "airsim360/rpc/wire/limits.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace airsim360 {

void CheckReplyBytes(uint64_t bytes, std::string_view help) {
  if (bytes <= kMostReplyBytes) return;
  constexpr double kMib = 1 << 20;
  char text[160];
  std::snprintf(text, sizeof text, "the answer would take %.1f MiB (%llu bytes) of at most %.0f MiB; ", static_cast<double>(bytes) / kMib,
                static_cast<unsigned long long>(bytes), static_cast<double>(kMostReplyBytes) / kMib);
  throw std::invalid_argument(text + std::string(help));
}

namespace {

void CheckDegrees(const char* name, double value, double most) {
  if (std::abs(value) <= most) return;
  char text[160];
  std::snprintf(text, sizeof text, "%s: %.10g is not in %.0f … %.0f degrees", name, value, -most, most);
  if (std::isnan(value)) throw std::invalid_argument(text);  // nothing is near to what is no number
  const std::string nearest = std::to_string(std::lround(std::copysign(most, value)));
  throw std::invalid_argument(text + ("; the nearest is " + nearest));
}

}  // namespace

void CheckPlaceOnEarth(double latitude, double longitude) {
  CheckDegrees("latitude", latitude, 90);
  CheckDegrees("longitude", longitude, 360);
}

void CheckVelocity(std::string_view name, Vec3d velocity, std::string_view unit) {
  const double size = Norm(velocity);
  if (size <= kFastestState) return;
  const Vec3d nearest = velocity * (kFastestState / size);
  char text[320];
  std::snprintf(text, sizeof text, "%.40s: (%g, %g, %g) is %g %.10s, more than %g; the nearest is (%g, %g, %g)", std::string(name).c_str(),
                velocity.x, velocity.y, velocity.z, size, std::string(unit).c_str(), kFastestState, nearest.x, nearest.y, nearest.z);
  throw std::invalid_argument(text);
}

}  // namespace airsim360
