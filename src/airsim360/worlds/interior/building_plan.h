// The plan of a building: rooms, walls with their openings, stairs, ramps and escalators, before anything is drawn.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "airsim360/math/vector.h"
#include "airsim360/worlds/building_spec.h"

namespace airsim360::internal {

/// Metres in W, x to the east and y to the north.
struct PlanRect {
  float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  float width() const { return x1 - x0; }
  float depth() const { return y1 - y0; }
  float area() const { return width() * depth(); }
  Vec2f center() const { return {(x0 + x1) / 2, (y0 + y1) / 2}; }
  PlanRect Inset(float d) const { return {x0 + d, y0 + d, x1 - d, y1 - d}; }
  bool Contains(Vec2f p) const { return p.x >= x0 && p.x <= x1 && p.y >= y0 && p.y <= y1; }
};

enum class RoomType {
  kHall,
  kCorridor,
  kLivingRoom,
  kDiningRoom,
  kKitchen,
  kBedroom,
  kChildRoom,
  kStudy,
  kBathroom,
  kToilet,
  kStorage,
  kOpenOffice,
  kCellOffice,
  kMeetingRoom,
  kPantry,
  kPrintRoom,
  kLobby,
  kStairwell,
  kLiftShaft,
  kWarehouseHall,
  kDispatchOffice,
  kBreakRoom,
  kShop,
  kSupermarket,
  kFoodCourt,
  kConcourse,
  kGallery,
  kAtrium,
  kParkingDeck,
  kRamp,
  kReadingRoom,
  kBookStacks
};
/// "living_room", …
const char* RoomTypeName(RoomType type);

struct PlanRoom {
  RoomType type{};
  std::string name;  ///< "bedroom 2", unique in the building
  int storey = 0;
  PlanRect cell;   ///< to the middle of its walls; the inner face of outer walls is kHalfWall inside
  PlanRect clear;  ///< between the faces of its walls
  float floor_z = 0, ceiling_z = 0;
  bool has_floor = true, has_ceiling = true;  ///< false: open to the storey below, above
  std::vector<PlanRect> skylights = {};       ///< of clear glass, in its ceiling and roof
};

enum class OpeningKind { kDoor, kDoubleDoor, kSlidingDoor, kDockDoor, kLiftDoor, kPassage, kWindow, kGlazing };
const char* OpeningKindName(OpeningKind kind);
/// An opening in a wall: `from` and `to` along it from the wall's start, heights above the floor of the storey.
struct PlanOpening {
  OpeningKind kind{};
  float from = 0, to = 0, sill = 0, head = 2.1f;
  float open = 0;  ///< of doors: 0 shut … 1 as far as it goes (a little past 90 degrees, slid or rolled away)
  bool hinge_at_to = false;
  bool swings_left = false;  ///< into the room on the wall's left, see PlanWall
  bool outer = false;        ///< leads outside
  int lock = 0;              ///< number of the door in the building, from 1; 0 for windows and passages
};
bool IsDoor(OpeningKind kind);
/// A drone or a person gets through: passages, and doors that stand open.
bool IsPassable(const PlanOpening& opening);

enum class WallKind { kPartition, kExterior, kOpen, kBalustrade, kUpstand, kParapet, kGlassPartition };
/// Runs from (from, at) to (to, at) where along_x, else from (at, from) to (at, to). `low` lies on the side of smaller
/// coordinates, `high` on the other; -1 = outside.
struct PlanWall {
  WallKind kind{};
  int storey = 0;
  bool along_x = true;
  float at = 0, from = 0, to = 0;
  int low = -1, high = -1;
  std::vector<PlanOpening> openings;
  float length() const { return to - from; }
};

/// Two flights with a landing half way, up one storey; starts at the room's side of smaller y, along y.
struct PlanStair {
  int room = 0;
  float rise = 0;
};
/// A ramp or an escalator up along +x or +y (or back along -x, -y where `down_axis`).
struct PlanSlope {
  PlanRect rect;
  float z0 = 0, z1 = 0;
  bool along_x = true, reversed = false;  ///< reversed: rises towards smaller coordinates
};

inline constexpr float kHalfWall = 0.06f;   ///< of partitions, metres
inline constexpr float kOuterWall = 0.30f;  ///< thickness of outer walls, which reach outwards
inline constexpr float kSlab = 0.25f;       ///< of floors between storeys and of the roof

struct InteriorPlan {
  BuildingSpec spec;  ///< settled
  uint64_t seed = 0;
  PlanRect outline;  ///< cells together
  std::vector<PlanRoom> rooms;
  std::vector<PlanWall> walls;
  std::vector<PlanStair> stairs;
  std::vector<PlanSlope> ramps, escalators;
  std::vector<Vec2f> columns;  ///< through all storeys
  float column = 0.4f;         ///< their thickness
  bool roof_deck = false;      ///< the roof is parked on

  float StoreyZ(int storey) const { return static_cast<float>(storey) * static_cast<float>(spec.storey_height); }
  int RoomAt(Vec3f p) const;  ///< index of the room that holds a point; -1 = none
  double area_m2() const;     ///< of all floors between walls
};

/// Plans a building; the same for the same spec and seed. Throws as BuildingSpec::Check does.
InteriorPlan PlanBuilding(const BuildingSpec& spec, uint64_t seed);

}  // namespace airsim360::internal
