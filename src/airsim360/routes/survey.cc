#include "airsim360/routes/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/routes/roadmap.h"

namespace airsim360 {
namespace {

constexpr double kFirstLayer = 2.5;  // metres, height of the lowest layer of viewpoints
constexpr double kRounding = 0.3;    // metres that rounded corners may leave the legs by, and gaps between checks

constexpr int kCandidates = 900;  // places looked at, at least

// 6 m/s in towns, slower in rooms.
double CruiseSpeed(const std::vector<Vec3d>& points) {
  double length = 0;
  for (size_t i = 0; i + 1 < points.size(); ++i) length += Norm(points[i + 1] - points[i]);
  return std::clamp(length / 150, 0.5, 6.0);
}

// Start of the tour: place 0 if it leads to half as many others as any does, else the place that leads to the most: the
// doors of the first room may be shut.
int StartPlace(const Roadmap& map) {
  const int n = static_cast<int>(map.places.size());
  std::vector<int> group(n, -1);
  int best = 0, best_size = 0, first_size = 0;
  for (int i = 0; i < n; ++i) {
    if (group[i] >= 0) continue;
    const CheapestWays ways = FindCheapestWays(map, i);
    int size = 0;
    for (int j = 0; j < n; ++j) {
      if (std::isfinite(ways.cost[j])) {
        group[j] = i;
        ++size;
      }
    }
    if (i == 0) first_size = size >= std::min(n, 8) ? size : 0;
    if (size > best_size) {
      best = i;
      best_size = size;
    }
  }
  return 2 * first_size >= best_size ? 0 : best;
}

// The start, then places that can be reached, taken in turn from layers of height that double upwards: as
// many views from the street as from above the roofs. Within a layer the places follow the low-discrepancy
// sequence, so that they spread.
std::vector<int> ChooseViewpoints(const Roadmap& map, int start, int count) {
  constexpr int kLayers = 5;
  const CheapestWays from_start = FindCheapestWays(map, start);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3d& place : map.places) lowest = std::min(lowest, place.z);
  std::array<std::vector<int>, kLayers> layers;
  for (int i = 0; i < static_cast<int>(map.places.size()); ++i) {
    if (i == start || !std::isfinite(from_start.cost[i])) continue;
    const double doublings = std::log2((map.places[i].z - lowest + kFirstLayer) / kFirstLayer);
    layers[std::min(static_cast<int>(doublings), kLayers - 1)].push_back(i);
  }
  std::vector<int> chosen = {start};
  for (size_t round = 0; round < map.places.size(); ++round) {
    for (const std::vector<int>& layer : layers) {
      if (round < layer.size() && static_cast<int>(chosen.size()) < count) chosen.push_back(layer[round]);
    }
  }
  return chosen;
}

// Order of a short open tour that starts at stop 0: nearest neighbour, then 2-opt until nothing improves.
std::vector<int> OrderTour(const std::vector<std::vector<double>>& cost) {
  const int n = static_cast<int>(cost.size());
  std::vector<int> tour = {0};
  std::vector<bool> used(n);
  used[0] = true;
  while (static_cast<int>(tour.size()) < n) {
    int next = -1;
    for (int j = 0; j < n; ++j) {
      if (!used[j] && (next < 0 || cost[tour.back()][j] < cost[tour.back()][next])) next = j;
    }
    used[next] = true;
    tour.push_back(next);
  }
  for (bool improved = true; improved;) {
    improved = false;
    for (int i = 0; i + 2 < n; ++i) {
      for (int j = i + 2; j < n; ++j) {
        const double before = cost[tour[i]][tour[i + 1]] + (j + 1 < n ? cost[tour[j]][tour[j + 1]] : 0);
        const double after = cost[tour[i]][tour[j]] + (j + 1 < n ? cost[tour[i + 1]][tour[j + 1]] : 0);
        if (after >= before - 1e-9) continue;
        std::reverse(tour.begin() + i + 1, tour.begin() + j + 1);
        improved = true;
      }
    }
  }
  return tour;
}

// Corners of the tour along the roadmap, with corners cut where the straight way is free.
std::vector<Vec3d> TourPoints(const RayTracer& tracer, const Roadmap& map, const std::vector<int>& stops, double radius) {
  std::vector<CheapestWays> ways(stops.size());
  ParallelFor(static_cast<int64_t>(stops.size()), [&](int64_t i) { ways[i] = FindCheapestWays(map, stops[i]); });
  std::vector<std::vector<double>> cost(stops.size(), std::vector<double>(stops.size()));
  for (size_t i = 0; i < stops.size(); ++i) {
    for (size_t j = 0; j < stops.size(); ++j) cost[i][j] = ways[i].cost[stops[j]];
  }
  const std::vector<int> tour = OrderTour(cost);

  std::vector<Vec3d> points = {map.places[stops[tour[0]]]};
  for (size_t k = 0; k + 1 < tour.size(); ++k) {
    const std::vector<Vec3d> way = ShortWay(tracer, map, ways[tour[k]], static_cast<size_t>(stops[tour[k + 1]]), radius);
    points.insert(points.end(), way.begin(), way.end());
  }
  return points;
}

}  // namespace

int SurveyViewpoints(int64_t frames) { return static_cast<int>(std::clamp<int64_t>(frames / 4, 40, 800)); }

Route PlanSurvey(const RayTracer& tracer, const SurveyOptions& options) {
  // Enough room for the rounded corners too; in narrow scenes less.
  const bool in_rooms = BeginsUnderACeiling(tracer.scene());
  const double most = in_rooms ? std::min(options.clearance, kClearanceInRooms) : options.clearance;
  for (double clearance = most; clearance > most / 20; clearance /= 2) {
    const double radius = clearance + kRounding * std::min(1.0, clearance);
    std::vector<Vec3d> places = FindFreePlaces(tracer, {.seed = options.seed,
                                                        .radius = radius,
                                                        .min_height = options.min_height,
                                                        .max_height = options.max_height,
                                                        .candidates = std::max(kCandidates, 4 * options.viewpoints),
                                                        .passages = options.passages});
    if (places.size() < 2) continue;
    const Roadmap map = Connect(tracer, std::move(places), radius, in_rooms ? kNeighboursInRooms : kNeighboursInTowns);
    const int start = StartPlace(map);
    const std::vector<int> stops = ChooseViewpoints(map, start, options.viewpoints);
    if (stops.size() < 2) continue;
    const std::vector<Vec3d> points = TourPoints(tracer, map, stops, radius);
    return RoundedRoute(points, {.speed = CruiseSpeed(points), .acceleration = 4, .corner = std::min(1.0, clearance)});
  }
  throw InputError("world '" + tracer.scene().name + "': no free space for a survey route; give one with --route FILE");
}

}  // namespace airsim360
