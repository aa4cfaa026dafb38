#include "airsim360/planning/reachable.h"

#include <algorithm>
#include <array>

namespace airsim360 {
namespace {

constexpr double kLook = 5;  // metres around the seed

using Cell = std::array<int, 3>;

}  // namespace

ReachableSpace::ReachableSpace(const ClearanceField& field, Vec3d seed, double radius) : field_(field) {
  const int n[3] = {field.size(0), field.size(1), field.size(2)};
  const auto index = [&](const Cell& c) { return (static_cast<size_t>(c[2]) * n[1] + c[1]) * n[0] + c[0]; };
  reached_.assign(static_cast<size_t>(n[0]) * n[1] * n[2], false);
  std::vector<Cell> open;
  const auto visit = [&](const Cell& c) {
    if (field.At(c[0], c[1], c[2]) < radius || reached_[index(c)]) return;
    reached_[index(c)] = true;
    ++count_;
    open.push_back(c);
  };

  // The free voxel nearest to the seed.
  Cell nearest{-1, -1, -1};
  double least = kLook;
  Cell first, last;
  for (int i = 0; i < 3; ++i) {
    first[i] = std::max(0, static_cast<int>((seed[i] - kLook - field.box().min[i]) / field.voxel()));
    last[i] = std::min(n[i] - 1, static_cast<int>((seed[i] + kLook - field.box().min[i]) / field.voxel()));
  }
  for (int z = first[2]; z <= last[2]; ++z) {
    for (int y = first[1]; y <= last[1]; ++y) {
      for (int x = first[0]; x <= last[0]; ++x) {
        const double distance = Norm(field.Center(x, y, z) - seed);
        if (distance < least && field.At(x, y, z) >= radius) {
          least = distance;
          nearest = {x, y, z};
        }
      }
    }
  }
  if (nearest[0] >= 0) visit(nearest);
  while (!open.empty()) {
    const Cell c = open.back();
    open.pop_back();
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Cell next = c;
        next[axis] += step;
        if (next[axis] >= 0 && next[axis] < n[axis]) visit(next);
      }
    }
  }
}

bool ReachableSpace::Contains(Vec3d p) const {
  if (!field_.box().Contains(p)) return false;
  size_t at = 0;
  for (int i = 2; i >= 0; --i) {
    const int c = std::min(static_cast<int>((p[i] - field_.box().min[i]) / field_.voxel()), field_.size(i) - 1);
    at = at * field_.size(i) + c;
  }
  return reached_[at];
}

}  // namespace airsim360
