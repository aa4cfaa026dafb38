#include "airsim360/rpc/session/flight_task.h"

#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

constexpr double kStillYawRate = 0.01;  // AirSim's, rad/s
constexpr double kLandingSpeed = 0.2;
constexpr int kLandedTurns = 10;
constexpr double kSticksRange = 10000;  // full deflection of the remote control
constexpr airsim::YawMode kNoTurning{true, 0};

double NormalizedDegrees(double angle) {
  angle = std::fmod(angle, 360);
  return angle > 180 ? angle - 360 : angle <= -180 ? angle + 360 : angle;
}

class TimedTask : public FlightTask {
 public:
  TimedTask(Command command, double duration) : command_(std::move(command)) {
    timeout = duration;
    result_at_timeout = true;
  }
  TaskTurn Turn(const FlightView&) override { return {command_, {}}; }

 private:
  Command command_;
};

class LandTask : public FlightTask {
 public:
  explicit LandTask(double seconds) {
    timeout = seconds;
    lands = true;
  }
  TaskTurn Turn(const FlightView& view) override {
    still_turns_ = view.touches && view.v_N.z <= kStillSpeed ? still_turns_ + 1 : 0;
    TaskTurn turn{NedVelocity({0, 0, kLandingSpeed}, kNoTurning), {}};
    if (still_turns_ > kLandedTurns) turn.result = true;
    return turn;
  }

 private:
  int still_turns_ = 0;
};

class RotateTask : public FlightTask {
 public:
  RotateTask(const FlightView& start, double yaw_deg, double margin_deg, double seconds, bool wrap)
      : p_N_(start.p_N), target_(NormalizedDegrees(yaw_deg)), margin_(margin_deg), wrap_(wrap) {
    timeout = seconds;
  }
  TaskTurn Turn(const FlightView& view) override {
    double error = view.yaw_deg - target_;
    if (wrap_) error = NormalizedDegrees(error);
    if (std::abs(error) > margin_) {
      return {NedPosition(p_N_, {false, static_cast<float>(target_)}, view.origin_W), {}};
    }
    TaskTurn turn{NedPosition(p_N_, kNoTurning, view.origin_W), {}};
    if (std::abs(view.yaw_rate) <= kStillYawRate) turn.result = true;
    return turn;
  }

 private:
  Vec3d p_N_;
  double target_, margin_;
  bool wrap_;
};

class ManualTask : public FlightTask {
 public:
  ManualTask(const FlightView& start, double vx_max, double vy_max, double z_min, double duration, airsim::DrivetrainType drivetrain,
             const airsim::YawMode& yaw)
      : start_yaw_(start.yaw_deg / kRadian), vx_max_(vx_max), vy_max_(vy_max), z_min_(z_min), drivetrain_(drivetrain), yaw_(yaw) {
    timeout = duration;
    result_at_timeout = true;
  }
  TaskTurn Turn(const FlightView& view) override {
    if (!view.rc.is_valid) return {};
    // The sticks mean world directions, seen from the heading at the start.
    const Vec3d stick{view.rc.pitch * vy_max_ / kSticksRange, view.rc.roll * vx_max_ / kSticksRange, 0};
    const double c = std::cos(start_yaw_), s = std::sin(start_yaw_);
    const Vec3d v_N{c * stick.x + s * stick.y, -s * stick.x + c * stick.y, 0};
    airsim::YawMode yaw = yaw_;
    yaw.yaw_or_rate += view.rc.yaw * 100.0f / static_cast<float>(kSticksRange);
    const double z = view.rc.throttle / kSticksRange * z_min_ + view.p_N.z;
    return {NedVelocityZ(v_N.x, v_N.y, z, AdjustYaw(v_N, drivetrain_, yaw), view.origin_W), {}};
  }

 private:
  double start_yaw_, vx_max_, vy_max_, z_min_;
  airsim::DrivetrainType drivetrain_;
  airsim::YawMode yaw_;
};

}  // namespace

airsim::YawMode AdjustYaw(Vec3d v_N, airsim::DrivetrainType drivetrain, airsim::YawMode yaw) {
  if (drivetrain != airsim::DrivetrainType::kForwardOnly || yaw.is_rate) return yaw;
  // Too slow for a direction: the heading stays.
  if (Norm(v_N) <= kDistanceAccuracy) return kNoTurning;
  yaw.yaw_or_rate = static_cast<float>(NormalizedDegrees(yaw.yaw_or_rate + std::atan2(v_N.y, v_N.x) * kRadian));
  return yaw;
}

TaskPointer MakeTimedTask(Command command, double duration) { return std::make_unique<TimedTask>(std::move(command), duration); }
TaskPointer MakeLandTask(double timeout) { return std::make_unique<LandTask>(timeout); }
TaskPointer MakeRotateTask(const FlightView& start, double yaw_deg, double margin_deg, double timeout, bool wrap) {
  return std::make_unique<RotateTask>(start, yaw_deg, margin_deg, timeout, wrap);
}
TaskPointer MakeManualTask(const FlightView& start, double vx_max, double vy_max, double z_min, double duration,
                           airsim::DrivetrainType drivetrain, const airsim::YawMode& yaw) {
  return std::make_unique<ManualTask>(start, vx_max, vy_max, z_min, duration, drivetrain, yaw);
}

}  // namespace airsim360
