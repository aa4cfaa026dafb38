// Shortcuts along collision-free polylines.
#include <algorithm>

#include "airsim360/planning/certificate.h"
#include "airsim360/planning/routes/search.h"

namespace airsim360 {
namespace {

constexpr double kLeastGain = 1e-3;  // of the length, for another round
constexpr int kMaxRounds = 30;
constexpr int kHalvings = 4;

// From each point on to the farthest one that can be seen.
std::vector<Vec3d> SkipPoints(const std::vector<Vec3d>& path, const ClearanceQuery& world, double radius) {
  std::vector<Vec3d> out = {path.front()};
  for (size_t i = 0; i + 1 < path.size();) {
    size_t j = path.size() - 1;
    while (j > i + 1 && !SegmentIsClear(path[i], path[j], world, radius)) --j;
    out.push_back(path[j]);
    i = j;
  }
  return out;
}

// Replaces each corner by the longest chord across it that is clear, from half of its legs down.
std::vector<Vec3d> CutCorners(const std::vector<Vec3d>& path, const ClearanceQuery& world, double radius) {
  std::vector<Vec3d> out = {path.front()};
  for (size_t i = 1; i + 1 < path.size(); ++i) {
    const Vec3d corner = path[i];
    bool cut = false;
    for (double part = 0.5, k = 0; k < kHalvings && !cut; part /= 2, ++k) {
      const Vec3d a = corner + (path[i - 1] - corner) * part, b = corner + (path[i + 1] - corner) * part;
      if (!SegmentIsClear(a, b, world, radius)) continue;
      if (Norm(a - out.back()) > 1e-6) out.push_back(a);
      out.push_back(b);
      cut = true;
    }
    if (!cut) out.push_back(corner);
  }
  if (Norm(out.back() - path.back()) > 1e-6) out.push_back(path.back());
  return out;
}

}  // namespace

std::vector<Vec3d> Shortcut(std::vector<Vec3d> path, const ClearanceQuery& world, double radius) {
  if (path.size() < 3) return path;
  path = SkipPoints(path, world, radius);
  double length = PolylineLength(path);
  for (int round = 0; round < kMaxRounds && path.size() > 2; ++round) {
    std::vector<Vec3d> cut = SkipPoints(CutCorners(path, world, radius), world, radius);
    const double shorter = PolylineLength(cut);
    if (!(shorter < length * (1 - kLeastGain))) break;
    path = std::move(cut);
    length = shorter;
  }
  return path;
}

}  // namespace airsim360
