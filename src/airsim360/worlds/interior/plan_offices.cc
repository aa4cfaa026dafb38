// Floors of offices: two corridors around a core of lifts, stairs, toilets and small rooms; desks along the facades.
#include <array>

#include "airsim360/worlds/interior/plan_strips.h"
#include "airsim360/worlds/interior/plan_uses.h"

namespace airsim360::internal {
namespace {

using T = RoomType;
constexpr float kCorridor = 1.9f, kCore = 5.2f, kEnd = 2.2f;

struct OfficeFloor {
  std::vector<int> south, north, core;
  int corridor_south, corridor_north, end_west, end_east;
};

std::vector<StripRoom> NorthRow(float width) {
  std::vector<StripRoom> row;
  const int cells = static_cast<int>(width / 3.5f);
  for (int i = 0; i < cells; ++i) {
    if (i == cells / 2) row.push_back({T::kMeetingRoom, 5.2f, 2.8f});
    row.push_back({T::kCellOffice, 3.2f, 2.8f});
  }
  return row;
}

OfficeFloor PlanFloor(PlanPen& pen, int storey, bool mirrored) {
  const float w = static_cast<float>(pen.plan().spec.width), d = static_cast<float>(pen.plan().spec.depth);
  const float north_depth = 5.2f, south_depth = d - north_depth - kCore - 2 * kCorridor;
  const float y1 = south_depth, y2 = y1 + kCorridor, y3 = y2 + kCore, y4 = y3 + kCorridor;
  const bool atrium = pen.plan().spec.atrium;
  const StripRoom desks[] = {{T::kOpenOffice, 16, 2.8f}, {T::kMeetingRoom, 6, 2.8f}, {T::kOpenOffice, 12, 2.8f}};
  const StripRoom core[] = {{T::kStairwell, 2.9f},
                            {T::kToilet, 2.7f, 2.6f, "toilet women"},
                            {T::kToilet, 2.7f, 2.6f, "toilet men"},
                            {T::kPantry, 4.6f, 2.7f},
                            {T::kLiftShaft, 2.2f},
                            {atrium ? T::kAtrium : T::kLobby, atrium ? 8.0f : 3.6f, 2.9f},
                            {T::kLiftShaft, 2.2f},
                            {T::kPrintRoom, 3.0f, 2.7f},
                            {T::kStorage, 2.4f, 2.6f},
                            {T::kMeetingRoom, 4.4f, 2.8f}};
  OfficeFloor floor;
  floor.south = FillStrip(pen, storey, {0, 0, w, y1}, desks, mirrored);
  floor.north = FillStrip(pen, storey, {0, y4, w, d}, NorthRow(w), mirrored);
  floor.core = FillStrip(pen, storey, {kEnd, y2, w - kEnd, y3}, core, mirrored, 0.01f);
  floor.corridor_south = pen.Room(T::kCorridor, storey, {0, y1, w, y2}, 2.6f);
  floor.corridor_north = pen.Room(T::kCorridor, storey, {0, y3, w, y4}, 2.6f);
  floor.end_west = pen.Room(T::kCorridor, storey, {0, y2, kEnd, y3}, 2.6f);
  floor.end_east = pen.Room(T::kCorridor, storey, {w - kEnd, y2, w, y3}, 2.6f);
  MakeStairwell(pen, floor.core[0]);
  if (atrium) MakeAtrium(pen, floor.core[5]);
  for (const int lift : {floor.core[4], floor.core[6]})
    pen.room(lift).has_floor = storey == 0, pen.room(lift).has_ceiling = storey + 1 == static_cast<int>(pen.plan().spec.storeys);
  return floor;
}

void OpenCore(PlanPen& pen, const OfficeFloor& f, int storey) {
  const int hub = f.core[5];
  const bool void_above = pen.plan().spec.atrium && storey > 0;
  for (const int corridor : {f.corridor_south, f.corridor_north}) {
    pen.Between(hub, corridor, void_above ? WallKind::kBalustrade : WallKind::kOpen);
    for (const int end : {f.end_west, f.end_east}) pen.Between(corridor, end, WallKind::kOpen);
  }
  // Lifts open to the lobby; where that is an atrium, to the corridor.
  for (const int lift : {f.core[4], f.core[6]})
    pen.Door(lift, pen.plan().spec.atrium ? f.corridor_south : hub, 1.1f, 0.5f, OpeningKind::kLiftDoor, 2.1f);
  pen.Door(f.core[0], f.corridor_south, 1.0f, 0.5f);
  for (const size_t i : {1u, 2u}) pen.Door(f.core[i], f.corridor_south, 0.9f, 0.25f);
  pen.Door(f.core[3], f.corridor_south, 1.6f, 0.5f, OpeningKind::kPassage, 2.3f);
  pen.Door(f.core[3], f.corridor_north, 1.0f, 0.7f);
  pen.Door(f.core[7], f.corridor_north, 1.0f, 0.5f);
  pen.Door(f.core[8], f.corridor_north, 0.9f, 0.5f);
  pen.Between(f.core[9], f.corridor_south, WallKind::kGlassPartition);
  pen.Door(f.core[9], f.corridor_south, 0.95f, 0.8f);
}

void OpenFacades(PlanPen& pen, const OfficeFloor& f, int storey) {
  for (const int room : f.south) {
    const bool meeting = pen.room(room).type == T::kMeetingRoom;
    pen.Between(room, f.corridor_south, WallKind::kGlassPartition);
    pen.Door(room, f.corridor_south, meeting ? 0.95f : 1.8f, meeting ? 0.15f : 0.5f,
             meeting ? OpeningKind::kDoor : OpeningKind::kDoubleDoor);
  }
  for (size_t i = 0; i + 1 < f.south.size(); ++i) pen.Door(f.south[i], f.south[i + 1], 1.0f, 0.15f);
  for (const int room : f.north) {
    pen.Between(room, f.corridor_north, WallKind::kGlassPartition);
    pen.Door(room, f.corridor_north, 0.95f, pen.rng().Chance(0.5) ? 0.12f : 0.88f);
  }
  if (storey == 0) pen.OuterDoor(f.end_west, PlanSide::kWest, 1.8f, 0.5f, OpeningKind::kSlidingDoor, 2.4f);
  if (storey == 0) pen.OuterDoor(f.end_east, PlanSide::kEast, 1.8f, 0.5f, OpeningKind::kDoubleDoor, 2.2f);
  for (const PlanSide side : {PlanSide::kSouth, PlanSide::kNorth, PlanSide::kWest, PlanSide::kEast}) {
    for (const auto* row : {&f.south, &f.north})
      for (const int room : *row) pen.Windows(room, side, 1.6f, 1.85f, 0.75f, 2.65f);
    for (const int way : {f.end_west, f.end_east, f.corridor_south, f.corridor_north}) pen.Windows(way, side, 1.1f, 1.7f, 0.4f, 2.45f);
  }
}

}  // namespace

void PlanOffice(PlanPen& pen) {
  const bool mirrored = pen.rng().Chance(0.5);
  std::vector<OfficeFloor> floors;
  for (int s = 0; s < static_cast<int>(pen.plan().spec.storeys); ++s) floors.push_back(PlanFloor(pen, s, mirrored));
  pen.FindWalls();
  for (int s = 0; s < static_cast<int>(floors.size()); ++s) {
    OpenCore(pen, floors[static_cast<size_t>(s)], s);
    OpenFacades(pen, floors[static_cast<size_t>(s)], s);
  }
}

}  // namespace airsim360::internal
