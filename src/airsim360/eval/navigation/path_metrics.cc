#include "airsim360/eval/navigation/path_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360 {

double PathLength(std::span<const Vec3d> path) {
  double length = 0;
  for (size_t i = 1; i < path.size(); ++i) length += Norm(path[i] - path[i - 1]);
  return length;
}

double SuccessByLength(bool success, double shortest, double flown) {
  for (const auto& [what, length] : {std::pair("shortest", shortest), std::pair("flown", flown)}) {
    if (!(length >= 0 && std::isfinite(length)))
      throw InputError(std::string(what) + ": " + std::to_string(length) + " is not a length of at least 0 m");
  }
  const double longer = std::max(shortest, flown);
  if (!success) return 0;
  return longer > 0 ? shortest / longer : 1;
}

double DynamicTimeWarping(std::span<const Vec3d> path, std::span<const Vec3d> reference) {
  if (path.empty() || reference.empty()) throw InputError("time warping: a path without points");
  // One row of the table at a time; before the first points there is nothing to pair with.
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> row(reference.size() + 1, kInfinity), next(row.size(), kInfinity);
  row[0] = 0;
  for (const Vec3d& p : path) {
    next[0] = kInfinity;
    for (size_t j = 1; j < row.size(); ++j) next[j] = Norm(p - reference[j - 1]) + std::min({row[j], row[j - 1], next[j - 1]});
    row.swap(next);
  }
  return row.back();
}

double NormalizedTimeWarping(std::span<const Vec3d> path, std::span<const Vec3d> reference, double threshold) {
  if (!(threshold > 0 && std::isfinite(threshold)))
    throw InputError("time warping: threshold " + std::to_string(threshold) + " is not a number above 0");
  return std::exp(-DynamicTimeWarping(path, reference) / (static_cast<double>(reference.size()) * threshold));
}

}  // namespace airsim360
