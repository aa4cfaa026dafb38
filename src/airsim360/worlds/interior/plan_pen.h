// Rooms laid beside each other become a plan: their walls follow from where they touch.
#pragma once

#include <string>

#include "airsim360/base/random.h"
#include "airsim360/worlds/interior/building_plan.h"

namespace airsim360::internal {

enum class PlanSide { kWest, kEast, kSouth, kNorth };

class PlanPen {
 public:
  PlanPen(const BuildingSpec& spec, uint64_t seed);

  /// A room; its number. `ceiling` above its floor; 0 = the slab above.
  int Room(RoomType type, int storey, PlanRect cell, float ceiling = 0, const char* name = nullptr);
  PlanRoom& room(int index) { return plan_.rooms[static_cast<size_t>(index)]; }
  /// Walls of all pairs of touching rooms and to the outside. To be called once, after all rooms and before openings.
  void FindWalls();
  /// What stands between two rooms (-1 = outside) instead of a wall.
  void Between(int a, int b, WallKind kind);
  /// Walls of a room to the outside on one side.
  void OuterWall(int room, PlanSide side, WallKind kind);

  /// A door in the middle (or at `place`, 0 … 1 of the free length) of the wall between two rooms; nothing where they do not touch
  /// wide enough. `into`: the room that it swings into.
  void Door(int a, int b, float width = 0.9f, float place = 0.5f, OpeningKind kind = OpeningKind::kDoor, float height = 2.1f);
  /// Likewise to the outside.
  void OuterDoor(int room, PlanSide side, float width, float place, OpeningKind kind, float height);
  /// Windows of about `width` every `pitch` metres along a room's outer walls on that side, clear of what is there.
  void Windows(int room, PlanSide side, float width, float pitch, float sill, float head, OpeningKind kind = OpeningKind::kWindow);
  /// One opening over the free length of the wall between two rooms, `margin` metres from its ends.
  void Wide(int a, int b, OpeningKind kind, float margin, float sill, float head);

  /// Glass in what is left of the wall between two rooms, from `sill` to `head`; for shop fronts.
  void Glaze(int a, int b, float sill, float head);
  /// Interrupts the balustrade between two rooms from one coordinate along it to another.
  void Gap(int a, int b, float from, float to);

  RngStream& rng() { return rng_; }
  InteriorPlan& plan() { return plan_; }
  float height() const { return static_cast<float>(plan_.spec.storey_height); }
  /// Clear faces, names, numbers and states of doors.
  InteriorPlan Finish();

 private:
  PlanWall* Find(int a, int b);
  PlanWall* FindOuter(int room, PlanSide side);
  bool IsFree(const PlanWall& wall, float from, float to) const;
  void AddDoor(PlanWall* wall, float width, float place, OpeningKind kind, float height, bool outer);
  void AddSides(int room);

  InteriorPlan plan_;
  RngStream rng_;
};

}  // namespace airsim360::internal
