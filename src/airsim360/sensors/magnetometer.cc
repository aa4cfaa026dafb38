#include "airsim360/sensors/magnetometer.h"

#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/sensors/sample_clock.h"

namespace airsim360 {

Vec3d MagneticField::InWorld() const {
  const double down = inclination_deg * kDegree, east = declination_deg * kDegree;
  return Vec3d{std::cos(down) * std::sin(east), std::cos(down) * std::cos(east), -std::sin(down)} * strength;
}

void MagneticField::Visit(ConfigVisitor& v) {
  v.Field("strength", "T", strength, 0, 1e-3);
  v.Field("declination_deg", "from north to the east", declination_deg, -180, 180);
  v.Field("inclination_deg", "down from the horizon", inclination_deg, -90, 90);
}

void MagnetometerSpec::Visit(ConfigVisitor& v) {
  v.Group("mount", "place on the body", [&](ConfigVisitor& g) { mount.Visit(g); });
  v.Field("rate_hz", "samples a second", rate_hz, 0.01, 1e4);
  v.Group("field", "noise, T", [&](ConfigVisitor& g) { field.Visit(g); });
}

MagnetometerState StartMagnetometer(const MagnetometerSpec& spec, const SensorKey& key) {
  return {StartNoise(spec.field, SampleStream(key, "magnetometer start", 0)), {}};
}

void SampleMagnetometer(const MagnetometerSpec& spec, const SensorKey& key, Vec3d field_W, const BodyMotion& motion, int64_t t_ns,
                        MagnetometerState& state) {
  const double dt = SampleLength(spec.rate_hz, t_ns, state.last.t_ns);
  const Mat3d R_WS = motion.body.X_WB.R * spec.mount.pose().R;
  RngStream random = SampleStream(key, "magnetometer", static_cast<uint64_t>(t_ns));
  const Vec3d noise = NextNoise(spec.field, dt, random, state.noise);
  state.last = {t_ns, R_WS.transpose() * field_W + noise};
}

}  // namespace airsim360
