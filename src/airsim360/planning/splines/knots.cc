#include "airsim360/planning/splines/knots.h"

namespace airsim360 {

std::vector<Vec3d> KnotsOf(const PolynomialTrajectory& trajectory) {
  std::vector<Vec3d> knots;
  for (size_t i = 0; i < trajectory.segments(); ++i) knots.push_back(trajectory.At(trajectory.start(i)).p);
  knots.push_back(trajectory.At(trajectory.duration()).p);
  return knots;
}

}  // namespace airsim360
