// A world of balls and boxes with exact distances, for tests.
#pragma once

#include <algorithm>
#include <vector>

#include "airsim360/planning/clearance.h"

namespace airsim360 {

struct Ball {
  Vec3d center;
  double radius;
};

/// Solid balls, and solid boxes.
class AnalyticWorld : public ClearanceQuery {
 public:
  AnalyticWorld(std::vector<Ball> balls, std::vector<Box3d> boxes) : balls_(std::move(balls)), boxes_(std::move(boxes)) {}
  double Clearance(Vec3d p, double max_distance) const override {
    double distance = max_distance;
    for (const Ball& ball : balls_) distance = std::min(distance, Norm(p - ball.center) - ball.radius);
    for (const Box3d& box : boxes_) distance = std::min(distance, Norm(Max(Max(box.min - p, p - box.max), Vec3d{})));
    return std::max(distance, 0.0);
  }

 private:
  std::vector<Ball> balls_;
  std::vector<Box3d> boxes_;
};

}  // namespace airsim360
