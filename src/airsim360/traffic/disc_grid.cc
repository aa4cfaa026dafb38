#include "airsim360/traffic/disc_grid.h"

#include <algorithm>
#include <cmath>

namespace airsim360 {
namespace {

constexpr double kCell = 4;  // metres

int64_t CellOf(double x) { return static_cast<int64_t>(std::floor(x / kCell)); }

uint64_t KeyOf(int64_t i, int64_t j) { return (static_cast<uint64_t>(i) << 32) ^ (static_cast<uint64_t>(j) & 0xffffffffu); }

bool IsPlace(Vec3d p) { return std::abs(p.x) < 1e7 && std::abs(p.y) < 1e7 && std::abs(p.z) < 1e7; }

}  // namespace

void DiscGrid::Add(Vec3d p, double radius) {
  if (!IsPlace(p)) return;
  discs_.push_back({KeyOf(CellOf(p.x), CellOf(p.y)), p, radius});
  widest_ = std::max(widest_, radius);
}

void DiscGrid::Sort() { std::ranges::stable_sort(discs_, {}, &Disc::cell); }

bool DiscGrid::Meets(Vec3d p, double reach, double height) const {
  const auto ring = static_cast<int64_t>(std::ceil((reach + widest_) / kCell));
  for (int64_t i = CellOf(p.x) - ring; i <= CellOf(p.x) + ring; ++i) {
    for (int64_t j = CellOf(p.y) - ring; j <= CellOf(p.y) + ring; ++j) {
      const auto there = std::ranges::equal_range(discs_, KeyOf(i, j), {}, &Disc::cell);
      for (const Disc& disc : there)
        if (std::hypot(disc.p.x - p.x, disc.p.y - p.y) < reach + disc.radius && std::abs(disc.p.z - p.z) < height) return true;
    }
  }
  return false;
}

}  // namespace airsim360
