#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/vln/episodes/places.h"

namespace airsim360::internal {
namespace {

constexpr double kEyeHeight = 1.6;  // metres above the ground: the lowest place beside a thing
constexpr int kRing = 32;           // places tried around a thing
constexpr double kBesideIt = 8;     // metres from a thing: farther is not beside it
constexpr double kApart = 1;        // metres between places around a thing in a room
constexpr double kReach = 150;      // metres that are looked at beyond a thing

struct Finder {
  const VlnGround& ground;
  const InstructionTemplate& wanted;
  const Thing& thing;
  const Viewpoint& start;

  Vec3d Ahead() const { return {std::cos(start.yaw), std::sin(start.yaw), 0}; }
  bool Belongs(EntityId entity) const { return std::ranges::binary_search(thing.entities, entity); }
  std::optional<Vec3d> Checked(Vec3d p) const { return ground.IsFree(p, GoalRoom(ground)) ? std::optional(p) : std::nullopt; }

  // The nearest to the start of those that are free, and see the thing if they have to.
  std::optional<Vec3d> Nearest(std::vector<Vec3d> places, bool in_sight = false) const {
    std::ranges::stable_sort(places, {}, [&](Vec3d p) { return Norm(p - start.p_W); });
    for (const Vec3d& p : places)
      if (ground.IsFree(p, GoalRoom(ground)) && (!in_sight || Sees(p))) return p;
    return std::nullopt;
  }

  // Around the box, `distance` from it; `z` of the place, or over the ground there.
  std::vector<Vec3d> Ring(double distance, bool on_ground) const {
    std::vector<Vec3d> places;
    const Vec3d c = thing.center(), half = thing.size() * 0.5;
    for (int i = 0; i < kRing; ++i) {
      const double azimuth = 2 * kPi * i / kRing;
      const Vec3d way{std::cos(azimuth), std::sin(azimuth), 0};
      const double edge = std::min(half.x / std::max(std::abs(way.x), 1e-9), half.y / std::max(std::abs(way.y), 1e-9));
      Vec3d p = c + way * (edge + distance);
      const auto hit = ground.Below({p.x, p.y, std::max(c.z, thing.box.min.z + 0.5)});
      if (!hit) continue;
      // At its own height; of what is tall, at that of the start as far as it reaches.
      const double tall = half.z > 5 ? std::clamp(start.p_W.z, thing.box.min.z + kEyeHeight, thing.box.max.z) : c.z;
      p.z = on_ground ? hit->z + 1.8 : std::max(tall, hit->z + kEyeHeight);
      places.push_back(p);
    }
    return places;
  }

  bool Sees(Vec3d p) const {
    // Its middle may be a hole: some point of it will do.
    const Vec3d c = thing.center(), half = thing.size() * 0.5;
    for (const double u : {0.0, 0.6, -0.6})
      for (const double w : {0.0, 0.6, -0.6})
        if (Belongs(ground.Meets(p, c + Vec3d{u * half.x, u * half.y, w * half.z} + (c - p) * 0.05))) return true;
    return false;
  }

  // Places of a lattice over its box and as far around it as is wanted, about `apart` metres from each other.
  std::vector<Vec3d> Lattice(double apart) const {
    const double distance = std::max(wanted.distance, 0.8);
    const Vec3d grown{distance, distance, distance}, low = thing.box.min - grown, size = thing.size() + grown * 2;
    const auto parts = [apart](double length) { return static_cast<int>(length / apart) + 1; };
    const int nx = parts(size.x), ny = parts(size.y), nz = parts(size.z);
    std::vector<Vec3d> places;
    for (int i = 0; i < nx * ny * nz; ++i)
      places.push_back(low + Vec3d{size.x * (i % nx + 0.5) / nx, size.y * (i / nx % ny + 0.5) / ny, size.z * (i / (nx * ny) + 0.5) / nz});
    return places;
  }

  // As far from it as is wanted; where nothing is free there, for it stands in a corner or among others, a little farther; of what
  // fills a room of its own, as stairs do, within its box.
  std::optional<Vec3d> Near(bool on_ground) const {
    for (const double share : {1.0, 1.5, 2.0, 3.0}) {
      const double distance = std::max(wanted.distance, std::min(share * wanted.distance, kBesideIt));
      if (const auto place = Nearest(Ring(distance, on_ground), true)) return place;
    }
    if (!ground.rooms()) return std::nullopt;
    return Nearest(Lattice(kApart), true);
  }

  // Above its surface; `highest`: only where that is near its top.
  std::optional<Vec3d> Above(double height, bool highest) const {
    std::vector<Vec3d> places;
    constexpr int kGrid = 9;
    for (int i = 0; i < kGrid * kGrid; ++i) {
      const double x = thing.box.min.x + thing.size().x * (i % kGrid + 0.5) / kGrid,
                   y = thing.box.min.y + thing.size().y * (i / kGrid + 0.5) / kGrid;
      const auto hit = ground.At(x, y);
      if (!hit) continue;
      const bool roof = highest && hit->z > thing.box.max.z - 4 && hit->z < thing.box.max.z + 2;
      if (highest ? roof : Belongs(hit->entity)) places.push_back({x, y, hit->z + height});
    }
    return Nearest(std::move(places));
  }

  // The first of its surface in any direction from the start, `distance` before it.
  std::optional<Vec3d> Shore() const {
    std::vector<Vec3d> places;
    const double most = PlanDistance(start.p_W, thing.box).most + 30;
    for (int i = 0; i < 72; ++i) {
      const Vec3d way{std::cos(2 * kPi * i / 72), std::sin(2 * kPi * i / 72), 0};
      for (double t = wanted.distance + 1; t < most; t += 1) {
        const Vec3d at = start.p_W + way * t;
        const auto hit = ground.At(at.x, at.y);
        if (!hit || !Belongs(hit->entity)) continue;
        const Vec3d before = at - way * wanted.distance;
        if (const auto below = ground.At(before.x, before.y)) places.push_back({before.x, before.y, std::max(below->z, hit->z) + 2.5});
        break;
      }
    }
    return Nearest(std::move(places));
  }

  // Metres along the line ahead at which the box ends.
  double FarEnd() const {
    double far = 0;
    const double d[2] = {std::cos(start.yaw), std::sin(start.yaw)};
    double leave = 1e9;
    for (int i = 0; i < 2; ++i) {
      if (std::abs(d[i]) < 1e-9) continue;
      leave = std::min(leave, std::max((thing.box.min[i] - start.p_W[i]) / d[i], (thing.box.max[i] - start.p_W[i]) / d[i]));
    }
    return std::max(far, leave);
  }

  std::optional<Vec3d> Beyond(std::initializer_list<const char*> categories, double reach) const {
    const double from = FarEnd();
    for (double t = from + 2; t < from + reach; t += 1) {
      const Vec3d at = start.p_W + Ahead() * t;
      const auto hit = ground.At(at.x, at.y);
      if (!hit || std::ranges::none_of(categories, [&](const char* c) { return ground.Is(hit->entity, c); })) continue;
      if (const auto p = Checked({at.x, at.y, hit->z + 2.5})) return p;
    }
    return std::nullopt;
  }

  // Mirrored at the long axis.
  std::optional<Vec3d> OtherSide() const {
    const Vec3d size = thing.size(), c = thing.center();
    Vec3d p = start.p_W;
    (size.x >= size.y ? p.y : p.x) = 2 * (size.x >= size.y ? c.y : c.x) - (size.x >= size.y ? p.y : p.x);
    return Checked(p);
  }

  std::optional<Vec3d> Over() const {
    const Vec3d c = thing.center();
    return Checked({c.x, c.y, start.p_W.z});
  }
};

}  // namespace

std::vector<Vec3d> FindPlaces(const VlnGround& ground, const InstructionTemplate& wanted, const Thing& thing, Vec3d goal) {
  const Viewpoint from{goal, 0};
  const Finder find{ground, wanted, thing, from};
  // Wider, where a lattice has too many places.
  for (double apart = kApart;; apart *= 1.25) {
    std::vector<Vec3d> places;
    for (const Vec3d& p : find.Lattice(apart))
      if (ground.IsFree(p, GoalRoom(ground)) && find.Sees(p)) places.push_back(p);
    if (places.size() > kMostPlaces) continue;
    std::ranges::stable_sort(places, {}, [&](Vec3d p) { return Norm(p - goal); });
    return places;
  }
}

std::optional<Vec3d> FindGoal(const VlnGround& ground, const InstructionTemplate& wanted, const Thing& thing, const Viewpoint& start) {
  const Finder find{ground, wanted, thing, start};
  switch (wanted.goal) {
    case GoalKind::kNear:
      return find.Near(false);
    case GoalKind::kRoof:
      return find.Above(3, true);
    case GoalKind::kLand:
      return find.Above(1.5, false);
    case GoalKind::kBelow:
      return find.Near(true);
    case GoalKind::kShore:
      return find.Shore();
    case GoalKind::kStreetBeyond:
      return find.Beyond({"ground/road", "ground/lane_marking", "ground/crosswalk", "ground/bike_lane", "ground/manhole"}, kReach);
    case GoalKind::kPathBeyond:
      return find.Beyond({"ground/path"}, 60);
    case GoalKind::kFarEnd:
      return find.Checked(start.p_W + find.Ahead() * (find.FarEnd() + 3));
    case GoalKind::kOtherSide:
      return find.OtherSide();
    case GoalKind::kOver:
      return find.Over();
  }
  return std::nullopt;
}

}  // namespace airsim360::internal
