// From a command and an estimate of the state to rotor speeds: guidance, one of four controllers, the mixer.
#pragma once

#include <optional>
#include <string>

#include "airsim360/flight/control/autopilot_state.h"
#include "airsim360/flight/control/command.h"
#include "airsim360/flight/control/estimate.h"
#include "airsim360/flight/control/gains.h"
#include "airsim360/flight/control/simple_flight.h"

namespace airsim360 {

enum class ControllerKind {
  kSimpleFlight,  ///< AirSim's cascade with AirSim's gains
  kPx4,           ///< position P, velocity PID, attitude P, rate PID
  kSe3,           ///< geometric tracking on SE(3) (Lee, Leok and McClamroch 2010)
  kIndi,          ///< flat feed-forward with incremental dynamic inversion (Tal and Karaman 2018)
};

/// "simple_flight", "px4", "se3", "indi"; InputError naming the nearest one.
ControllerKind ParseControllerKind(const std::string& name);
std::string ControllerKindName(ControllerKind kind);

/// A box of W, and a largest distance from home seen from above.
struct Geofence {
  Vec3d low{-1e9, -1e9, -1e9}, high{1e9, 1e9, 1e9};
  double radius = 1e9;
};

struct AutopilotOptions {
  ControllerKind controller = ControllerKind::kIndi;
  double control_dt = 0.002;  ///< seconds between calls of Step, a whole number of steps of the dynamics
  double filter_hz = 60;      ///< of measured accelerations (indi)
  std::optional<Geofence> fence;
  double low_charge = 0.2, empty_charge = 0.05;
  SimpleFlightGains simple_flight;
};

/// Constant after construction: any number of drones and threads may share one.
class Autopilot {
 public:
  /// InputError when the drone cannot fly (SynthesizeGains) or an option is out of range.
  explicit Autopilot(const DroneModel& model, const AutopilotOptions& options = {});

  /// At rest where it is: on the ground and disarmed, or hovering.
  AutopilotState GroundState(const StateEstimate& estimate) const;
  AutopilotState HoverState(const StateEstimate& estimate) const;

  /// One control step: the commanded speed of each rotor, rad/s. A pure function of its arguments; `state` is
  /// all that it remembers. A command that cannot be flown is refused (kCommandRefused) and the drone hovers.
  RotorValues Step(const StateEstimate& estimate, const ActiveCommand& command, AutopilotState& state) const;

  /// Why `command` is or would be refused now; "" when it is flown. Names the field and its value.
  std::string Problem(const Command& command, const AutopilotState& state) const;

  const DroneModel& model() const { return model_; }
  const AutopilotOptions& options() const { return options_; }
  const ControlGains& gains() const { return gains_; }

 private:
  void WatchRotors(const StateEstimate& estimate, AutopilotState& state) const;
  /// Rotors off, idle or as commanded.
  RotorValues Unflown(const Goal& goal, AutopilotState& state) const;
  RotorValues Drive(const StateEstimate& estimate, const RotorValues& thrust, AutopilotState& state) const;

  DroneModel model_;
  AutopilotOptions options_;
  ControlGains gains_;
  Mixer mixer_;
  double filter_ = 1;  ///< share of a new sample in the filtered accelerations
};

/// "commanded", "hold (command refused)", …: for logs and users.
std::string DescribeState(const AutopilotState& state);

}  // namespace airsim360
