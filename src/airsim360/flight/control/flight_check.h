// Flying a drone's closed loop without a world: whether it hovers and tracks, and how well.
#pragma once

#include "airsim360/flight/control/autopilot.h"
#include "airsim360/flight/dynamics/dynamics.h"
#include "airsim360/flight/wind/wind.h"

namespace airsim360 {

/// A drone with its autopilot in still or moving air. The dynamics run in whole steps within a control step.
class FlightLoop {
 public:
  /// Hovers at `p_W`. `dynamics_dt` divides options.control_dt.
  FlightLoop(const DroneModel& model, const AutopilotOptions& options, Vec3d p_W = {}, double dynamics_dt = 1e-3);

  /// One control step: the command, then the dynamics.
  void Step();
  void Run(double seconds);
  void Give(const Command& command, int64_t timeout_ns = 0);

  const DroneModel& model() const { return autopilot_.model(); }
  const Autopilot& autopilot() const { return autopilot_; }
  double time() const { return static_cast<double>(t_ns_) * 1e-9; }

  DroneState state;
  AutopilotState pilot;
  DroneSurroundings surroundings;
  RotorHealth health = kAllRotorsWork;
  std::optional<WindSettings> wind;  ///< with it, `wind_state` moves surroundings.wind_W
  WindState wind_state = StartWind(0, 0);

 private:
  Autopilot autopilot_;
  DroneDynamics dynamics_;
  int substeps_;
  int64_t t_ns_ = 0;
  ActiveCommand command_;
};

/// Distances to a reference, metres.
struct TrackingError {
  double rms = 0, max = 0;
  bool upright = true;  ///< never turned over, always finite
};
/// Gives `trajectory` and compares from `from` seconds into it until `to`.
TrackingError Track(FlightLoop& loop, std::shared_ptr<const ReferenceTrajectory> trajectory, double from, double to);

/// The lemniscate by which a drone of any size is judged: ten arm lengths (0.5 to 10 m) in amplitude, flown
/// at 60 % of the acceleration and at most 80 % of the speed that its guidance asks for.
struct StandardLemniscate {
  double amplitude = 0, speed = 0;
};
StandardLemniscate StandardLemniscateFor(const DroneModel& model, const ControlGains& gains);

/// Hovers, flies one turn of the standard lemniscate with the default controller and hovers again. Passed: it
/// stays upright, tracks within 5 % of the amplitude (rms), and hovers within 2 cm at the end.
struct FlightCheck {
  bool passed = false;
  StandardLemniscate lemniscate;
  TrackingError tracking;
  double hover_error = 0;  ///< metres, after the flight
};
FlightCheck CheckFlight(const DroneModel& model);

}  // namespace airsim360
