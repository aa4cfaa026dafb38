#include "airsim360/worlds/interior/furnisher.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

constexpr float kWallStep = 0.15f;

// What belongs to the building and its grounds: services, sanitary ware, kitchen units, marks of bays, plants outside.
constexpr auto kFixed = std::to_array<std::string_view>({"pendant_lamp",
                                                         "downlight",
                                                         "ceiling_panel",
                                                         "high_bay_lamp",
                                                         "tube_light",
                                                         "air_vent",
                                                         "duct",
                                                         "sprinkler",
                                                         "smoke_detector",
                                                         "exit_sign",
                                                         "fire_extinguisher",
                                                         "switch_plate",
                                                         "radiator",
                                                         "electric_box",
                                                         "washbasin",
                                                         "toilet",
                                                         "bathtub",
                                                         "shower",
                                                         "kitchen_counter",
                                                         "kitchen_sink_counter",
                                                         "stove",
                                                         "wall_cabinet",
                                                         "wheel_stop",
                                                         "parking_sign",
                                                         "ticket_machine",
                                                         "street_light",
                                                         "hedge",
                                                         "shrub",
                                                         "flower_bed",
                                                         "tree_generic",
                                                         "tree_narrowleaf",
                                                         "red_tree"});
bool IsFixed(std::string_view kind) { return std::find(kFixed.begin(), kFixed.end(), kind) != kFixed.end(); }

Vec2f Turned(Vec2f v, float yaw) { return {v.x * std::cos(yaw) - v.y * std::sin(yaw), v.x * std::sin(yaw) + v.y * std::cos(yaw)}; }

}  // namespace

const Furnisher::Individual& Furnisher::Get(std::string_view kind, uint32_t variant) {
  auto it = made_.find(kind);
  if (it == made_.end()) {
    // Made in parallel, added in order.
    const PropKind& found = FindPropKind(kind);
    std::vector<Model> models(static_cast<size_t>(found.variants));
    ParallelFor(found.variants,
                [&](int64_t i) { models[static_cast<size_t>(i)] = MakeProp(found, static_cast<uint32_t>(i), seed_, models_); });
    std::vector<Individual> all;
    for (Model& model : models) {
      const Box3f box = model.mesh.Bounds();
      all.push_back({shelf_.Add(std::move(model)), box});
    }
    it = made_.emplace(std::string(kind), std::move(all)).first;
  }
  return it->second[variant % it->second.size()];
}

const Box3f& Furnisher::BoxOf(std::string_view kind, uint32_t variant) { return Get(kind, variant).box; }
uint32_t Furnisher::Variants(std::string_view kind) { return static_cast<uint32_t>(std::max(1, FindPropKind(kind).variants)); }

std::optional<EntityId> Furnisher::Put(std::string_view kind, Vec3f p, float yaw, uint32_t variant, Vec3f tint) {
  if (!furnished_ && !IsFixed(kind)) return std::nullopt;
  const PropKind& found = FindPropKind(kind);
  const Individual& one = Get(kind, variant);
  const Vec2f middle = Turned({one.box.center().x, one.box.center().y}, yaw);
  const Vec3f origin{p.x - middle.x, p.y - middle.y, p.z - std::max(one.box.min.z, 0.0f)};
  const EntityId entity = builder_.AddEntity(std::string(found.name), builder_.tree().At(found.category));
  builder_.AddInstance({one.mesh, PlaceUpright(origin, yaw), entity, tint, EveningGlow(found.name, found.category, origin, Engine::kOff)});
  return entity;
}

std::optional<EntityId> Furnisher::Hang(std::string_view kind, Vec3f p, float yaw, uint32_t variant) {
  const Box3f& box = BoxOf(kind, variant);
  return Put(kind, {p.x, p.y, p.z - box.max.z + std::max(box.min.z, 0.0f)}, yaw, variant);
}

RoomSpace::RoomSpace(const InteriorPlan& plan, int room, Furnisher& furnisher)
    : plan_(plan),
      room_(plan.rooms[static_cast<size_t>(room)]),
      index_(room),
      furnisher_(furnisher),
      rng_(plan.seed, "furniture", static_cast<uint64_t>(room)) {
  for (const PlanWall& wall : plan.walls)
    if (wall.low == room || wall.high == room) AddHoles(wall);
  for (const Vec2f& c : plan.columns)
    if (rect().Contains(c)) taken_.Add({c, Vec2f{1, 1} * (plan.column / 2 + 0.05f), 0});
  for (const PlanSlope& e : plan.escalators)
    if (std::abs(e.z0 - z()) < 0.1f || std::abs(e.z1 - z()) < 0.1f)
      taken_.Add({e.rect.center(), Vec2f{e.rect.width() / 2 + 2.5f, e.rect.depth() / 2 + 0.3f}, 0});
}

// Sides in the order south, east, north, west; `along` in world coordinates of the side's direction.
WallSpot RoomSpace::SpotAt(int side, float along) const {
  const PlanRect& r = rect();
  switch (side) {
    case 0:
      return {{along, r.y0}, {0, 1}, kPiF};
    case 1:
      return {{r.x1, along}, {-1, 0}, -kPiF / 2};
    case 2:
      return {{along, r.y1}, {0, -1}, 0};
    default:
      return {{r.x0, along}, {1, 0}, kPiF / 2};
  }
}

void RoomSpace::AddHoles(const PlanWall& wall) {
  const bool is_low = wall.low == index_;
  const int side = wall.along_x ? (is_low ? 2 : 0) : (is_low ? 1 : 3);
  const bool stands = wall.kind == WallKind::kPartition || wall.kind == WallKind::kExterior || wall.kind == WallKind::kGlassPartition ||
                      wall.kind == WallKind::kParapet;
  if (!stands && wall.length() > 0.5f) open_[side] = true;
  // Nothing stands in the way of doors, 1.1 m before them and as wide as they are.
  for (const PlanOpening& o : wall.openings) {
    const float middle = wall.from + (o.from + o.to) / 2, width = o.to - o.from;
    const WallSpot spot = SpotAt(side, middle);
    holes_.push_back({o.kind, spot, width, o.sill, o.head, side});
    if (o.kind == OpeningKind::kWindow || o.kind == OpeningKind::kGlazing) continue;
    const float deep = o.kind == OpeningKind::kDockDoor
                           ? 6.5f
                           : std::max(1.1f, o.open > 0.5f && o.kind != OpeningKind::kSlidingDoor ? width + 0.15f : 1.1f);
    const Vec2f half = wall.along_x ? Vec2f{width / 2 + 0.15f, deep / 2} : Vec2f{deep / 2, width / 2 + 0.15f};
    taken_.Add({spot.At(0, deep / 2), half, 0});
  }
}

bool RoomSpace::IsBlocked(int side, float along, float width, float height) const {
  for (const Hole& hole : holes_) {
    if (hole.side != side) continue;
    const float at = side % 2 == 0 ? hole.spot.foot.x : hole.spot.foot.y;
    const bool window = hole.kind == OpeningKind::kWindow || hole.kind == OpeningKind::kGlazing;
    if (window && height < hole.sill) continue;
    if (std::abs(at - along) < (hole.width + width) / 2 + 0.02f) return true;
  }
  return false;
}

std::optional<WallSpot> RoomSpace::FindWall(float width, float depth, float height, float front, int wanted) {
  struct Choice {
    int side;
    float along;
  };
  std::vector<Choice> free, corners;
  const float out = (depth + front) / 2 + 0.02f;
  const auto half = [&](int side, float d) { return side % 2 == 0 ? Vec2f{width / 2, d / 2} : Vec2f{d / 2, width / 2}; };
  for (int side = 0; side < 4; ++side) {
    if (open_[side] || (wanted >= 0 && side != wanted)) continue;
    const float from = side % 2 == 0 ? rect().x0 : rect().y0, to = side % 2 == 0 ? rect().x1 : rect().y1;
    const float low = from + width / 2 + 0.03f, high = to - width / 2 - 0.03f;
    const int steps = std::max(1, static_cast<int>((high - low) / kWallStep));
    for (int i = 0; i <= steps && high >= low; ++i) {
      const float along = low + (high - low) * static_cast<float>(i) / static_cast<float>(steps);
      if (IsBlocked(side, along, width, height) || !taken_.IsFree({SpotAt(side, along).At(0, out), half(side, depth + front), 0})) continue;
      free.push_back({side, along});
      if (i == 0 || i == steps) corners.push_back(free.back());
    }
  }
  if (free.empty()) return std::nullopt;
  // Often in corners, where things stand.
  const std::vector<Choice>& from = !corners.empty() && rng_.Chance(0.35) ? corners : free;
  const Choice choice = from[rng_.Index(static_cast<uint32_t>(from.size()))];
  const WallSpot spot = SpotAt(choice.side, choice.along);
  taken_.Add({spot.At(0, depth / 2 + 0.02f), half(choice.side, depth), 0});
  used_.push_back({choice.side, choice.along - width / 2, choice.along + width / 2, height});
  return spot;
}

std::optional<WallSpot> RoomSpace::AtWall(std::string_view kind, float front, int side, std::optional<uint32_t> variant) {
  const uint32_t v = Pick(kind, variant);
  const Vec3f size = Size(kind, v);
  const auto spot = FindWall(size.x, size.y, size.z, front, side);
  if (!spot) return std::nullopt;
  const Vec2f p = spot->At(0, size.y / 2 + 0.025f);
  furnisher_.Put(kind, {p.x, p.y, z()}, spot->yaw, v);
  return spot;
}

int RoomSpace::RowAtWall(std::string_view kind, int count, float gap, float front) {
  const Vec3f size = Size(kind);
  for (int n = count; n > 0; --n) {
    const float width = static_cast<float>(n) * (size.x + gap);
    const auto spot = FindWall(width, size.y, size.z, front);
    if (!spot) continue;
    for (int i = 0; i < n; ++i)
      Put(kind, spot->At((static_cast<float>(i) + 0.5f) * (size.x + gap) - width / 2, size.y / 2 + 0.025f), spot->yaw);
    return n;
  }
  return 0;
}

bool RoomSpace::OnWall(std::string_view kind, float height, int wanted) {
  const uint32_t v = Pick(kind, {});
  const Vec3f size = Size(kind, v);
  for (int k = 0; k < 20; ++k) {
    const int side = wanted < 0 ? static_cast<int>(rng_.Index(4)) : wanted;
    if (open_[side]) continue;
    const float from = side % 2 == 0 ? rect().x0 : rect().y0, to = side % 2 == 0 ? rect().x1 : rect().y1;
    if (to - from < size.x + 0.4f) continue;
    const float along =
        static_cast<float>(rng_.Uniform(static_cast<double>(from + size.x / 2 + 0.15f), static_cast<double>(to - size.x / 2 - 0.15f)));
    const auto hidden = [&](const Used& u) {
      return u.side == side && u.height > height - 0.05f && along + size.x / 2 > u.from && along - size.x / 2 < u.to;
    };
    if (IsBlocked(side, along, size.x, height + size.z) || std::any_of(used_.begin(), used_.end(), hidden)) continue;
    const WallSpot spot = SpotAt(side, along);
    Put(kind, spot.At(0, size.y / 2 + 0.004f), spot.yaw, height, v);
    used_.push_back({side, along - size.x / 2, along + size.x / 2, height + size.z});
    return true;
  }
  return false;
}

bool RoomSpace::At(std::string_view kind, Vec2f p, float yaw, std::optional<uint32_t> variant, Vec3f tint) {
  const uint32_t v = Pick(kind, variant);
  const Vec3f size = Size(kind, v);
  const Footprint footprint{p, {size.x / 2, size.y / 2}, yaw};
  const float reach = std::max(std::abs(std::cos(yaw)) * size.x + std::abs(std::sin(yaw)) * size.y, 0.0f) / 2,
              reach_y = (std::abs(std::sin(yaw)) * size.x + std::abs(std::cos(yaw)) * size.y) / 2;
  const PlanRect& r = rect();
  if (p.x - reach < r.x0 || p.x + reach > r.x1 || p.y - reach_y < r.y0 || p.y + reach_y > r.y1 || !taken_.IsFree(footprint)) return false;
  taken_.Add(footprint);
  furnisher_.Put(kind, {p.x, p.y, z()}, yaw, v, tint);
  return true;
}

bool RoomSpace::Anywhere(std::string_view kind, float margin, int tries) {
  const PlanRect r = rect().Inset(margin);
  if (r.width() <= 0 || r.depth() <= 0) return false;
  for (int k = 0; k < tries; ++k) {
    const Vec2f p{static_cast<float>(rng_.Uniform(static_cast<double>(r.x0), static_cast<double>(r.x1))),
                  static_cast<float>(rng_.Uniform(static_cast<double>(r.y0), static_cast<double>(r.y1)))};
    if (At(kind, p, static_cast<float>(rng_.Uniform(0, 6.28)))) return true;
  }
  return false;
}

void RoomSpace::Put(std::string_view kind, Vec2f p, float yaw, float height, std::optional<uint32_t> variant, Vec3f tint) {
  furnisher_.Put(kind, {p.x, p.y, z() + height}, yaw, Pick(kind, variant), tint);
}

void FurnishRooms(const InteriorPlan& plan, Furnisher& furnisher) {
  const double clutter = plan.spec.clutter;
  for (int i = 0; i < static_cast<int>(plan.rooms.size()); ++i) {
    if (!plan.rooms[static_cast<size_t>(i)].has_floor) continue;
    RoomSpace space(plan, i, furnisher);
    switch (plan.spec.use) {
      case BuildingUse::kApartment:
        FurnishHome(space, clutter);
        break;
      case BuildingUse::kMall:
        FurnishTrade(space, clutter);
        break;
      case BuildingUse::kWarehouse:
        if (space.room().type == RoomType::kWarehouseHall)
          FurnishHall(space, plan, clutter);
        else
          FurnishWork(space, clutter);
        break;
      case BuildingUse::kCarPark:
        break;
      default:
        FurnishWork(space, clutter);
    }
  }
  if (plan.spec.use == BuildingUse::kCarPark) FurnishDecks(plan, furnisher);
}

}  // namespace airsim360::internal
