// What a drone can be asked to do, from rotor speeds up to whole trajectories.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "airsim360/flight/control/reference.h"
#include "airsim360/flight/drone_model.h"

namespace airsim360 {

/// How the heading moves. Angles as in BodyPose: 0 faces +X of W, counter-clockwise seen from above.
struct YawTarget {
  enum class Mode { kKeep, kAngle, kRate, kForward };  ///< kForward: along the horizontal velocity
  Mode mode = Mode::kKeep;
  double value = 0;  ///< rad or rad/s
};

/// How the height is controlled by commands that do not hold a position.
struct VerticalTarget {
  enum class Mode { kThrottle, kAltitude };
  Mode mode = Mode::kThrottle;
  double value = 0;  ///< share of the full static thrust, 0 to 1; or metres (z of W)
};

struct ArmCommand {};
struct DisarmCommand {};
/// Rotor speeds, rad/s, in the order of the model.
struct RotorSpeedCommand {
  std::array<double, kMaxRotors> speeds{};
};
/// Rotor signals, 0 to 1 of each rotor's full static thrust: speed = sqrt(signal) * max_speed (AirSim's PWM).
struct RotorSignalCommand {
  std::array<double, kMaxRotors> signals{};
};
struct RateCommand {
  Vec3d w_B;  ///< rad/s
  VerticalTarget vertical;
};
/// roll: right side down positive; pitch: nose up positive (BodyPose).
struct AttitudeCommand {
  double roll = 0, pitch = 0;
  YawTarget yaw = {};
  VerticalTarget vertical;
};
struct VelocityCommand {
  Vec3d v;                    ///< m/s
  bool body_heading = false;  ///< v is in the level frame turned by the heading that the drone has now
  YawTarget yaw = {};
  bool hold_altitude = false;  ///< then v.z counts for nothing and `altitude` (z of W) is kept
  double altitude = 0;
};
struct PositionCommand {
  Vec3d p_W;
  double speed = 0;  ///< m/s; 0 = what the drone is made for
  YawTarget yaw = {};
};
/// Follows the polyline from where the drone is through the waypoints, chasing a point `lookahead` ahead.
struct PathCommand {
  std::shared_ptr<const std::vector<Vec3d>> waypoints;  ///< in W, at least one
  double speed = 0;                                     ///< m/s; 0 = what the drone is made for
  double lookahead = 0;                                 ///< metres; 0 = max(0.75, 0.6 s * speed)
  YawTarget yaw = {};
};
/// Follows p(t) with feed-forward of every derivative; t runs from the command's start.
struct TrajectoryCommand {
  std::shared_ptr<const ReferenceTrajectory> trajectory;
};
/// Arms if necessary and climbs `height` above where it stands.
struct TakeoffCommand {
  double height = 2, speed = 1;  ///< metres, m/s
};
/// Sinks until the ground stops it, then disarms.
struct LandCommand {
  double speed = 0.7;  ///< m/s
};
/// Stops and stays.
struct HoverCommand {
  YawTarget yaw = {};
};
/// Climbs to at least `height` above home, flies there, lands if asked to. Home is where the drone was armed.
struct ReturnCommand {
  double height = 5, speed = 0;
  bool land = true;
};

using Command = std::variant<HoverCommand, ArmCommand, DisarmCommand, RotorSpeedCommand, RotorSignalCommand, RateCommand, AttitudeCommand,
                             VelocityCommand, PositionCommand, PathCommand, TrajectoryCommand, TakeoffCommand, LandCommand, ReturnCommand>;

/// A command as a drone receives it. A new `id` is a new command; the same id again changes nothing but
/// `timeout_ns`, so that a stream of setpoints renews itself with new ids.
struct ActiveCommand {
  Command command;
  uint64_t id = 0;
  int64_t timeout_ns = 0;  ///< after this long without a new command the drone hovers; 0 = never
};

/// Why a command cannot be flown by a drone with these rotors, naming the field and its value ("velocity.v.x:
/// nan is not a number"); "" when it can. NaN, infinite and absurd values are refused.
std::string CommandProblem(const Command& command, const DroneModel& model);

/// "hover", "velocity", …
std::string CommandName(const Command& command);

}  // namespace airsim360
