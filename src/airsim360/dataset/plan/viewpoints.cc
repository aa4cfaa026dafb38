#include "airsim360/dataset/plan/viewpoints.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/trace/surface_entity.h"

namespace airsim360 {
namespace {

constexpr int kTries = 200;                       // places of a frame before it is given up
constexpr int kAimTries = 60;                     // places near a rare thing
constexpr int64_t kTryStride = int64_t{1} << 24;  // frames of a row stay below it: no place is tried for two of them
constexpr int kSkyRays = 32;                      // one of them must be free: nobody stands inside of a building
constexpr double kRareShare = 0.06;               // of viewpoints: categories seen from fewer are aimed at
constexpr double kAimShare = 0.045;               // of frames, for a category that no viewpoint sees
constexpr double kMostAims = 0.6;                 // of all frames

bool Contains(const Box2d& box, double x, double y) { return x >= box.min.x && x <= box.max.x && y >= box.min.y && y <= box.max.y; }

// The ground of a town without its backdrop, whose blocks are made to be seen from here; unlimited where a scene does not tell them
// apart.
Box2d GroundBeforeBackdrop(const Scene& scene) {
  constexpr double kFar = 1e12;
  Box3f ground;
  bool backdrop = false;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.name == "ground") ground.Add(mesh.Bounds());
    backdrop |= mesh.name == "backdrop";
  }
  if (!backdrop || ground.empty()) return {{-kFar, -kFar}, {kFar, kFar}};
  return {{ground.min.x, ground.min.y}, {ground.max.x, ground.max.y}};
}

}  // namespace

std::optional<double> GroundUnder(const RayTracer& tracer, Vec2d at) {
  constexpr int kMostSurfaces = 400;
  constexpr float kStep = 0.05f;  // metres past a surface
  const Box3f& bounds = tracer.scene().bounds;
  Vec3f from{static_cast<float>(at.x), static_cast<float>(at.y), bounds.max.z + 1};
  std::optional<double> lowest;
  for (int i = 0; i < kMostSurfaces; ++i) {
    const auto hit = tracer.Intersect(from, {0, 0, -1});
    if (!hit) break;
    lowest = from.z - hit->distance;
    from.z -= hit->distance + kStep;
  }
  return lowest;
}

std::vector<Vec3f> EvenDirections(int n) {
  // Fibonacci's lattice.
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3f> directions;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z), a = golden * i;
    directions.push_back({static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a)), static_cast<float>(z)});
  }
  return directions;
}

ViewpointSampler::ViewpointSampler(const RayTracer& tracer, const RecipeRow& row, uint64_t seed, const std::vector<Aim>& aims)
    : tracer_(tracer), row_(row), seed_(seed), ground_(FindSurveyedGround(tracer.scene())) {
  has_area_ = !row.area.empty();
  limit_ = has_area_ ? AreaOf(row, "row '" + row.name + "': ") : GroundBeforeBackdrop(tracer.scene());
  if (!has_area_) std::erase_if(ground_.cells, [&](Vec2d corner) { return !Contains(limit_, corner.x, corner.y); });
  const Scene& scene = tracer.scene();
  for (const Entity& entity : scene.entities) {
    if (!entity.bounds.empty()) entities_[entity.category].push_back(entity.id);
  }
  for (const Aim& aim : aims) {
    if (const auto category = scene.tree.Find(aim.category)) aims_.emplace_back(*category, aim.share);
  }
}

// Of 32 rays two reach the sky. A closed room has none: there the box of the scene is the room.
bool ViewpointSampler::SeesTheSky(Vec3d p_W) const {
  if (tracer_.scene().sky_entity == kNoEntity) return true;
  static const std::vector<Vec3f> kDirections = EvenDirections(2 * kSkyRays);
  int free = 0;
  for (int i = 0; i < kSkyRays && free < 2; ++i) {
    if (!tracer_.Intersect(VecCast<float>(p_W), kDirections[static_cast<size_t>(i)])) ++free;
  }
  return free >= 2;
}

bool ViewpointSampler::IsGood(Vec3d p_W) const {
  const auto clearance = static_cast<float>(row_.clearance);
  if (tracer_.Clearance(VecCast<float>(p_W), clearance) < clearance) return false;
  return ground_.in_rooms() ? ground_.IsInRoom(tracer_, p_W) : SeesTheSky(p_W);
}

// Of which heights are counted.
std::optional<double> ViewpointSampler::FloorUnder(Vec3d p_W) const {
  if (!ground_.in_rooms()) return GroundUnder(tracer_, {p_W.x, p_W.y});
  const auto hit = tracer_.Intersect(VecCast<float>(p_W), {0, 0, -1});
  return hit ? std::optional(p_W.z - hit->distance) : std::nullopt;
}

std::optional<Vec3d> ViewpointSampler::Candidate(uint64_t n, const double offset[3]) const {
  const Scene& scene = tracer_.scene();
  const bool open = scene.sky_entity != kNoEntity;
  const double u = LowDiscrepancy(n, 0, offset[0]), v = LowDiscrepancy(n, 1, offset[1]);
  Vec2d at;
  double bottom = 0, highest = row_.highest;
  if (ground_.in_rooms()) {
    const std::optional<RoomSpot> spot = ground_.InRoom(tracer_, u, v);
    if (!spot || (has_area_ && !Contains(limit_, spot->at.x, spot->at.y))) return std::nullopt;
    at = spot->at, bottom = spot->floor;
    highest = std::min(highest, spot->ceiling - spot->floor - row_.clearance);
  } else {
    at = has_area_ ? Vec2d{limit_.min.x + u * (limit_.max.x - limit_.min.x), limit_.min.y + v * (limit_.max.y - limit_.min.y)}
                   : ground_.At(u, v);
    const auto ground = GroundUnder(tracer_, at);
    if (!ground && open && !ground_.cells.empty()) return std::nullopt;
    bottom = ground.value_or(scene.bounds.min.z);
    // Not above the ceiling of a room.
    if (!open) highest = std::min(highest, scene.bounds.max.z - bottom - row_.clearance);
  }
  const double lowest = std::min(row_.lowest, std::max(row_.clearance, highest));
  const double height = lowest * std::pow(std::max(highest, lowest) / lowest, LowDiscrepancy(n, 2, offset[2]));
  return Vec3d{at.x, at.y, bottom + height};
}

Vec3d ViewpointSampler::Even(int64_t k) const {
  RngStream offsets(seed_, "viewpoints " + row_.name);
  const double offset[3] = {offsets.Uniform(), offsets.Uniform(), offsets.Uniform()};
  for (int64_t i = 0; i < kTries; ++i) {
    const std::optional<Vec3d> p = Candidate(static_cast<uint64_t>(k + i * kTryStride), offset);
    if (p && IsGood(*p)) return *p;
  }
  throw InputError("row '" + row_.name + "': no free place for frame " + std::to_string(k) + " among " + std::to_string(kTries) +
                   " in world '" + row_.world + "'; use a smaller clearance or another area");
}

// A place from which some entity of a category is seen in its middle.
bool ViewpointSampler::Near(CategoryId category, int64_t k, Vec3d& p_W) const {
  constexpr double kNearest = 2, kFarthest = 20;  // metres beyond the entity's own radius
  constexpr float kLarge = 8;                     // metres of which a part is looked at
  const auto found = entities_.find(category);
  if (found == entities_.end()) return false;
  const Scene& scene = tracer_.scene();
  RngStream random(seed_, "aim " + row_.name, static_cast<uint64_t>(k));
  for (int i = 0; i < kAimTries; ++i) {
    const EntityId entity = found->second[random.Index(static_cast<uint32_t>(found->second.size()))];
    const Box3f& box = scene.entity(entity).bounds;
    const Vec3f size = box.size();
    Vec3d target;
    for (int axis = 0; axis < 3; ++axis) target[axis] = box.min[axis] + size[axis] * random.Uniform(0.1, 0.9);
    const double radius = 0.5 * std::min(kLarge, std::max({size.x, size.y, size.z}));
    const double distance = radius + kNearest * std::pow(kFarthest / kNearest, random.Uniform());
    const double azimuth = random.Uniform(0, 2 * std::numbers::pi), elevation = random.Uniform(-0.1, 0.9);
    const Vec3d p =
        target + Vec3d{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)} * distance;
    if (!Contains(limit_, p.x, p.y)) continue;
    const auto hit = tracer_.Intersect(VecCast<float>(p), VecCast<float>(Normalized(target - p)));
    if (!hit || scene.entity(EntityAt(scene, hit->surface)).category != category) continue;
    const auto ground = FloorUnder(p);
    if (!ground || p.z < *ground + row_.lowest || p.z > *ground + row_.highest || !IsGood(p)) continue;
    p_W = p;
    return true;
  }
  return false;
}

RigidTransform ViewpointSampler::Pose(int64_t k) const {
  RngStream random(seed_, "heading " + row_.name, static_cast<uint64_t>(k));
  const double yaw = random.Uniform(-std::numbers::pi, std::numbers::pi);
  const double tilt = row_.tilt_deg * std::numbers::pi / 180;
  const double pitch = random.Uniform(-tilt, tilt), roll = random.Uniform(-tilt, tilt);
  double lot = random.Uniform();
  Vec3d p;
  for (const auto& [category, share] : aims_) {
    if (lot < share && Near(category, k, p)) return BodyPose(p, yaw, pitch, roll);
    if (lot < share) break;
    lot -= share;
  }
  return BodyPose(Even(k), yaw, pitch, roll);
}

std::vector<Aim> ViewpointSampler::FindAims() const {
  constexpr int64_t kViewpoints = 256;
  constexpr int kRays = 2048;
  const std::vector<Vec3f> directions = EvenDirections(kRays);
  const Scene& scene = tracer_.scene();
  std::vector<std::set<CategoryId>> seen(kViewpoints);
  ParallelFor(kViewpoints, [&](int64_t k) {
    const Vec3f p = VecCast<float>(Even(k));
    for (const Vec3f& direction : directions) {
      const auto hit = tracer_.Intersect(p, direction);
      if (hit) seen[static_cast<size_t>(k)].insert(scene.entity(EntityAt(scene, hit->surface)).category);
    }
  });
  std::vector<Aim> aims;
  double all = 0;
  for (const auto& [category, list] : entities_) {
    const auto count = std::ranges::count_if(seen, [&, id = category](const auto& set) { return set.contains(id); });
    const double share = static_cast<double>(count) / kViewpoints;
    if (share >= kRareShare) continue;
    // Without anything to see it from (inside of a building, say) it would only waste frames.
    Vec3d p;
    bool can = false;
    for (int64_t k = 0; k < 4 && !can; ++k) can = Near(category, k, p);
    if (!can) continue;
    aims.push_back({scene.tree[category].path, kAimShare * (1 - share / kRareShare / 2)});
    all += aims.back().share;
  }
  // Three digits, as they are written in the plan.
  for (Aim& aim : aims) aim.share = std::round(aim.share * std::min(1.0, kMostAims / std::max(all, 1e-9)) * 1000) / 1000;
  return aims;
}

}  // namespace airsim360
