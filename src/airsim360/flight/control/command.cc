#include "airsim360/flight/control/command.h"

#include <cmath>
#include <cstdio>

namespace airsim360 {
namespace {

// Beyond these no drone flies; a command that says so is a mistake of its sender.
constexpr double kFarthest = 1e6;       // metres
constexpr double kFastest = 200;        // m/s
constexpr double kFastestTurn = 100;    // rad/s
constexpr double kLargestAngle = 1000;  // rad; angles wrap
constexpr double kLongest = 1e7;        // seconds

/// Collects the first problem.
class Checker {
 public:
  explicit Checker(std::string command) : command_(std::move(command)) {}

  void Range(const char* field, double value, double low, double high) {
    if (!problem_.empty() || (value >= low && value <= high)) return;
    char text[160];
    if (!std::isfinite(value)) {
      std::snprintf(text, sizeof(text), "%g is not a finite number", value);
    } else {
      std::snprintf(text, sizeof(text), "%g is not in %g ... %g", value, low, high);
    }
    Fail(field, text);
  }
  void Vector(const std::string& field, Vec3d v, double limit) {
    Range((field + ".x").c_str(), v.x, -limit, limit);
    Range((field + ".y").c_str(), v.y, -limit, limit);
    Range((field + ".z").c_str(), v.z, -limit, limit);
  }
  void Yaw(const YawTarget& yaw) {
    const double limit = yaw.mode == YawTarget::Mode::kRate ? kFastestTurn : kLargestAngle;
    Range("yaw", yaw.value, -limit, limit);
  }
  void Vertical(const VerticalTarget& vertical) {
    if (vertical.mode == VerticalTarget::Mode::kThrottle) {
      Range("throttle", vertical.value, 0, 1);
    } else {
      Range("altitude", vertical.value, -kFarthest, kFarthest);
    }
  }
  void Fail(const std::string& field, const std::string& what) {
    if (problem_.empty()) problem_ = command_ + "." + field + ": " + what;
  }
  const std::string& problem() const { return problem_; }

 private:
  std::string command_, problem_;
};

struct Check {
  Checker& check;
  const DroneModel& model;

  void operator()(const ArmCommand&) const {}
  void operator()(const DisarmCommand&) const {}
  void operator()(const RotorSpeedCommand& c) const {
    for (size_t i = 0; i < model.rotors.size(); ++i) {
      check.Range(("speeds[" + std::to_string(i) + "]").c_str(), c.speeds[i], 0, 10 * model.rotors[i].max_speed);
    }
  }
  void operator()(const RotorSignalCommand& c) const {
    for (size_t i = 0; i < model.rotors.size(); ++i) {
      check.Range(("signals[" + std::to_string(i) + "]").c_str(), c.signals[i], 0, 1);
    }
  }
  void operator()(const RateCommand& c) const {
    check.Vector("w", c.w_B, kFastestTurn);
    check.Vertical(c.vertical);
  }
  void operator()(const AttitudeCommand& c) const {
    check.Range("roll", c.roll, -3.15, 3.15);
    check.Range("pitch", c.pitch, -3.15, 3.15);
    check.Yaw(c.yaw);
    check.Vertical(c.vertical);
  }
  void operator()(const VelocityCommand& c) const {
    check.Vector("v", c.v, kFastest);
    check.Range("altitude", c.altitude, -kFarthest, kFarthest);
    check.Yaw(c.yaw);
  }
  void operator()(const PositionCommand& c) const {
    check.Vector("p", c.p_W, kFarthest);
    check.Range("speed", c.speed, 0, kFastest);
    check.Yaw(c.yaw);
  }
  void operator()(const PathCommand& c) const {
    if (!c.waypoints || c.waypoints->empty()) return check.Fail("waypoints", "there are none");
    for (size_t i = 0; i < c.waypoints->size() && check.problem().empty(); ++i) {
      check.Vector("waypoints[" + std::to_string(i) + "]", (*c.waypoints)[i], kFarthest);
    }
    check.Range("speed", c.speed, 0, kFastest);
    check.Range("lookahead", c.lookahead, 0, kFarthest);
    check.Yaw(c.yaw);
  }
  void operator()(const TrajectoryCommand& c) const {
    if (!c.trajectory) return check.Fail("trajectory", "there is none");
    check.Range("duration", c.trajectory->duration(), 0, kLongest);
  }
  void operator()(const TakeoffCommand& c) const {
    check.Range("height", c.height, 0.05, 10000);
    check.Range("speed", c.speed, 0.05, kFastest);
  }
  void operator()(const LandCommand& c) const { check.Range("speed", c.speed, 0.05, 20); }
  void operator()(const HoverCommand& c) const { check.Yaw(c.yaw); }
  void operator()(const ReturnCommand& c) const {
    check.Range("height", c.height, 0, 10000);
    check.Range("speed", c.speed, 0, kFastest);
  }
};

}  // namespace

std::string CommandName(const Command& command) {
  static constexpr const char* kNames[] = {"hover",    "arm",      "disarm", "rotor_speeds", "rotor_signals", "rates", "attitude",
                                           "velocity", "position", "path",   "trajectory",   "takeoff",       "land",  "return"};
  static_assert(std::size(kNames) == std::variant_size_v<Command>);
  return kNames[command.index()];
}

std::string CommandProblem(const Command& command, const DroneModel& model) {
  Checker checker(CommandName(command));
  std::visit(Check{checker, model}, command);
  return checker.problem();
}

}  // namespace airsim360
