#include "airsim360/sensors/gnss.h"

#include <cmath>

#include "airsim360/sensors/sample_clock.h"

namespace airsim360 {
namespace {

// Normal numbers with the sigmas of east, north and up.
Vec3d PositionNoise(const GnssSpec& spec, RngStream& random) {
  const double x = random.Normal(), y = random.Normal(), z = random.Normal();
  return {x * spec.horizontal_sigma, y * spec.horizontal_sigma, z * spec.vertical_sigma};
}

}  // namespace

void GnssSpec::Visit(ConfigVisitor& v) {
  v.Group("mount", "place of the antenna", [&](ConfigVisitor& g) { mount.Visit(g); });
  v.Field("rate_hz", "samples a second", rate_hz, 0.01, 1000);
  v.Field("horizontal_sigma", "metres, of east and of north", horizontal_sigma, 0, 1e4);
  v.Field("vertical_sigma", "metres", vertical_sigma, 0, 1e4);
  v.Field("velocity_sigma", "m/s, each axis", velocity_sigma, 0, 1e3);
  v.Field("correlation_time", "seconds over which the error drifts, 0 = white", correlation_time, 0, 1e6);
  v.Field("latency", "seconds from measurement to reading", latency, 0, 10);
  v.Field("start_up", "seconds without a fix after the start", start_up, 0, 1e4);
}

Vec3d PointVelocity(const Kinematics& body, Vec3d r_B) { return body.v_WB + body.X_WB.R * Cross(body.w_WB_B, r_B); }

GnssState StartGnss(const GnssSpec& spec, const SensorKey& key) {
  GnssState state;
  RngStream random = SampleStream(key, "gnss start", 0);
  state.error = PositionNoise(spec, random);
  return state;
}

void SampleGnss(const GnssSpec& spec, const SensorKey& key, const GeoFrame& frame, const BodyMotion& motion, int64_t t_ns,
                GnssState& state) {
  // The error of the position drifts as a Gauss-Markov process, whatever the rate.
  const double dt = SampleLength(spec.rate_hz, t_ns, state.measured_ns);
  const double keep = spec.correlation_time > 0 ? std::exp(-dt / spec.correlation_time) : 0;
  RngStream random = SampleStream(key, "gnss", static_cast<uint64_t>(t_ns));
  state.error = state.error * keep + PositionNoise(spec, random) * std::sqrt(1 - keep * keep);
  state.measured_ns = t_ns;

  GnssReading reading;
  reading.measured_ns = t_ns;
  const Vec3d r_B = spec.mount.p_BS;
  reading.p_WS = motion.body.X_WB * r_B + state.error;
  const double vx = random.Normal(), vy = random.Normal(), vz = random.Normal();
  reading.v_WS = PointVelocity(motion.body, r_B) + Vec3d{vx, vy, vz} * spec.velocity_sigma;
  reading.eph = spec.horizontal_sigma;
  reading.epv = spec.vertical_sigma;
  reading.has_fix = static_cast<double>(t_ns) * 1e-9 >= spec.start_up;
  state.pending.push_back(reading);

  // Readings come out in the order of their measurement.
  const int64_t latency_ns = std::llround(spec.latency * 1e9);
  while (!state.pending.empty() && state.pending.front().measured_ns + latency_ns <= t_ns) {
    state.last = state.pending.front();
    state.last.t_ns = t_ns;
    state.last.place = frame.ToGeodetic(state.last.p_WS);
    state.pending.erase(state.pending.begin());
  }
}

}  // namespace airsim360
