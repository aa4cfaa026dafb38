// What an agent can do in one turn, at five levels: presets, a goal by direction, waypoints, a velocity, body
// rates. Actions become commands of the drone's own autopilot: everything is flown, nothing is teleported.
#pragma once

#include <numbers>
#include <optional>
#include <variant>
#include <vector>

#include "airsim360/flight/control/command.h"
#include "airsim360/sensors/rig.h"

namespace airsim360 {

enum class Preset {
  kStop,
  kHover,
  kForward,
  kBackward,
  kLeft,
  kRight,
  kUp,
  kDown,
  kTurnLeft,
  kTurnRight,
};
inline constexpr const char* kPresetNames[] = {"stop",  "hover", "forward", "backward",  "left",
                                               "right", "up",    "down",    "turn_left", "turn_right"};

/// How far the presets go: those of AerialVLN (Liu et al., ICCV 2023) unless an episode says otherwise.
struct PresetSizes {
  double forward = 5, lateral = 5, vertical = 2;  ///< metres
  double turn = 15 * std::numbers::pi / 180;      ///< rad
  double hover = 1;                               ///< seconds
};

/// One of a fixed list. `kStop` ends the episode where the drone is.
struct PresetAction {
  Preset preset = Preset::kHover;
};
/// To a place seen from the drone. Angles as in the level panorama: azimuth from the heading, positive to
/// the right; elevation from the horizon, positive up.
struct RelativeGoalAction {
  double azimuth = 0, elevation = 0;  ///< rad
  double distance = 0;                ///< metres
  double speed = 0;                   ///< m/s; 0 = the episode's
  bool face = true;                   ///< turn towards it; else keep the heading
};
/// Along a polyline that begins at the drone.
struct WaypointsAction {
  std::vector<Vec3d> points;  ///< in W, or forward-left-up of the level heading frame; at least one
  bool body_frame = false;
  double speed = 0;
  bool face = true;
};
/// A velocity for a while.
struct VelocityAction {
  Vec3d v;  ///< m/s: forward, left, up of the level heading frame, or in W
  bool world_frame = false;
  double yaw_rate = 0;    ///< rad/s, counter-clockwise seen from above
  double duration = 0.5;  ///< seconds
};
/// Body rates and thrust for a while.
struct RatesAction {
  Vec3d w_B;              ///< rad/s about forward, left, up
  double throttle = 0;    ///< share of the full static thrust, 0 … 1
  double duration = 0.1;  ///< seconds
};
using AgentAction = std::variant<PresetAction, RelativeGoalAction, WaypointsAction, VelocityAction, RatesAction>;
/// Names of the alternatives, in their order.
inline constexpr const char* kActionNames[] = {"preset", "relative_goal", "waypoints", "velocity", "rates"};

/// Where an agent's motion starts from: what it was last sent to, or where it is.
struct AgentPose {
  Vec3d p_W;
  double yaw = 0;
};

/// An action as the autopilot flies it.
struct ActionPlan {
  bool stops = false;  ///< ends the episode
  Command command = HoverCommand{};
  std::optional<AgentPose> target = {};  ///< over when it is reached; none: over after `seconds`
  double seconds = 0;                    ///< how long it takes; with a target: at the longest
  int64_t timeout_ns = 0;                ///< of the command, when nothing follows it
};

/// Longest time of one action, seconds.
inline constexpr double kLongestAction = 60;

/// Pure. `speed` m/s > 0 holds for actions that say none.
ActionPlan PlanAction(const AgentAction& action, const AgentPose& from, const PresetSizes& sizes, double speed);

/// Heading of a body, as BodyPose; of one that points straight up or down, 0.
double HeadingOfBody(const RigidTransform& X_WB);

}  // namespace airsim360
