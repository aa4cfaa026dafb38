#include "airsim360/routes/road_route.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/routes/world_clearance.h"
#include "airsim360/trace/surface_entity.h"

namespace airsim360 {
namespace {

constexpr double kRoadCell = 2;  // metres
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Cells of the ground that are road seen from above, and how far each is from the edge of the road.
struct RoadGrid {
  Vec2d corner;
  int nx = 0, ny = 0;
  std::vector<float> height;  // of the road
  std::vector<float> inside;  // cells to the nearest one that is no road; 0 = no road

  Vec3d At(int cell, double above) const {
    return {corner.x + (cell % nx + 0.5) * kRoadCell, corner.y + (cell / nx + 0.5) * kRoadCell, height[cell] + above};
  }
  template <class Visit>
  void ForNeighbours(int cell, const Visit& visit) const {
    const int x = cell % nx, y = cell / nx;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if ((dx || dy) && x + dx >= 0 && x + dx < nx && y + dy >= 0 && y + dy < ny)
          visit((y + dy) * nx + x + dx, dx && dy ? std::sqrt(2.0) : 1.0);
      }
    }
  }
};

RoadGrid FindRoads(const RayTracer& tracer) {
  const Scene& scene = tracer.scene();
  std::vector<bool> is_road(scene.entities.size() + 1);
  for (const Entity& entity : scene.entities) {
    // What cars drive on, paint and lids in it included.
    const std::string& path = scene.tree[entity.category].path;
    for (const char* kind :
         {"ground/road", "ground/crosswalk", "ground/lane_marking", "ground/manhole", "ground/bike_lane", "ground/parking"})
      is_road[entity.id] = is_road[entity.id] || path.starts_with(kind);
  }
  const Box3d box = FlightBox(tracer);
  RoadGrid grid;
  grid.corner = {box.min.x, box.min.y};
  grid.nx = std::max(1, static_cast<int>((box.max.x - box.min.x) / kRoadCell));
  grid.ny = std::max(1, static_cast<int>((box.max.y - box.min.y) / kRoadCell));
  grid.height.assign(static_cast<size_t>(grid.nx) * grid.ny, 0);
  grid.inside.assign(grid.height.size(), 0);
  ParallelFor(grid.ny, [&](int64_t y) {
    for (int x = 0; x < grid.nx; ++x) {
      const size_t cell = static_cast<size_t>(y) * grid.nx + x;
      const Vec3d from = grid.At(static_cast<int>(cell), box.max.z);
      const auto hit = tracer.Intersect(VecCast<float>(from), {0, 0, -1});
      if (!hit || !is_road[EntityAt(scene, hit->surface)]) continue;
      grid.height[cell] = static_cast<float>(from.z - hit->distance);
      grid.inside[cell] = 1;
    }
  });
  // Distance to the edge of the road, ring by ring.
  std::queue<int> open;
  for (int cell = 0; cell < static_cast<int>(grid.inside.size()); ++cell) {
    bool edge = false;
    if (grid.inside[cell] == 0) continue;
    grid.ForNeighbours(cell, [&](int next, double) { edge |= grid.inside[next] == 0; });
    if (edge) open.push(cell);
    grid.inside[cell] = edge ? 1 : 1e6f;
  }
  while (!open.empty()) {
    const int cell = open.front();
    open.pop();
    grid.ForNeighbours(cell, [&](int next, double) {
      if (grid.inside[next] > grid.inside[cell] + 1) {
        grid.inside[next] = grid.inside[cell] + 1;
        open.push(next);
      }
    });
  }
  return grid;
}

struct Ways {
  std::vector<double> cost;
  std::vector<int> previous;
  int farthest;
};

// Cheapest ways along the road; the edge costs more than the middle.
Ways FindWays(const RoadGrid& grid, int from) {
  Ways ways{std::vector<double>(grid.inside.size(), kInfinity), std::vector<int>(grid.inside.size(), -1), from};
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  ways.cost[from] = 0;
  open.emplace(0, from);
  while (!open.empty()) {
    const double cost = open.top().first;
    const int cell = open.top().second;
    open.pop();
    if (cost > ways.cost[cell]) continue;
    ways.farthest = cell;
    grid.ForNeighbours(cell, [&](int next, double step) {
      if (grid.inside[next] == 0) return;
      const double to = cost + step * (1 + 4 / grid.inside[next]);
      if (to >= ways.cost[next]) return;
      ways.cost[next] = to;
      ways.previous[next] = cell;
      open.emplace(to, next);
    });
  }
  return ways;
}

// Douglas-Peucker: drops points nearer than `tolerance` to the chord of those kept.
void Simplify(const std::vector<Vec3d>& way, size_t first, size_t last, double tolerance, std::vector<Vec3d>& out) {
  const Vec3d u = Normalized(way[last] - way[first]);
  double farthest = 0;
  size_t at = first;
  for (size_t i = first + 1; i < last; ++i) {
    const double distance = Norm(Cross(way[i] - way[first], u));
    if (distance > farthest) {
      farthest = distance;
      at = i;
    }
  }
  if (farthest > tolerance) {
    Simplify(way, first, at, tolerance, out);
    Simplify(way, at, last, tolerance, out);
    return;
  }
  out.push_back(way[last]);
}

}  // namespace

std::vector<Vec3d> RoadRoute(const RayTracer& tracer, const RoadRouteOptions& options) {
  const RoadGrid grid = FindRoads(tracer);
  // The largest network, from one of its far ends.
  std::vector<bool> seen(grid.inside.size());
  int start = -1;
  int64_t largest = 0;
  for (int cell = 0; cell < static_cast<int>(seen.size()); ++cell) {
    if (seen[cell] || grid.inside[cell] == 0) continue;
    const Ways ways = FindWays(grid, cell);
    int64_t size = 0;
    for (int other = cell; other < static_cast<int>(seen.size()); ++other) {
      if (ways.cost[other] == kInfinity) continue;
      seen[other] = true;
      ++size;
    }
    if (size > largest) {
      largest = size;
      start = ways.farthest;
    }
  }
  if (start < 0) throw InputError("world '" + tracer.scene().name + "' has no road to follow");
  const Ways ways = FindWays(grid, start);
  std::vector<Vec3d> way;
  for (int cell = ways.farthest; cell >= 0; cell = ways.previous[cell]) way.push_back(grid.At(cell, options.height));
  if (way.size() < 2) throw InputError("world '" + tracer.scene().name + "' has no road to follow");
  std::vector<Vec3d> out = {way.front()};
  Simplify(way, 0, way.size() - 1, options.corner, out);
  return out;
}

}  // namespace airsim360
