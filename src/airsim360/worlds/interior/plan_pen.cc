#include "airsim360/worlds/interior/plan_pen.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace airsim360::internal {
namespace {

constexpr float kTouch = 1e-3f;

// The part of [from, to] where no hole of `taken` lies.
std::vector<Vec2f> Gaps(float from, float to, std::vector<Vec2f> taken) {
  std::sort(taken.begin(), taken.end(), [](Vec2f a, Vec2f b) { return a.x < b.x; });
  std::vector<Vec2f> gaps;
  for (const Vec2f& t : taken) {
    if (t.x > from + kTouch) gaps.push_back({from, std::min(t.x, to)});
    from = std::max(from, t.y);
  }
  if (to > from + kTouch) gaps.push_back({from, to});
  return gaps;
}

// Side `side` of a cell: where it lies and how far it reaches.
struct Edge {
  bool along_x;
  float at, from, to;
};
Edge EdgeOf(const PlanRect& r, PlanSide side) {
  switch (side) {
    case PlanSide::kWest:
      return {false, r.x0, r.y0, r.y1};
    case PlanSide::kEast:
      return {false, r.x1, r.y0, r.y1};
    case PlanSide::kSouth:
      return {true, r.y0, r.x0, r.x1};
    case PlanSide::kNorth:
      break;
  }
  return {true, r.y1, r.x0, r.x1};
}
bool IsHighSide(PlanSide side) { return side == PlanSide::kEast || side == PlanSide::kNorth; }
PlanSide Opposite(PlanSide side) {
  constexpr PlanSide kOther[] = {PlanSide::kEast, PlanSide::kWest, PlanSide::kNorth, PlanSide::kSouth};
  return kOther[static_cast<size_t>(side)];
}
constexpr PlanSide kSides[] = {PlanSide::kWest, PlanSide::kEast, PlanSide::kSouth, PlanSide::kNorth};

bool HasFaces(WallKind kind) {
  return kind == WallKind::kPartition || kind == WallKind::kExterior || kind == WallKind::kGlassPartition || kind == WallKind::kParapet;
}

}  // namespace

PlanPen::PlanPen(const BuildingSpec& spec, uint64_t seed) : rng_(seed, "building plan") {
  plan_.spec = spec.Settled();
  plan_.seed = seed;
}

int PlanPen::Room(RoomType type, int storey, PlanRect cell, float ceiling, const char* name) {
  PlanRoom room;
  room.type = type;
  room.name = name ? name : RoomTypeName(type);
  std::replace(room.name.begin(), room.name.end(), '_', ' ');
  room.storey = storey;
  room.cell = cell;
  room.floor_z = plan_.StoreyZ(storey);
  const float most = height() - kSlab;
  room.ceiling_z = room.floor_z + (ceiling > 0 ? std::min(ceiling, most) : most);
  plan_.rooms.push_back(std::move(room));
  return static_cast<int>(plan_.rooms.size()) - 1;
}

void PlanPen::AddSides(int index) {
  const PlanRoom& self = room(index);
  for (const PlanSide side : kSides) {
    const Edge edge = EdgeOf(self.cell, side);
    std::vector<Vec2f> taken;
    for (int j = 0; j < static_cast<int>(plan_.rooms.size()); ++j) {
      if (j == index || room(j).storey != self.storey) continue;
      const Edge other = EdgeOf(room(j).cell, Opposite(side));
      const float from = std::max(edge.from, other.from), to = std::min(edge.to, other.to);
      if (std::abs(other.at - edge.at) > kTouch || to - from < kTouch) continue;
      taken.push_back({from, to});
      // Every pair once: by the room below or to the left.
      if (IsHighSide(side)) plan_.walls.push_back({WallKind::kPartition, self.storey, edge.along_x, edge.at, from, to, index, j, {}});
    }
    for (const Vec2f& gap : Gaps(edge.from, edge.to, taken)) {
      const bool high = IsHighSide(side);
      plan_.walls.push_back(
          {WallKind::kExterior, self.storey, edge.along_x, edge.at, gap.x, gap.y, high ? index : -1, high ? -1 : index, {}});
    }
  }
}

void PlanPen::FindWalls() {
  for (int i = 0; i < static_cast<int>(plan_.rooms.size()); ++i) AddSides(i);
}

PlanWall* PlanPen::Find(int a, int b) {
  for (PlanWall& wall : plan_.walls)
    if ((wall.low == a && wall.high == b) || (wall.low == b && wall.high == a)) return &wall;
  return nullptr;
}

PlanWall* PlanPen::FindOuter(int index, PlanSide side) {
  const Edge edge = EdgeOf(room(index).cell, side);
  PlanWall* longest = nullptr;
  for (PlanWall& wall : plan_.walls) {
    const bool own = IsHighSide(side) ? wall.low == index && wall.high < 0 : wall.high == index && wall.low < 0;
    if (own && wall.along_x == edge.along_x && std::abs(wall.at - edge.at) < kTouch && (!longest || wall.length() > longest->length()))
      longest = &wall;
  }
  return longest;
}

void PlanPen::Between(int a, int b, WallKind kind) {
  for (PlanWall& wall : plan_.walls)
    if ((wall.low == a && wall.high == b) || (wall.low == b && wall.high == a)) wall.kind = kind;
}

void PlanPen::OuterWall(int index, PlanSide side, WallKind kind) {
  if (PlanWall* wall = FindOuter(index, side)) wall->kind = kind;
}

bool PlanPen::IsFree(const PlanWall& wall, float from, float to) const {
  return from >= 0.1f && to <= wall.length() - 0.1f && std::none_of(wall.openings.begin(), wall.openings.end(), [&](const PlanOpening& o) {
           return from < o.to + 0.15f && to > o.from - 0.15f;
         });
}

void PlanPen::AddDoor(PlanWall* wall, float width, float place, OpeningKind kind, float door_height, bool outer) {
  if (!wall) return;
  const float least = 0.18f, room_for = wall->length() - 2 * least - width;
  if (room_for < 0) return;
  // The nearest free place to the one asked for.
  for (int k = 0; k < 21; ++k) {
    const float shift = 0.1f * static_cast<float>((k + 1) / 2) * (k % 2 ? 1.0f : -1.0f);
    const float from = least + std::clamp(place + shift, 0.0f, 1.0f) * room_for;
    if (!IsFree(*wall, from, from + width)) continue;
    PlanOpening door{.kind = kind, .from = from, .to = from + width, .head = door_height, .outer = outer};
    door.hinge_at_to = place > 0.5f;
    // Doors swing into rooms, not into corridors and halls; outer ones outwards where they are double.
    const auto is_way = [&](int r) {
      return r < 0 || plan_.rooms[static_cast<size_t>(r)].type == RoomType::kCorridor ||
             plan_.rooms[static_cast<size_t>(r)].type == RoomType::kHall || plan_.rooms[static_cast<size_t>(r)].type == RoomType::kLobby;
    };
    door.swings_left = outer ? wall->low >= 0 : is_way(wall->high) && !is_way(wall->low);
    wall->openings.push_back(door);
    return;
  }
}

void PlanPen::Door(int a, int b, float width, float place, OpeningKind kind, float door_height) {
  AddDoor(Find(a, b), width, place, kind, door_height, false);
}

void PlanPen::OuterDoor(int index, PlanSide side, float width, float place, OpeningKind kind, float door_height) {
  AddDoor(FindOuter(index, side), width, place, kind, door_height, true);
}

void PlanPen::Windows(int index, PlanSide side, float width, float pitch, float sill, float head, OpeningKind kind) {
  PlanWall* wall = FindOuter(index, side);
  if (!wall) return;
  const int count = std::max(1, static_cast<int>(std::floor(wall->length() / pitch)));
  const float step = wall->length() / static_cast<float>(count);
  const float w = std::min(width, step - 0.3f);
  if (w < 0.4f) return;
  for (int i = 0; i < count; ++i) {
    const float from = step * (static_cast<float>(i) + 0.5f) - w / 2;
    if (IsFree(*wall, from, from + w))
      wall->openings.push_back({.kind = kind, .from = from, .to = from + w, .sill = sill, .head = head, .outer = true});
  }
}

void PlanPen::Wide(int a, int b, OpeningKind kind, float margin, float sill, float head) {
  PlanWall* wall = Find(a, b);
  if (!wall || wall->length() < 2 * margin + 0.5f) return;
  wall->openings.push_back({.kind = kind, .from = margin, .to = wall->length() - margin, .sill = sill, .head = head});
}

void PlanPen::Glaze(int a, int b, float sill, float head) {
  PlanWall* wall = Find(a, b);
  if (!wall) return;
  std::vector<Vec2f> taken;
  for (const PlanOpening& o : wall->openings) taken.push_back({o.from - 0.15f, o.to + 0.15f});
  for (const Vec2f& gap : Gaps(0.25f, wall->length() - 0.25f, taken))
    if (gap.y - gap.x > 0.5f)
      wall->openings.push_back({.kind = OpeningKind::kGlazing, .from = gap.x, .to = gap.y, .sill = sill, .head = head});
}

void PlanPen::Gap(int a, int b, float from, float to) {
  if (PlanWall* wall = Find(a, b))
    wall->openings.push_back({.kind = OpeningKind::kPassage, .from = from - wall->from, .to = to - wall->from, .head = 2.2f});
}

InteriorPlan PlanPen::Finish() {
  plan_.outline = plan_.rooms.front().cell;
  std::map<std::string, int> uses;
  for (PlanRoom& r : plan_.rooms) {
    plan_.outline = {std::min(plan_.outline.x0, r.cell.x0), std::min(plan_.outline.y0, r.cell.y0), std::max(plan_.outline.x1, r.cell.x1),
                     std::max(plan_.outline.y1, r.cell.y1)};
    const int n = ++uses[r.name];
    if (n > 1) r.name.append(" ").append(std::to_string(n));
    r.clear = r.cell;
  }
  int locks = 0;
  for (PlanWall& wall : plan_.walls) {
    std::sort(wall.openings.begin(), wall.openings.end(), [](const PlanOpening& a, const PlanOpening& b) { return a.from < b.from; });
    if (HasFaces(wall.kind)) {
      if (wall.low >= 0) (wall.along_x ? room(wall.low).clear.y1 : room(wall.low).clear.x1) = wall.at - kHalfWall;
      if (wall.high >= 0) (wall.along_x ? room(wall.high).clear.y0 : room(wall.high).clear.x0) = wall.at + kHalfWall;
    }
    for (PlanOpening& opening : wall.openings) {
      if (!IsDoor(opening.kind)) continue;
      opening.lock = ++locks;
      const bool wide = opening.kind == OpeningKind::kSlidingDoor;
      const bool stands = opening.kind != OpeningKind::kLiftDoor && (wide || rng_.Chance(plan_.spec.open_doors));
      opening.open = stands ? (wide || opening.kind == OpeningKind::kDockDoor ? 1.0f : static_cast<float>(rng_.Uniform(0.97, 1))) : 0;
    }
  }
  return std::move(plan_);
}

}  // namespace airsim360::internal
