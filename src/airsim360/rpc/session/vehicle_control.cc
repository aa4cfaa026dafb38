#include "airsim360/rpc/session/vehicle_control.h"

#include <cmath>
#include <numbers>

namespace airsim360 {
namespace {

// AirSim's SimpleFlight (Params.hpp): without a goal for this long the drone holds its place.
constexpr int64_t kGoalTimeoutNs = 60'000'000;
constexpr auto kTaskPeriodNs = static_cast<int64_t>(kTaskPeriod * 1e9);
// A drone that stands with its rotors turning does not touch the ground in every step.
constexpr int64_t kTouchNs = 100'000'000;
// When it has taken off or landed: motor output, vertical speed, all speeds.
constexpr double kFlyingOutput = 0.1, kFlyingSpeed = 0.01, kLandedSpeed = 0.08;

// Mean signal of the rotors, 0 to 1.
double MotorOutput(const DroneModel& model, const Vehicle& vehicle) {
  double sum = 0;
  for (size_t i = 0; i < model.rotors.size(); ++i) {
    const double share = vehicle.rotor_commands[i] / model.rotors[i].max_speed;
    sum += share * share;
  }
  return sum / static_cast<double>(model.rotors.size());
}

}  // namespace

VehicleControl::VehicleControl(size_t index, const std::string& name, const VehicleSettings& settings, bool is_drone, Vec3d origin_W)
    : index_(index), settings_(settings) {
  status_.name = name;
  status_.is_drone = is_drone;
  status_.origin_W = origin_W;
  Reset(settings.armed);
}

void VehicleControl::Reset(bool armed) {
  Cancel();
  urgent_.clear();
  hold_at_ns_.reset();
  collisions_seen_ = 0;
  status_.api_control = status_.has_collided = false;
  landed_at_W_.reset();
  status_.landed = airsim::LandedState::kLanded;
  status_.armed = armed && status_.is_drone;
  if (status_.armed) urgent_.push_back(ArmCommand{});
}

void VehicleControl::EnableApi(bool enabled) {
  status_.api_control = enabled;
  if (!enabled) Cancel();
}

bool VehicleControl::Arm(bool arm) {
  if (!status_.api_control) return false;
  if (status_.is_drone && arm != status_.armed) {
    if (arm) {
      urgent_.push_back(ArmCommand{});
    } else {
      urgent_.push_back(DisarmCommand{});
      hold_at_ns_.reset();
    }
  }
  status_.armed = arm;
  return true;
}

void VehicleControl::Finish(bool result) {
  const Reply reply = running_->reply;
  running_.reset();
  reply.Result(result);
}

void VehicleControl::Cancel() {
  if (running_) Finish(false);
}

void VehicleControl::LetGo() {
  Cancel();
  landed_at_W_.reset();
  hold_at_ns_.reset();
}

void VehicleControl::Start(TaskPointer task, int64_t t_ns, const Reply& reply) {
  Cancel();
  if (task->timeout <= 0) {
    reply.Result(task->result_at_timeout);
    return;
  }
  landed_at_W_.reset();
  running_ = Running{std::move(task), t_ns, t_ns, reply};
}

FlightView VehicleControl::ViewOf(const Vehicle& vehicle, int64_t t_ns) const {
  const Kinematics& motion = vehicle.motion;
  const Mat3d R_NF = NedRotation(motion.X_WB.R);
  FlightView view;
  view.origin_W = status_.origin_W;
  view.p_N = NedFromWorld(motion.X_WB.p - status_.origin_W);
  view.v_N = NedFromWorld(motion.v_WB);
  view.yaw_deg = std::atan2(R_NF.m[1][0], R_NF.m[0][0]) * 180 / std::numbers::pi;
  view.yaw_rate = FrdFromBody(motion.w_WB_B).z;
  view.touches = vehicle.touched_ns >= 0 && t_ns - vehicle.touched_ns <= kTouchNs;
  view.rc = status_.rc;
  return view;
}

std::optional<FlightCommand> VehicleControl::TurnTask(const Vehicle& vehicle, int64_t t_ns) {
  if (t_ns < running_->next_ns) return {};
  if (static_cast<double>(t_ns - running_->start_ns) * 1e-9 >= running_->task->timeout) {
    Finish(running_->task->result_at_timeout);
    return {};
  }
  running_->next_ns += kTaskPeriodNs;
  const TaskTurn turn = running_->task->Turn(ViewOf(vehicle, t_ns));
  if (turn.result && *turn.result && running_->task->lands && !landed_at_W_) {
    // A turn before the answer, so that it is in the state that is asked for after it.
    landed_at_W_ = vehicle.motion.X_WB.p;
    status_.landed = airsim::LandedState::kLanded;
  } else if (turn.result) {
    Finish(*turn.result);
  }
  // Without API control a move runs and steers nothing.
  if (!turn.command || !status_.api_control) return {};
  hold_at_ns_ = t_ns + kGoalTimeoutNs;
  return FlightCommand{*turn.command, 0};
}

std::optional<FlightCommand> VehicleControl::Plan(const Vehicle& vehicle, int64_t t_ns) {
  if (!urgent_.empty()) {
    const Command command = urgent_.front();
    urgent_.pop_front();
    return FlightCommand{command, 0};
  }
  if (running_) {
    if (auto command = TurnTask(vehicle, t_ns)) return command;
  }
  if (!hold_at_ns_ || t_ns < *hold_at_ns_ || running_) return {};
  // No goal any more: the drone stays where it is.
  hold_at_ns_.reset();
  const FlightView view = ViewOf(vehicle, t_ns);
  return FlightCommand{NedPosition(view.p_N, {true, 0}, view.origin_W), 0};
}

void VehicleControl::Observe(const DroneModel& model, const Vehicle& vehicle) {
  if (vehicle.collision.count != collisions_seen_) {
    collisions_seen_ = vehicle.collision.count;
    status_.has_collided = vehicle.collision.count > 0 && settings_.enable_collisions;
  }
  const double output = MotorOutput(model, vehicle);
  const Vec3d v = vehicle.motion.v_WB;
  // Set down by `land` it stands, though its rotors turn to hold it there, until it is sent away or carried off.
  if (landed_at_W_ && Norm(vehicle.motion.X_WB.p - *landed_at_W_) > kDistanceAccuracy) landed_at_W_.reset();
  if (landed_at_W_) return;
  if (status_.landed == airsim::LandedState::kLanded) {
    if (output > kFlyingOutput && std::abs(v.z) > kFlyingSpeed) status_.landed = airsim::LandedState::kFlying;
  } else if (output <= kFlyingOutput && Norm(v) < kLandedSpeed) {
    status_.landed = airsim::LandedState::kLanded;
  }
}

bool VehicleControl::TakeCollision() {
  const bool collided = status_.has_collided;
  status_.has_collided = false;
  return collided;
}

}  // namespace airsim360
