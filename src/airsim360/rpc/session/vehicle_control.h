// One vehicle as its API sees it: who controls it, what move it is in, whether it has landed or collided.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "airsim360/rpc/session/flight_task.h"
#include "airsim360/rpc/session/snapshot.h"
#include "airsim360/rpc/wire/reply.h"

namespace airsim360 {

/// Belongs to the simulation's thread.
class VehicleControl {
 public:
  VehicleControl(size_t index, const std::string& name, const VehicleSettings& settings, bool is_drone, Vec3d origin_W);

  /// The vehicle as it is after a reset: nobody controls it.
  void Reset(bool armed);
  void EnableApi(bool enabled);
  /// False without API control, as AirSim.
  bool Arm(bool arm);

  /// Starts a move, which ends the running one with False. `reply` is answered when it ends.
  void Start(TaskPointer task, int64_t t_ns, const Reply& reply);
  void Cancel();
  /// The same, and no place is held either: somebody else steers now.
  void LetGo();

  /// To be called before every control step at time t: the command to be given, if any.
  std::optional<FlightCommand> Plan(const Vehicle& vehicle, int64_t t_ns);
  /// To be called after every step: landed state and collision latch.
  void Observe(const DroneModel& model, const Vehicle& vehicle);
  /// simGetCollisionInfo: whether it has collided since the last call.
  bool TakeCollision();

  /// What a move sees at time t.
  FlightView ViewOf(const Vehicle& vehicle, int64_t t_ns) const;
  const VehicleStatus& status() const { return status_; }
  const VehicleSettings& settings() const { return settings_; }
  size_t index() const { return index_; }
  /// Another vehicle has come before it.
  void MoveUp() { ++index_; }
  airsim::RCData& rc() { return status_.rc; }
  SimpleFlightGains gains;

 private:
  std::optional<FlightCommand> TurnTask(const Vehicle& vehicle, int64_t t_ns);
  void Finish(bool result);

  struct Running {
    TaskPointer task;
    int64_t start_ns, next_ns;
    Reply reply;
  };
  size_t index_;
  VehicleSettings settings_;
  VehicleStatus status_;
  std::optional<Running> running_;
  std::deque<Command> urgent_;         // each is given for a whole control step
  std::optional<int64_t> hold_at_ns_;  // when the drone begins to hold its place
  uint64_t collisions_seen_ = 0;
  std::optional<Vec3d> landed_at_W_;  // where `land` has set it down, as long as it is there
};

}  // namespace airsim360
