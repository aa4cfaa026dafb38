#include "airsim360/people/crowd/placement.h"

#include <cmath>

#include "airsim360/people/crowd/steering.h"

namespace airsim360::internal {

uint64_t Placement::CellOf(double x, double y) const {
  const auto u = static_cast<uint64_t>(static_cast<int64_t>(std::floor(x)) + (int64_t{1} << 31));
  const auto v = static_cast<uint64_t>(static_cast<int64_t>(std::floor(y)) + (int64_t{1} << 31));
  return u << 32 | v;
}

bool Placement::IsFree(const NavPoint& point, double distance) const {
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      const auto cell = taken_.find(CellOf(point.p_W.x + dx, point.p_W.y + dy));
      if (cell == taken_.end()) continue;
      for (const Vec3d& other : cell->second)
        if (std::hypot(other.x - point.p_W.x, other.y - point.p_W.y) < distance && std::abs(other.z - point.p_W.z) < 1.6) return false;
    }
  }
  return true;
}

bool Placement::Take(const NavPoint& point) {
  if (!IsFree(point, 2 * kBodyRadius)) return false;
  taken_[CellOf(point.p_W.x, point.p_W.y)].push_back(point.p_W);
  return true;
}

void Placement::Leave(const NavPoint& point) {
  if (const auto cell = taken_.find(CellOf(point.p_W.x, point.p_W.y)); cell != taken_.end()) std::erase(cell->second, point.p_W);
}

std::vector<NavPoint> Placement::Fill(const NavArea& area, size_t count, uint64_t stream) {
  RngStream rng(seed_, "places of people", stream);
  std::vector<NavPoint> points;
  // Closer and closer, each distance until it fails often.
  for (double distance = 0.95; distance > 0.46 && points.size() < count; distance *= 0.85) {
    for (int misses = 0; misses < 400 && points.size() < count;) {
      const NavPoint point = mesh_.Pick(area, rng);
      if (!point.valid() || !IsFree(point, distance)) {
        ++misses;
        continue;
      }
      Take(point);
      points.push_back(point);
    }
  }
  return points;
}

NavPoint Placement::AnyHeight(Vec3d p, double reach) const {
  for (double z = mesh_.bounds().max.z; z > mesh_.bounds().min.z - 2; z -= 2) {
    const NavPoint point = mesh_.Nearest({p.x, p.y, z}, reach);
    if (point.valid()) return point;
  }
  return {};
}

}  // namespace airsim360::internal
