#include "airsim360/rpc/session/flight_task.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace airsim360 {
namespace {

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

TaskPointer MakePathTask(const FlightView& start, const std::vector<Vec3d>& path_N, double timeout, const PathOptions& options) {
  return std::make_unique<PathTask>(start, path_N, timeout, options);
}

}  // namespace airsim360
