#include "airsim360/routes/roadmap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "airsim360/base/parallel.h"

namespace airsim360 {
namespace {

constexpr double kCostlyHeight = 15;  // metres at which flying costs twice what it costs at the lowest place

}  // namespace

// True if a ball of `radius` can move along the segment: steps by the free distance of each centre, at least
// a tenth of a metre.
bool IsFree(const RayTracer& tracer, Vec3d a, Vec3d b, double radius) {
  const double length = Norm(b - a);
  const Vec3d u = Normalized(b - a);
  const double reach = radius + 8;
  for (double s = 0;;) {
    const double free = tracer.Clearance(VecCast<float>(a + u * s), static_cast<float>(reach));
    if (free < radius) return false;
    if (s >= length) return !tracer.Occluded(VecCast<float>(a), VecCast<float>(b));
    s = std::min(length, s + std::max(0.1, free - radius));
  }
}

// Connects each place with its nearest ones where the way between is free.
Roadmap Connect(const RayTracer& tracer, std::vector<Vec3d> places, double radius, int neighbours) {
  Roadmap map{std::move(places), {}};
  const int n = static_cast<int>(map.places.size());
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3d& place : map.places) lowest = std::min(lowest, place.z);
  std::vector<std::vector<std::pair<int, double>>> tried(n);
  ParallelFor(n, [&](int64_t i) {
    std::vector<std::pair<double, int>> near;
    for (int j = 0; j < n; ++j) {
      if (j != i) near.emplace_back(Norm(map.places[j] - map.places[i]), j);
    }
    const size_t count = std::min<size_t>(static_cast<size_t>(neighbours), near.size());
    std::partial_sort(near.begin(), near.begin() + static_cast<ptrdiff_t>(count), near.end());
    for (size_t k = 0; k < count; ++k) {
      const auto [length, j] = near[k];
      if (IsFree(tracer, map.places[std::min<int>(i, j)], map.places[std::max<int>(i, j)], radius)) {
        const double height = 0.5 * (map.places[i].z + map.places[j].z) - lowest;
        tried[i].emplace_back(j, length * (1 + height / kCostlyHeight));
      }
    }
  });
  map.ways.resize(n);
  for (int i = 0; i < n; ++i) {
    for (const auto& [j, cost] : tried[i]) {
      map.ways[i].emplace_back(j, cost);
      map.ways[j].emplace_back(i, cost);
    }
  }
  return map;
}

CheapestWays FindCheapestWays(const Roadmap& map, int from) {
  CheapestWays ways{std::vector<double>(map.places.size(), std::numeric_limits<double>::infinity()),
                    std::vector<int>(map.places.size(), -1)};
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  ways.cost[from] = 0;
  open.emplace(0, from);
  while (!open.empty()) {
    const auto [cost, i] = open.top();
    open.pop();
    if (cost > ways.cost[i]) continue;
    for (const auto& [j, step] : map.ways[i]) {
      if (cost + step >= ways.cost[j]) continue;
      ways.cost[j] = cost + step;
      ways.previous[j] = i;
      open.emplace(cost + step, j);
    }
  }
  return ways;
}

std::vector<Vec3d> ShortWay(const RayTracer& tracer, const Roadmap& map, const CheapestWays& ways, size_t to, double radius) {
  std::vector<Vec3d> way, points;
  for (int place = static_cast<int>(to); place >= 0; place = ways.previous[static_cast<size_t>(place)])
    way.push_back(map.places[static_cast<size_t>(place)]);
  std::ranges::reverse(way);
  for (size_t i = 0; i + 1 < way.size();) {
    size_t j = way.size() - 1;
    while (j > i + 1 && !IsFree(tracer, way[i], way[j], radius)) --j;
    points.push_back(way[j]);
    i = j;
  }
  return points;
}

}  // namespace airsim360
