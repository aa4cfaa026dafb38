// Where a survey may look from.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/routes/roadmap.h"
#include "airsim360/trace/surface_entity.h"
#include "airsim360/trace/whereabouts.h"

namespace airsim360 {
namespace {

constexpr double kFreeCell = 12;       // metres
constexpr float kEverydaySize = 25;    // metres: longest extent of things that tell where the world is
constexpr double kHeldByCells = 0.85;  // part of the things that the cells looked at hold
constexpr double kLowBias = 3;         // exponent of the height: more places near the ground
constexpr const char* kCeiling = "construction/ceiling";
constexpr int kMostBelowCeiling = 40;  // surfaces of lamps and furniture above a floor

// South-west corners of the ground cells that hold things of everyday size, in order.
std::vector<Vec2d> OccupiedCells(const Scene& scene) {
  std::map<std::pair<int, int>, int> count;
  for (const Entity& entity : scene.entities) {
    const Vec3f size = entity.bounds.size();
    if (!scene.tree[entity.category].thing || entity.bounds.empty() || std::max({size.x, size.y, size.z}) > kEverydaySize) continue;
    const Vec3f center = entity.bounds.center();
    ++count[{static_cast<int>(std::floor(center.x / kFreeCell)), static_cast<int>(std::floor(center.y / kFreeCell))}];
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
  for (size_t i = 0; i < counts.size() && static_cast<double>(held) < kHeldByCells * static_cast<double>(total); ++i) {
    least = counts[i];
    held += least;
  }
  std::vector<Vec2d> cells;
  for (const auto& [cell, things] : count) {
    if (things >= least) cells.push_back({cell.first * kFreeCell, cell.second * kFreeCell});
  }
  return cells;
}

bool IsA(const Scene& scene, EntityId entity, const char* category) {
  return entity != kNoEntity && scene.tree[scene.entity(entity).category].path.starts_with(category);
}

bool IsOver(const Box3f& box, Vec3f p) {
  return box.min.x <= p.x && p.x <= box.max.x && box.min.y <= p.y && p.y <= box.max.y && p.z < box.max.z;
}

// Ceilings of a building that stands in the open and is entered at its first viewpoint; none of other scenes.
std::vector<Box3f> RoomsCeilings(const Scene& scene) {
  if (scene.sky_entity == kNoEntity || !scene.spawn) return {};
  std::vector<Box3f> ceilings;
  bool entered = false;
  for (const Entity& entity : scene.entities) {
    const Box3f& box = entity.bounds;
    if (box.empty() || !IsA(scene, entity.id, kCeiling)) continue;
    ceilings.push_back(box);
    entered |= IsOver(box, *scene.spawn);
  }
  return entered ? ceilings : std::vector<Box3f>();
}

double LevelArea(const Box3f& box) { return static_cast<double>(box.size().x) * box.size().y; }

// Height of the ground: below the spawn, else the bottom of the scene.
double GroundHeight(const RayTracer& tracer) {
  const Scene& scene = tracer.scene();
  if (!scene.spawn) return scene.bounds.min.z;
  const auto hit = tracer.Intersect(*scene.spawn, {0, 0, -1});
  return hit ? scene.spawn->z - hit->distance : scene.bounds.min.z;
}

}  // namespace

// Fractional parts of k / g^axis, g the root of g^4 = g + 1 (Roberts' R3).
double LowDiscrepancy(uint64_t k, int axis, double offset) {
  constexpr double kSteps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  const double x = offset + static_cast<double>(k + 1) * kSteps[axis];
  return x - std::floor(x);
}

bool BeginsUnderACeiling(const Scene& scene) { return !RoomsCeilings(scene).empty(); }

SurveyedGround FindSurveyedGround(const Scene& scene) {
  constexpr size_t kFewestCells = 16;
  SurveyedGround ground{OccupiedCells(scene), scene.bounds, RoomsCeilings(scene)};
  if (ground.cells.size() >= kFewestCells) return ground;
  ground.cells.clear();
  if (scene.sky_entity == kNoEntity) return ground;
  // A single model in the open is looked at from around it.
  const Vec3f size = scene.bounds.size();
  const float margin = std::clamp(std::max(size.x, size.y) / 2, 6.0f, 60.0f);
  ground.box.min -= Vec3f{margin, margin, 0};
  ground.box.max += Vec3f{margin, margin, 0};
  return ground;
}

std::optional<RoomSpot> SurveyedGround::InRoom(const RayTracer& tracer, double u, double v) const {
  double all = 0;
  for (const Box3f& ceiling : ceilings) all += LevelArea(ceiling);
  double left = u * all;
  size_t k = 0;
  while (k + 1 < ceilings.size() && left >= LevelArea(ceilings[k])) left -= LevelArea(ceilings[k++]);
  const Box3f& ceiling = ceilings[k];
  const Vec2d at{ceiling.min.x + ceiling.size().x * std::clamp(left / std::max(1e-9, LevelArea(ceiling)), 0.0, 1.0),
                 ceiling.min.y + ceiling.size().y * v};
  constexpr float kStep = 0.01f;  // metres past a surface
  Vec3f from{static_cast<float>(at.x), static_cast<float>(at.y), ceiling.min.z - kStep};
  for (int i = 0; i < kMostBelowCeiling; ++i) {
    const auto hit = tracer.Intersect(from, {0, 0, -1});
    if (!hit) return std::nullopt;
    from.z -= hit->distance;
    const EntityId entity = EntityAt(tracer.scene(), hit->surface);
    if (IsA(tracer.scene(), entity, kCeiling)) return std::nullopt;
    if (IsA(tracer.scene(), entity, "ground")) return RoomSpot{at, from.z, ceiling.min.z};
    from.z -= kStep;
  }
  return std::nullopt;
}

bool SurveyedGround::IsInRoom(const RayTracer& tracer, Vec3d p) const {
  const Vec3f at = VecCast<float>(p);
  return std::ranges::any_of(ceilings, [&](const Box3f& box) { return IsOver(box, at); }) && tracer.Intersect(at, {0, 0, 1});
}

Vec2d SurveyedGround::At(double u, double v) const {
  if (cells.empty()) {
    const Vec3f size = box.size();
    return {box.min.x + u * size.x, box.min.y + v * size.y};
  }
  const double cell = u * static_cast<double>(cells.size());
  const Vec2d corner = cells[static_cast<size_t>(cell)];
  return {corner.x + (cell - std::floor(cell)) * kFreeCell, corner.y + v * kFreeCell};
}

namespace {

// Candidates: low-discrepancy points over the ground and heights.
std::vector<Vec3d> Candidates(const RayTracer& tracer, const SurveyedGround& ground, const PlaceOptions& options) {
  const bool open = tracer.scene().sky_entity != kNoEntity;
  const double ground_z = GroundHeight(tracer);
  RngStream random(options.seed, "survey");
  const double offset[3] = {random.Uniform(), random.Uniform(), random.Uniform()};
  const auto height = [&](int k, double bottom, double top) {
    const double low = std::min(options.min_height, std::max(options.radius, top / 2));
    const double high = std::max(low, std::min(options.max_height, top));
    return bottom + low + std::pow(LowDiscrepancy(k, 2, offset[2]), kLowBias) * (high - low);
  };
  std::vector<Vec3d> candidates;
  for (int k = 0; k < options.candidates; ++k) {
    const double u = LowDiscrepancy(k, 0, offset[0]), v = LowDiscrepancy(k, 1, offset[1]);
    if (ground.in_rooms()) {
      const auto spot = ground.InRoom(tracer, u, v);
      if (spot) candidates.push_back({spot->at.x, spot->at.y, height(k, spot->floor, spot->ceiling - spot->floor)});
    } else {
      const Vec2d at = ground.At(u, v);
      candidates.push_back({at.x, at.y, height(k, ground_z, ground.box.max.z - ground_z + (open ? 10 : 0))});
    }
  }
  candidates.insert(candidates.end(), options.passages.begin(), options.passages.end());
  return candidates;
}

}  // namespace

Box2d InhabitedGround(const Scene& scene) {
  const SurveyedGround ground = FindSurveyedGround(scene);
  Box2d box{{ground.box.min.x, ground.box.min.y}, {ground.box.max.x, ground.box.max.y}};
  if (ground.cells.empty()) return box;
  box = {ground.cells.front(), ground.cells.front()};
  for (const Vec2d corner : ground.cells) {
    box.min = {std::min(box.min.x, corner.x), std::min(box.min.y, corner.y)};
    box.max = {std::max(box.max.x, corner.x + kFreeCell), std::max(box.max.y, corner.y + kFreeCell)};
  }
  return box;
}

std::string PlaceFault(const RayTracer& tracer, Vec3d p_W, double clearance) {
  constexpr double kSky = 1e4;  // metres
  const Box3f box = FindSurveyedGround(tracer.scene()).box;
  for (int i = 0; i < 3; ++i) {
    if (!(p_W[i] >= box.min[i] && p_W[i] <= (i == 2 ? kSky : box.max[i]))) return "is outside the world";
  }
  // A model with holes, or turned inside out, looks so from where it is entered too.
  const Scene& scene = tracer.scene();
  const Vec3d entrance = VecCast<double>(scene.spawn.value_or(scene.bounds.center()));
  const Whereabouts::Kind kind = FindWhereabouts(tracer, p_W).kind;
  if (kind != Whereabouts::Kind::kOpen && kind != FindWhereabouts(tracer, entrance).kind)
    return kind == Whereabouts::Kind::kOutside ? "is outside the world" : "is inside of something solid, or below the ground";
  const double free = tracer.Clearance(VecCast<float>(p_W), static_cast<float>(2 * clearance));
  if (free >= clearance) return {};
  char text[80];
  std::snprintf(text, sizeof text, "is %.3g m from a surface, less than %.3g m", free, clearance);
  return text;
}

std::vector<Vec3d> FindFreePlaces(const RayTracer& tracer, const PlaceOptions& options) {
  const SurveyedGround ground = FindSurveyedGround(tracer.scene());
  const std::vector<Vec3d> candidates = Candidates(tracer, ground, options);
  const auto is_free = [&](Vec3f p) { return tracer.Clearance(p, static_cast<float>(options.radius + 1)) >= options.radius; };
  std::vector<uint8_t> free(candidates.size());
  ParallelFor(static_cast<int64_t>(candidates.size()), [&](int64_t k) {
    const Vec3f p = VecCast<float>(candidates[static_cast<size_t>(k)]);
    const bool may_float = ground.cells.empty();  // towns have ground everywhere; models may have none
    free[static_cast<size_t>(k)] = is_free(p) && (may_float || tracer.Intersect(p, {0, 0, -1}));
  });
  std::vector<Vec3d> places;
  if (const auto& spawn = tracer.scene().spawn; spawn && is_free(*spawn)) places.push_back(VecCast<double>(*spawn));
  for (size_t k = 0; k < candidates.size(); ++k) {
    if (free[k]) places.push_back(candidates[k]);
  }
  return places;
}

}  // namespace airsim360
