#include "airsim360/flight/control/autopilot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/flight/control/attitude.h"
#include "airsim360/flight/control/guidance.h"
#include "airsim360/flight/control/mixer.h"
#include "airsim360/flight/control/tracking.h"

namespace airsim360 {
namespace {

const std::vector<std::string>& KindNames() {
  static const std::vector<std::string> kNames = {"simple_flight", "px4", "se3", "indi"};
  return kNames;
}

// A rotor has failed when for this long it turns at less than this share of the speed it should have.
constexpr double kFaultTime = 0.15, kFaultShare = 0.5;
constexpr double kFaultFloor = 0.15;  // of its top speed: slower ones are not judged

void CheckOption(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  char text[160];
  std::snprintf(text, sizeof(text), "autopilot option %s: %g is not in %g ... %g", name, value, low, high);
  throw InputError(text);
}

/// "" or why a disarmed drone cannot do it.
std::string DisarmedProblem(const Command& command, const AutopilotState& state) {
  if (state.mode != FlightMode::kDisarmed) return "";
  const bool fine = std::holds_alternative<ArmCommand>(command) || std::holds_alternative<DisarmCommand>(command) ||
                    std::holds_alternative<TakeoffCommand>(command) || std::holds_alternative<HoverCommand>(command) ||
                    std::holds_alternative<LandCommand>(command);
  return fine ? "" : CommandName(command) + ": the drone is disarmed; arm it or take off first";
}

}  // namespace

ControllerKind ParseControllerKind(const std::string& name) {
  return static_cast<ControllerKind>(ParseChoice("controller", name, KindNames()));
}

std::string ControllerKindName(ControllerKind kind) { return KindNames()[static_cast<size_t>(kind)]; }

Autopilot::Autopilot(const DroneModel& model, const AutopilotOptions& options)
    : model_(model), options_(options), gains_(SynthesizeGains(model, options.control_dt)), mixer_(model) {
  CheckOption("control_dt", options.control_dt, 1e-4, 0.02);
  CheckOption("filter_hz", options.filter_hz, 1, 10000);
  if (options.fence) {
    for (int i = 0; i < 3; ++i) {
      CheckOption("fence.low", options.fence->low[i], -1e9, options.fence->high[i]);
      CheckOption("fence.high", options.fence->high[i], -1e9, 1e9);
    }
    CheckOption("fence.radius", options.fence->radius, 0, 1e9);
  }
  filter_ = 1 - std::exp(-2 * std::numbers::pi * options.filter_hz * options.control_dt);
}

AutopilotState Autopilot::GroundState(const StateEstimate& estimate) const {
  AutopilotState state;
  internal::ResetReference(estimate, state);
  state.home_W = state.start_p_W = estimate.p_WB;
  state.start_yaw = state.reference_yaw;
  return state;
}

AutopilotState Autopilot::HoverState(const StateEstimate& estimate) const {
  AutopilotState state = GroundState(estimate);
  state.mode = FlightMode::kHold;
  state.expected_speeds = state.commanded_speeds = estimate.rotor_speeds;
  // The vertical PID of simple_flight starts where it would settle: pid = 1 - 2 throttle.
  state.throttle_integral = 1 - 2 * model_.mass * kGravity / gains_.max_thrust;
  return state;
}

std::string Autopilot::Problem(const Command& command, const AutopilotState& state) const {
  const std::string problem = CommandProblem(command, model_);
  return problem.empty() ? DisarmedProblem(command, state) : problem;
}

void Autopilot::WatchRotors(const StateEstimate& estimate, AutopilotState& state) const {
  const double dt = options_.control_dt;
  for (size_t i = 0; i < model_.rotors.size(); ++i) {
    const RotorModel& rotor = model_.rotors[i];
    const double tau = std::max(rotor.tau_up, rotor.tau_down);
    double& expected = state.expected_speeds[i];
    expected += (state.commanded_speeds[i] - expected) * dt / (tau + dt);
    const bool slow = expected > kFaultFloor * rotor.max_speed && estimate.rotor_speeds[i] < kFaultShare * expected;
    state.fault_time[i] = slow ? state.fault_time[i] + dt : 0;
    if (state.fault_time[i] > kFaultTime) {
      state.failed_rotors |= uint64_t{1} << i;
      state.flags |= kRotorFailed;
    }
  }
}

RotorValues Autopilot::Drive(const StateEstimate& estimate, const RotorValues& thrust, AutopilotState& state) const {
  RotorValues speeds{};
  for (size_t i = 0; i < model_.rotors.size(); ++i) {
    // Past the goal by the lead, so that the rotor gets there sooner than its own lag lets it.
    const double goal = SpeedForThrust(model_.rotors[i], thrust[i]);
    const double now = estimate.rotor_speeds[i];
    speeds[i] = std::clamp(now + gains_.lead * (goal - now), 0.0, model_.rotors[i].max_speed);
  }
  state.commanded_speeds = speeds;
  return speeds;
}

RotorValues Autopilot::Unflown(const Goal& goal, AutopilotState& state) const {
  RotorValues speeds{};
  for (size_t i = 0; i < model_.rotors.size(); ++i) {
    const double most = model_.rotors[i].max_speed;
    if (goal.level == GoalLevel::kIdle) speeds[i] = kIdleShare * most;
    if (goal.level == GoalLevel::kSpeeds) speeds[i] = std::min(goal.speeds[i], most);
  }
  // Controllers start afresh after this.
  if (goal.level != GoalLevel::kSpeeds) state.has_history = 0;
  if (goal.level == GoalLevel::kOff) state.expected_speeds = speeds;
  state.velocity_integral = state.rate_integral = {};
  state.throttle_integral = state.yaw_torque = 0;
  state.commanded_speeds = speeds;
  return speeds;
}

RotorValues Autopilot::Step(const StateEstimate& estimate, const ActiveCommand& command, AutopilotState& state) const {
  const bool armed = state.mode != FlightMode::kDisarmed;
  if (armed) WatchRotors(estimate, state);
  state.flags &= ~uint64_t{kSaturated | kBatteryLow | kBatteryEmpty};
  if (estimate.charge < options_.low_charge) state.flags |= kBatteryLow;
  if (estimate.charge < options_.empty_charge) state.flags |= kBatteryEmpty;

  const Goal goal = internal::Guide(*this, estimate, command, state);
  if (goal.level <= GoalLevel::kSpeeds) return Unflown(goal, state);
  if (options_.controller == ControllerKind::kSimpleFlight) {
    RotorValues speeds = SimpleFlightSignals(model_, options_.simple_flight, goal, estimate, options_.control_dt, state);
    for (size_t i = 0; i < model_.rotors.size(); ++i) {
      speeds[i] = std::sqrt(speeds[i]) * model_.rotors[i].max_speed;
    }
    state.commanded_speeds = speeds;
    return speeds;
  }

  // A lost rotor changes the mix; the mixer of the whole drone is kept ready.
  const uint64_t failed = state.failed_rotors;
  const Mixer mixer = failed ? Mixer(model_, failed) : mixer_;
  const internal::TrackingStep step{model_, gains_, mixer, estimate, ToMatrix(estimate.q_WB), goal, options_.control_dt, filter_};
  RotorWrench wrench = options_.controller == ControllerKind::kPx4   ? internal::Px4Wrench(step, state)
                       : options_.controller == ControllerKind::kSe3 ? internal::Se3Wrench(step, state)
                                                                     : internal::IndiWrench(step, state);
  // Turning the rotors up gives its yaw torque sooner than their drag does: the demand waits for that.
  const double dt = options_.control_dt;
  state.yaw_torque += (wrench.torque_B.z - state.yaw_torque) * dt / (gains_.spin_time + dt);
  wrench.torque_B.z = state.yaw_torque;
  const Mixer::Result mix = mixer.Allocate(wrench);
  if (mix.saturated) state.flags |= kSaturated;
  return Drive(estimate, mix.thrust, state);
}

std::string DescribeState(const AutopilotState& state) {
  static constexpr const char* kModes[] = {"disarmed", "on the ground", "commanded", "hold", "takeoff", "return", "land"};
  static constexpr const char* kFlags[] = {"command refused", "command lost", "done",          "held by the fence",
                                           "rotor failed",    "battery low",  "battery empty", "saturated"};
  std::string text = kModes[static_cast<size_t>(state.mode)];
  std::string why;
  for (size_t i = 0; i < std::size(kFlags); ++i) {
    if (state.flags >> i & 1) why += (why.empty() ? "" : ", ") + std::string(kFlags[i]);
  }
  return why.empty() ? text : text + " (" + why + ")";
}

}  // namespace airsim360
