#include "airsim360/rpc/flight_task.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace airsim360 {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
// AirSim's: how near to a place a drone can be steered, and what counts as standing still.
constexpr double kDistanceAccuracy = 0.5, kStillSpeed = 0.05, kStillYawRate = 0.01;
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
  explicit LandTask(double seconds) { timeout = seconds; }
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
      : start_yaw_(start.yaw_deg / kDegrees), vx_max_(vx_max), vy_max_(vy_max), z_min_(z_min), drivetrain_(drivetrain), yaw_(yaw) {
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

// Throws what AirSim's server says about a lookahead; returns the one to use.
double CheckedLookahead(const PathOptions& options) {
  if (options.drivetrain == airsim::DrivetrainType::kForwardOnly && options.yaw.is_rate) {
    throw std::invalid_argument("Yaw cannot be specified as rate if drivetrain is ForwardOnly");
  }
  const double turn_distance = options.velocity * kTaskPeriod, lookahead = options.lookahead;
  if (lookahead == 0) throw std::invalid_argument("lookahead distance cannot be 0");
  if (lookahead > 0 && turn_distance > lookahead) {
    throw std::invalid_argument("lookahead value " + std::to_string(lookahead) + " is too small for velocity " +
                                std::to_string(options.velocity) + ". It must be at least " + std::to_string(turn_distance));
  }
  if (lookahead > 0 && kDistanceAccuracy > lookahead) {
    throw std::invalid_argument("lookahead value " + std::to_string(lookahead) + " is smaller than drone's distance accuracy " +
                                std::to_string(kDistanceAccuracy) + ".");
  }
  if (lookahead > 0) return lookahead;
  // Automatic: that many turns ahead, at least half again the accuracy.
  const double turns = options.adaptive_lookahead > 0 ? 30 : 40;
  return std::max(turns * turn_distance, 1.5 * kDistanceAccuracy);
}

class PathTask : public FlightTask {
 public:
  PathTask(const FlightView& start, const std::vector<Vec3d>& path_N, double seconds, const PathOptions& options)
      : options_(options), lookahead_(CheckedLookahead(options)) {
    timeout = seconds;
    points_.push_back(start.p_N);
    lengths_.push_back(0);
    for (const Vec3d& point : path_N) {
      lengths_.push_back(lengths_.back() + Norm(point - points_.back()));
      points_.push_back(point);
    }
  }

  TaskTurn Turn(const FlightView& view) override {
    if (lengths_.back() == 0) return {{}, true};
    if (started_ && Advance(view.p_N)) return {{}, true};
    started_ = true;
    carrot_s_ = std::min(s_ + lookahead_ + error_, lengths_.back());
    return {Chase(view, At(carrot_s_)), {}};
  }

 private:
  // The place at arc length s.
  Vec3d At(double s) const {
    const size_t next = std::min<size_t>(static_cast<size_t>(std::upper_bound(lengths_.begin(), lengths_.end(), s) - lengths_.begin()),
                                         lengths_.size() - 1);
    const double length = lengths_[next] - lengths_[next - 1];
    const double share = length > 0 ? std::clamp((s - lengths_[next - 1]) / length, 0.0, 1.0) : 1;
    return points_[next - 1] + (points_[next] - points_[next - 1]) * share;
  }

  // Moves along the path by what the drone has come nearer to the carrot, never back. True at the end.
  bool Advance(Vec3d p_N) {
    const Vec3d here = At(s_), to_carrot = At(carrot_s_) - here;
    if (Norm(to_carrot) == 0) return true;
    const Vec3d direction = Normalized(to_carrot), moved = p_N - here;
    const double along = Dot(moved, direction);
    if (options_.adaptive_lookahead != 0) {
      error_ = Norm(moved - direction * along) * options_.adaptive_lookahead;
    }
    if (along > 0) s_ = std::min(s_ + along, lengths_.back());
    const bool carrot_at_end = carrot_s_ >= lengths_.back();
    // Near enough to the end and as good as standing: no longer on its way.
    const bool stands = along <= kStillSpeed * kTaskPeriod;
    return carrot_at_end && stands && Norm(points_.back() - p_N) <= kDistanceAccuracy;
  }

  Command Chase(const FlightView& view, Vec3d goal) const {
    const Vec3d way = goal - view.p_N;
    const double distance = Norm(way);
    double speed = options_.velocity;
    if (options_.slow_down) {
      constexpr double kBraking = 2, kCreep = 0.5;  // m/s^2, m/s
      const double left = lengths_.back() - s_;
      speed = std::min(speed, std::max(kCreep, std::sqrt(2 * kBraking * left)));
    }
    Vec3d v_N{};
    if (distance >= kDistanceAccuracy) v_N = way * (std::min(speed, distance / kTaskPeriod) / distance);
    // Level paths leave the height alone.
    if (std::abs(way.z) <= kDistanceAccuracy) v_N.z = 0;
    return NedVelocity(v_N, AdjustYaw(way, options_.drivetrain, options_.yaw));
  }

  PathOptions options_;
  double lookahead_;
  std::vector<Vec3d> points_;
  std::vector<double> lengths_;  // of the way to each point
  double s_ = 0, carrot_s_ = 0, error_ = 0;
  bool started_ = false;
};

}  // namespace

airsim::YawMode AdjustYaw(Vec3d v_N, airsim::DrivetrainType drivetrain, airsim::YawMode yaw) {
  if (drivetrain != airsim::DrivetrainType::kForwardOnly || yaw.is_rate) return yaw;
  // Too slow for a direction: the heading stays.
  if (Norm(v_N) <= kDistanceAccuracy) return kNoTurning;
  yaw.yaw_or_rate = static_cast<float>(NormalizedDegrees(yaw.yaw_or_rate + std::atan2(v_N.y, v_N.x) * kDegrees));
  return yaw;
}

TaskPointer MakeTimedTask(Command command, double duration) { return std::make_unique<TimedTask>(std::move(command), duration); }
TaskPointer MakePathTask(const FlightView& start, const std::vector<Vec3d>& path_N, double timeout, const PathOptions& options) {
  return std::make_unique<PathTask>(start, path_N, timeout, options);
}
TaskPointer MakeLandTask(double timeout) { return std::make_unique<LandTask>(timeout); }
TaskPointer MakeRotateTask(const FlightView& start, double yaw_deg, double margin_deg, double timeout, bool wrap) {
  return std::make_unique<RotateTask>(start, yaw_deg, margin_deg, timeout, wrap);
}
TaskPointer MakeManualTask(const FlightView& start, double vx_max, double vy_max, double z_min, double duration,
                           airsim::DrivetrainType drivetrain, const airsim::YawMode& yaw) {
  return std::make_unique<ManualTask>(start, vx_max, vy_max, z_min, duration, drivetrain, yaw);
}

}  // namespace airsim360
