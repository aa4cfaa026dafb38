#include "airsim360/sensors/barometer.h"

#include "airsim360/math/standard_atmosphere.h"
#include "airsim360/sensors/sample_clock.h"

namespace airsim360 {

void BarometerSpec::Visit(ConfigVisitor& v) {
  v.Group("mount", "place on the body", [&](ConfigVisitor& g) { mount.Visit(g); });
  v.Field("rate_hz", "samples a second", rate_hz, 0.01, 1e4);
  v.Group("pressure", "noise, Pa", [&](ConfigVisitor& g) { pressure.Visit(g); });
  v.Field("qnh", "Pa, pressure at sea level that the altitude is worked out with", qnh, 8e4, 1.1e5);
}

BarometerState StartBarometer(const BarometerSpec& spec, const SensorKey& key) {
  return {StartNoise(spec.pressure, SampleStream(key, "barometer start", 0)), {}};
}

void SampleBarometer(const BarometerSpec& spec, const SensorKey& key, const BodyMotion& motion, double height, double sea_level_pressure,
                     int64_t t_ns, BarometerState& state) {
  const double dt = SampleLength(spec.rate_hz, t_ns, state.last.t_ns);
  const double lever = (motion.body.X_WB.R * spec.mount.p_BS).z;
  const Air air = StandardAir(height + lever, sea_level_pressure);
  RngStream random = SampleStream(key, "barometer", static_cast<uint64_t>(t_ns));
  const double pressure = air.pressure + NextNoise(spec.pressure, dt, random, state.noise).x;
  state.last = {t_ns, pressure, PressureAltitude(pressure, spec.qnh), air.temperature};
}

}  // namespace airsim360
