// What one of AirSim's moves does over time: 50 times a second it looks at the drone and gives a command
// (AirLib/src/vehicles/multirotor/api/MultirotorApiBase.cpp is what it behaves like).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "airsim360/rpc/coordinates/ned_commands.h"

namespace airsim360 {

inline constexpr double kTaskPeriod = 0.02;       ///< seconds between commands
inline constexpr double kDistanceAccuracy = 0.5;  ///< metres: AirSim's, how near to a place a drone can be steered
inline constexpr double kStillSpeed = 0.05;       ///< m/s: AirSim's, what counts as standing still

/// What a move sees of its drone: N relative to the drone's own origin.
struct FlightView {
  Vec3d p_N, v_N;
  double yaw_deg = 0;    ///< clockwise from north
  double yaw_rate = 0;   ///< rad/s, about F's z axis
  bool touches = false;  ///< something, within the last tenth of a second
  Vec3d origin_W;
  airsim::RCData rc;
};

/// One turn of a move: the command, if any, and the move's result once it has come to its end.
struct TaskTurn {
  std::optional<Command> command;
  std::optional<bool> result;
};

class FlightTask {
 public:
  virtual ~FlightTask() = default;
  virtual TaskTurn Turn(const FlightView& view) = 0;

  double timeout = 0;  ///< seconds from the start
  bool result_at_timeout = false;
  bool lands = false;  ///< its result True means that the drone stands
};

struct PathOptions {
  double velocity = 0;  ///< m/s
  airsim::DrivetrainType drivetrain = airsim::DrivetrainType::kMaxDegreeOfFreedom;
  airsim::YawMode yaw;
  double lookahead = -1, adaptive_lookahead = 1;
  bool slow_down = false;  ///< ours: the end is approached at no more than what 2 m/s^2 can stop
};

using TaskPointer = std::unique_ptr<FlightTask>;

/// The same command over and over for `duration` seconds.
TaskPointer MakeTimedTask(Command command, double duration);
/// Chases a point that runs along the polyline from where the drone is. std::invalid_argument with AirSim's
/// texts for a lookahead that makes no sense (follow_path.cc).
TaskPointer MakePathTask(const FlightView& start, const std::vector<Vec3d>& path_N, double timeout, const PathOptions& options);
/// Sinks at 0.2 m/s until something below has stopped it. (AirSim's also ends where a faster descent is caught so hard that
/// the drone rises for a moment: scripts that then disarm drop it.)
TaskPointer MakeLandTask(double timeout);
/// Turns in place. `wrap`: the error is measured round the circle (AirSim does not).
TaskPointer MakeRotateTask(const FlightView& start, double yaw_deg, double margin_deg, double timeout, bool wrap);
/// Follows the sticks of the remote control.
TaskPointer MakeManualTask(const FlightView& start, double vx_max, double vy_max, double z_min, double duration,
                           airsim::DrivetrainType drivetrain, const airsim::YawMode& yaw);

/// The yaw mode of a velocity: along it where the drone may only fly forwards.
airsim::YawMode AdjustYaw(Vec3d v_N, airsim::DrivetrainType drivetrain, airsim::YawMode yaw);

}  // namespace airsim360
