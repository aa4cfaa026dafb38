#include "airsim360/flight/control/flight_check.h"

#include <algorithm>
#include <cmath>

namespace airsim360 {

FlightLoop::FlightLoop(const DroneModel& model, const AutopilotOptions& options, Vec3d p_W, double dynamics_dt)
    : autopilot_(model, options),
      dynamics_(model, dynamics_dt),
      substeps_(static_cast<int>(std::lround(options.control_dt / dynamics_dt))) {
  state.p_WB = p_W;
  const double hover = HoverSpeed(model);
  std::fill_n(state.rotor_speeds.begin(), model.rotors.size(), hover);
  pilot = autopilot_.HoverState(EstimateOf(state, 0));
}

void FlightLoop::Give(const Command& command, int64_t timeout_ns) {
  command_.command = command;
  command_.timeout_ns = timeout_ns;
  ++command_.id;
}

void FlightLoop::Step() {
  const RotorValues speeds = autopilot_.Step(EstimateOf(state, t_ns_), command_, pilot);
  if (wind) {
    const double dt = autopilot_.options().control_dt, span = 2 * model().half_size_B.y;
    const WindSample air = StepWind(*wind, time(), dt, state.p_WB.z, state.v_WB, span, wind_state);
    surroundings.wind_W = air.velocity_W;
    surroundings.wind_rate_B = ToMatrix(state.q_WB).transpose() * air.rate_W;
  }
  for (int i = 0; i < substeps_; ++i) dynamics_.Step(surroundings, speeds, health, state);
  t_ns_ += std::llround(autopilot_.options().control_dt * 1e9);
}

void FlightLoop::Run(double seconds) {
  const auto steps = std::llround(seconds / autopilot_.options().control_dt);
  for (int64_t i = 0; i < steps; ++i) Step();
}

TrackingError Track(FlightLoop& loop, std::shared_ptr<const ReferenceTrajectory> trajectory, double from, double to) {
  const double start = loop.time();
  loop.Give(TrajectoryCommand{trajectory});
  TrackingError error;
  double sum = 0;
  int64_t count = 0;
  while (loop.time() - start < to) {
    loop.Step();
    const double t = loop.time() - start;
    const DroneState& s = loop.state;
    error.upright &= std::isfinite(s.p_WB.x) && ToMatrix(s.q_WB).m[2][2] > 0;
    if (t < from) continue;
    const double distance = Norm(s.p_WB - trajectory->At(std::min(t, trajectory->duration())).p);
    sum += distance * distance;
    error.max = std::max(error.max, distance);
    ++count;
  }
  error.rms = std::sqrt(sum / static_cast<double>(std::max<int64_t>(count, 1)));
  return error;
}

StandardLemniscate StandardLemniscateFor(const DroneModel& model, const ControlGains& gains) {
  double arm = 0;
  for (const RotorModel& rotor : model.rotors) arm = std::max(arm, std::hypot(rotor.p_B.x, rotor.p_B.y));
  StandardLemniscate lemniscate;
  lemniscate.amplitude = std::clamp(10 * arm, 0.5, 10.0);
  // Its acceleration peaks at about 2 A w^2, its speed at sqrt(2) A w.
  const double agile = std::sqrt(lemniscate.amplitude * 0.6 * gains.max_acceleration);
  lemniscate.speed = std::min(agile, 0.8 * gains.max_speed);
  return lemniscate;
}

FlightCheck CheckFlight(const DroneModel& model) {
  FlightLoop loop(model, {});
  FlightCheck check;
  check.lemniscate = StandardLemniscateFor(model, loop.autopilot().gains());
  const Vec3d center{0, 0, 0};
  const auto curve = std::make_shared<Lemniscate>(center, check.lemniscate.amplitude, check.lemniscate.speed, 1, 3);
  loop.Run(0.5);
  check.tracking = Track(loop, curve, 0, curve->duration());
  loop.Run(2);
  check.hover_error = Norm(loop.state.p_WB - curve->At(curve->duration()).p);
  check.passed = check.tracking.upright && check.tracking.rms < 0.05 * check.lemniscate.amplitude && check.hover_error < 0.02;
  return check;
}

}  // namespace airsim360
