// Where a survey may look from.
#include <algorithm>
#include <cmath>
#include <map>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/sim/roadmap.h"

namespace airsim360 {
namespace {

constexpr double kCell = 12;           // metres
constexpr float kEverydaySize = 25;    // metres: longest extent of things that tell where the world is
constexpr double kHeldByCells = 0.85;  // part of the things that the cells looked at hold
constexpr double kLowBias = 3;         // exponent of the height: more places near the ground

// South-west corners of the ground cells that hold things of everyday size, in order.
std::vector<Vec2d> OccupiedCells(const Scene& scene) {
  std::map<std::pair<int, int>, int> count;
  for (const Entity& entity : scene.entities) {
    const Vec3f size = entity.bounds.size();
    if (!scene.tree[entity.category].thing || entity.bounds.empty() ||
        std::max({size.x, size.y, size.z}) > kEverydaySize)
      continue;
    const Vec3f center = entity.bounds.center();
    ++count[{static_cast<int>(std::floor(center.x / kCell)), static_cast<int>(std::floor(center.y / kCell))}];
  }
  // The densest cells, which together hold most of the things: what is scattered far away is not the world.
  std::vector<int> counts;
  int64_t total = 0, held = 0;
  for (const auto& [cell, things] : count) {
    counts.push_back(things);
    total += things;
  }
  std::sort(counts.rbegin(), counts.rend());
  int least = 0;
  for (size_t i = 0;
       i < counts.size() && static_cast<double>(held) < kHeldByCells * static_cast<double>(total); ++i) {
    least = counts[i];
    held += least;
  }
  std::vector<Vec2d> cells;
  for (const auto& [cell, things] : count) {
    if (things >= least) cells.push_back({cell.first * kCell, cell.second * kCell});
  }
  return cells;
}

// Height of the ground: below the spawn, else the bottom of the scene.
double GroundHeight(const RayTracer& tracer) {
  const Scene& scene = tracer.scene();
  if (!scene.spawn) return scene.bounds.min.z;
  const auto hit = tracer.Intersect(*scene.spawn, {0, 0, -1});
  return hit ? scene.spawn->z - hit->distance : scene.bounds.min.z;
}

// The k-th number of the sequence of fractional parts of k / g^axis, g the root of g^4 = g + 1 (Roberts' R3).
double LowDiscrepancy(uint64_t k, int axis, double offset) {
  constexpr double kSteps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  const double x = offset + static_cast<double>(k + 1) * kSteps[axis];
  return x - std::floor(x);
}

// Candidates: low-discrepancy points over cells, places in a cell and heights.
std::vector<Vec3d> Candidates(const RayTracer& tracer, const PlaceOptions& options) {
  const Scene& scene = tracer.scene();
  const Box3f bounds = scene.bounds;
  const bool open = scene.sky_entity != kNoEntity;
  const double ground = GroundHeight(tracer);
  const double top = bounds.max.z - ground + (open ? 10 : 0);
  const double low = std::min(options.min_height, std::max(options.radius, top / 2));
  const double high = std::max(low, std::min(options.max_height, top));
  const std::vector<Vec2d> cells = OccupiedCells(scene);
  RngStream random(options.seed, "survey");
  const double offset[3] = {random.Uniform(), random.Uniform(), random.Uniform()};

  std::vector<Vec3d> candidates;
  for (int k = 0; k < options.candidates; ++k) {
    const double u = LowDiscrepancy(k, 0, offset[0]), v = LowDiscrepancy(k, 1, offset[1]);
    const double height = low + std::pow(LowDiscrepancy(k, 2, offset[2]), kLowBias) * (high - low);
    if (cells.empty()) {
      const Vec3f size = bounds.size();
      candidates.push_back({bounds.min.x + u * size.x, bounds.min.y + v * size.y, ground + height});
      continue;
    }
    const double cell = u * static_cast<double>(cells.size());
    const Vec2d corner = cells[static_cast<size_t>(cell)];
    candidates.push_back(
        {corner.x + (cell - std::floor(cell)) * kCell, corner.y + v * kCell, ground + height});
  }
  return candidates;
}

}  // namespace

std::vector<Vec3d> FindFreePlaces(const RayTracer& tracer, const PlaceOptions& options) {
  const std::vector<Vec3d> candidates = Candidates(tracer, options);
  const auto is_free = [&](Vec3f p) {
    return tracer.Clearance(p, static_cast<float>(options.radius + 1)) >= options.radius;
  };
  std::vector<uint8_t> free(candidates.size());
  ParallelFor(static_cast<int64_t>(candidates.size()), [&](int64_t k) {
    const Vec3f p = VecCast<float>(candidates[static_cast<size_t>(k)]);
    free[static_cast<size_t>(k)] = is_free(p) && tracer.Intersect(p, {0, 0, -1});
  });
  std::vector<Vec3d> places;
  if (const auto& spawn = tracer.scene().spawn; spawn && is_free(*spawn))
    places.push_back(VecCast<double>(*spawn));
  for (size_t k = 0; k < candidates.size(); ++k) {
    if (free[k]) places.push_back(candidates[k]);
  }
  return places;
}

}  // namespace airsim360
