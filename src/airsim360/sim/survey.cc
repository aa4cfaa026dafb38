#include "airsim360/sim/survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

constexpr int kCandidates = 900;  // places tried
constexpr int kNeighbours = 10;   // connections tried from each free place
constexpr double kRounding =
    0.3;  // metres that rounded corners may leave the legs by, and gaps between checks
constexpr double kHighBias = 1.6;  // exponent: more viewpoints low than high

// The part of the world where things are, without a far horizon: the middle 96 % of the extents of all
// things.
Box3f Footprint(const Scene& scene) {
  std::vector<float> low[2], high[2];
  Box3f things;
  for (const Entity& entity : scene.entities) {
    if (!scene.tree[entity.category].thing || entity.bounds.empty()) continue;
    things.Add(entity.bounds);
    for (int axis = 0; axis < 2; ++axis) {
      low[axis].push_back(entity.bounds.min[axis]);
      high[axis].push_back(entity.bounds.max[axis]);
    }
  }
  if (things.empty()) return scene.bounds;
  Box3f box = things;
  for (int axis = 0; axis < 2; ++axis) {
    std::sort(low[axis].begin(), low[axis].end());
    std::sort(high[axis].begin(), high[axis].end());
    const size_t cut = low[axis].size() / 50;
    box.min[axis] = low[axis][cut];
    box.max[axis] = high[axis][high[axis].size() - 1 - cut];
  }
  box.min.z = std::min(box.min.z, scene.bounds.min.z);
  // In the open, a single small thing is looked at from around it.
  if (scene.sky_entity != kNoEntity) {
    for (int axis = 0; axis < 2; ++axis) {
      const float margin = std::max(0.0f, 12.0f - box.size()[axis]) / 2;
      box.min[axis] -= margin;
      box.max[axis] += margin;
    }
  }
  return box;
}

// Height of the ground: the lowest stuff below the footprint's middle, else its bottom.
float GroundHeight(const RayTracer& tracer, const Box3f& box) {
  const auto& spawn = tracer.scene().spawn;
  if (!spawn) return box.min.z;
  const auto hit = tracer.Intersect(*spawn, {0, 0, -1});
  return hit ? spawn->z - hit->distance : box.min.z;
}

// The k-th number of the sequence of fractional parts of k / g^axis, g the root of g^4 = g + 1 (Roberts' R3).
double LowDiscrepancy(uint64_t k, int axis, double offset) {
  constexpr double kSteps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  const double x = offset + static_cast<double>(k + 1) * kSteps[axis];
  return x - std::floor(x);
}

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

// Free places and the free straight ways between them.
struct Roadmap {
  std::vector<Vec3d> places;                              // [0] is the start
  std::vector<std::vector<std::pair<int, double>>> ways;  // (place, length)
};

std::vector<Vec3d> FreePlaces(const RayTracer& tracer, const SurveyOptions& options, double radius) {
  const Box3f box = Footprint(tracer.scene());
  const float ground = GroundHeight(tracer, box);
  const bool open = tracer.scene().sky_entity != kNoEntity;
  const double low = std::min(options.min_height, std::max(radius, 0.5 * (box.max.z - ground)));
  const double top = box.max.z - ground + (open ? 10 : 0);
  const double high = std::max(low, std::min(options.max_height, top));
  RngStream random(options.seed, "survey");
  const double offset[3] = {random.Uniform(), random.Uniform(), random.Uniform()};

  // Low-discrepancy points over footprint and height; the lower, the denser.
  std::vector<Vec3d> candidates(kCandidates);
  for (int k = 0; k < kCandidates; ++k) {
    const double u = LowDiscrepancy(k, 0, offset[0]), v = LowDiscrepancy(k, 1, offset[1]);
    const double h = std::pow(LowDiscrepancy(k, 2, offset[2]), kHighBias);
    candidates[k] = {box.min.x + u * (box.max.x - box.min.x), box.min.y + v * (box.max.y - box.min.y),
                     ground + low + h * (high - low)};
  }
  std::vector<uint8_t> free(candidates.size());
  ParallelFor(kCandidates, [&](int64_t k) {
    const Vec3f p = VecCast<float>(candidates[k]);
    free[k] =
        tracer.Clearance(p, static_cast<float>(radius + 1)) >= radius && tracer.Intersect(p, {0, 0, -1});
  });
  std::vector<Vec3d> places;
  if (const auto& spawn = tracer.scene().spawn;
      spawn && tracer.Clearance(*spawn, static_cast<float>(radius + 1)) >= radius) {
    places.push_back(VecCast<double>(*spawn));
  }
  for (int k = 0; k < kCandidates; ++k) {
    if (free[k]) places.push_back(candidates[k]);
  }
  return places;
}

// Connects each place with its nearest ones where the way between is free.
Roadmap Connect(const RayTracer& tracer, std::vector<Vec3d> places, double radius) {
  Roadmap map{std::move(places), {}};
  const int n = static_cast<int>(map.places.size());
  std::vector<std::vector<std::pair<int, double>>> tried(n);
  ParallelFor(n, [&](int64_t i) {
    std::vector<std::pair<double, int>> near;
    for (int j = 0; j < n; ++j) {
      if (j != i) near.emplace_back(Norm(map.places[j] - map.places[i]), j);
    }
    const size_t count = std::min<size_t>(kNeighbours, near.size());
    std::partial_sort(near.begin(), near.begin() + static_cast<ptrdiff_t>(count), near.end());
    for (size_t k = 0; k < count; ++k) {
      const auto [length, j] = near[k];
      if (IsFree(tracer, map.places[std::min<int>(i, j)], map.places[std::max<int>(i, j)], radius)) {
        tried[i].emplace_back(j, length);
      }
    }
  });
  map.ways.resize(n);
  for (int i = 0; i < n; ++i) {
    for (const auto& [j, length] : tried[i]) {
      map.ways[i].emplace_back(j, length);
      map.ways[j].emplace_back(i, length);
    }
  }
  return map;
}

// Shortest ways from one place to all (Dijkstra).
struct ShortestWays {
  std::vector<double> length;  // infinite where there is none
  std::vector<int> previous;
};

ShortestWays FindShortestWays(const Roadmap& map, int from) {
  ShortestWays ways{std::vector<double>(map.places.size(), std::numeric_limits<double>::infinity()),
                    std::vector<int>(map.places.size(), -1)};
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  ways.length[from] = 0;
  open.emplace(0, from);
  while (!open.empty()) {
    const auto [length, i] = open.top();
    open.pop();
    if (length > ways.length[i]) continue;
    for (const auto& [j, step] : map.ways[i]) {
      if (length + step >= ways.length[j]) continue;
      ways.length[j] = length + step;
      ways.previous[j] = i;
      open.emplace(length + step, j);
    }
  }
  return ways;
}

// Start of the tour: place 0 if it leads anywhere, else the place that leads to the most others.
int StartPlace(const Roadmap& map) {
  const int n = static_cast<int>(map.places.size());
  std::vector<int> group(n, -1);
  int best = 0, best_size = 0;
  for (int i = 0; i < n; ++i) {
    if (group[i] >= 0) continue;
    const ShortestWays ways = FindShortestWays(map, i);
    int size = 0;
    for (int j = 0; j < n; ++j) {
      if (std::isfinite(ways.length[j])) {
        group[j] = i;
        ++size;
      }
    }
    if (i == 0 && size >= std::min(n, 8)) return 0;
    if (size > best_size) {
      best = i;
      best_size = size;
    }
  }
  return best;
}

// Places far from each other (farthest-point sampling, with height counted more than ground distance), the
// start first.
std::vector<int> SpreadViewpoints(const Roadmap& map, const ShortestWays& from_start, int start, int count) {
  constexpr double kHeightWeight = 2;
  std::vector<int> chosen = {start};
  std::vector<double> distance(map.places.size(), std::numeric_limits<double>::infinity());
  while (static_cast<int>(chosen.size()) < count) {
    int farthest = -1;
    for (size_t i = 0; i < map.places.size(); ++i) {
      const Vec3d d = map.places[i] - map.places[chosen.back()];
      distance[i] = std::min(distance[i], std::hypot(d.x, d.y, kHeightWeight * d.z));
      const bool reachable = std::isfinite(from_start.length[i]);
      if (reachable && distance[i] > 0 && (farthest < 0 || distance[i] > distance[farthest]))
        farthest = static_cast<int>(i);
    }
    if (farthest < 0) break;
    chosen.push_back(farthest);
  }
  return chosen;
}

// Order of a short open tour that starts at stop 0: nearest neighbour, then 2-opt until nothing improves.
std::vector<int> OrderTour(const std::vector<std::vector<double>>& length) {
  const int n = static_cast<int>(length.size());
  std::vector<int> tour = {0};
  std::vector<bool> used(n);
  used[0] = true;
  while (static_cast<int>(tour.size()) < n) {
    int next = -1;
    for (int j = 0; j < n; ++j) {
      if (!used[j] && (next < 0 || length[tour.back()][j] < length[tour.back()][next])) next = j;
    }
    used[next] = true;
    tour.push_back(next);
  }
  for (bool improved = true; improved;) {
    improved = false;
    for (int i = 0; i + 2 < n; ++i) {
      for (int j = i + 2; j < n; ++j) {
        const double before = length[tour[i]][tour[i + 1]] + (j + 1 < n ? length[tour[j]][tour[j + 1]] : 0);
        const double after = length[tour[i]][tour[j]] + (j + 1 < n ? length[tour[i + 1]][tour[j + 1]] : 0);
        if (after >= before - 1e-9) continue;
        std::reverse(tour.begin() + i + 1, tour.begin() + j + 1);
        improved = true;
      }
    }
  }
  return tour;
}

// Corners of the tour along the roadmap, with corners cut where the straight way is free.
std::vector<Vec3d> TourPoints(const RayTracer& tracer, const Roadmap& map, const std::vector<int>& stops,
                              double radius) {
  std::vector<ShortestWays> ways(stops.size());
  ParallelFor(static_cast<int64_t>(stops.size()),
              [&](int64_t i) { ways[i] = FindShortestWays(map, stops[i]); });
  std::vector<std::vector<double>> length(stops.size(), std::vector<double>(stops.size()));
  for (size_t i = 0; i < stops.size(); ++i) {
    for (size_t j = 0; j < stops.size(); ++j) length[i][j] = ways[i].length[stops[j]];
  }
  const std::vector<int> tour = OrderTour(length);

  std::vector<Vec3d> points = {map.places[stops[tour[0]]]};
  for (size_t k = 0; k + 1 < tour.size(); ++k) {
    std::vector<Vec3d> way;
    for (int place = stops[tour[k + 1]]; place >= 0; place = ways[tour[k]].previous[place])
      way.push_back(map.places[place]);
    std::reverse(way.begin(), way.end());
    for (size_t i = 0; i + 1 < way.size();) {
      size_t j = way.size() - 1;
      while (j > i + 1 && !IsFree(tracer, way[i], way[j], radius)) --j;
      points.push_back(way[j]);
      i = j;
    }
  }
  return points;
}

}  // namespace

Route PlanSurvey(const RayTracer& tracer, const SurveyOptions& options) {
  // Enough room for the rounded corners too; in narrow scenes less.
  for (double clearance = options.clearance; clearance > options.clearance / 20; clearance /= 2) {
    const double rounding = kRounding * std::min(1.0, clearance);
    std::vector<Vec3d> places = FreePlaces(tracer, options, clearance + rounding);
    if (places.size() < 2) continue;
    const Roadmap map = Connect(tracer, std::move(places), clearance + rounding);
    const int start = StartPlace(map);
    const std::vector<int> stops =
        SpreadViewpoints(map, FindShortestWays(map, start), start, options.viewpoints);
    if (stops.size() < 2) continue;
    const std::vector<Vec3d> points = TourPoints(tracer, map, stops, clearance + rounding);
    const double size = Norm(Footprint(tracer.scene()).size());
    return RoundedRoute(
        points,
        {.speed = std::clamp(size / 40.0, 0.5, 6.0), .acceleration = 4, .corner = std::min(1.0, clearance)});
  }
  throw InputError("world '" + tracer.scene().name +
                   "': no free space for a survey route; give one with --route FILE");
}

}  // namespace airsim360
