#include "airsim360/planning/routes/reachable.h"

#include <algorithm>
#include <utility>

namespace airsim360 {
namespace {

constexpr double kLook = 5;  // metres around the seed

}  // namespace

ReachableSpace::ReachableSpace(const ClearanceField& field, Vec3d seed, double radius) : field_(field) {
  const int n[3] = {field.size(0), field.size(1), field.size(2)};
  reached_.assign(static_cast<size_t>(n[0]) * n[1] * n[2], 0);
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
  if (nearest[0] >= 0) Fill(nearest, radius);
}

// Fills run by run along x: a row lies together in memory, and a voxel is looked at once from each of the four rows beside its own.
void ReachableSpace::Fill(Cell first, double radius) {
  const int nx = field_.size(0);
  const auto row_of = [&](int y, int z) { return (static_cast<size_t>(z) * field_.size(1) + y) * nx; };
  const auto is_open = [&](int x, int y, int z) { return reached_[row_of(y, z) + x] == 0 && field_.At(x, y, z) >= radius; };
  std::vector<Cell> open = {first};
  while (!open.empty()) {
    const auto [x, y, z] = open.back();
    open.pop_back();
    if (!is_open(x, y, z)) continue;
    int from = x, to = x + 1;
    while (from > 0 && is_open(from - 1, y, z)) --from;
    while (to < nx && is_open(to, y, z)) ++to;
    const size_t row = row_of(y, z);
    std::fill(reached_.begin() + row + from, reached_.begin() + row + to, 1);
    count_ += to - from;
    for (const auto& [dy, dz] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      if (y + dy < 0 || y + dy >= field_.size(1) || z + dz < 0 || z + dz >= field_.size(2)) continue;
      // The first voxel of every run that touches this one.
      for (int i = from; i < to; ++i)
        if (is_open(i, y + dy, z + dz) && (i == from || !is_open(i - 1, y + dy, z + dz))) open.push_back({i, y + dy, z + dz});
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
  return reached_[at] != 0;
}

}  // namespace airsim360
