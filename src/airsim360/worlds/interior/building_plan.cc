#include "airsim360/worlds/interior/building_plan.h"

#include <iterator>

#include "airsim360/worlds/interior/plan_uses.h"

namespace airsim360::internal {
namespace {

constexpr const char* kRoomTypeNames[] = {
    "hall",       "corridor",  "living_room", "dining_room",    "kitchen",         "bedroom",      "child_room",   "study",
    "bathroom",   "toilet",    "storage",     "open_office",    "cell_office",     "meeting_room", "pantry",       "print_room",
    "lobby",      "stairwell", "lift_shaft",  "warehouse_hall", "dispatch_office", "break_room",   "shop",         "supermarket",
    "food_court", "concourse", "gallery",     "atrium",         "parking_deck",    "ramp",         "reading_room", "book_stacks"};
static_assert(std::size(kRoomTypeNames) == static_cast<size_t>(RoomType::kBookStacks) + 1);
constexpr const char* kOpeningNames[] = {"door", "double_door", "sliding_door", "dock_door", "lift_door", "passage", "window", "glazing"};
static_assert(std::size(kOpeningNames) == static_cast<size_t>(OpeningKind::kGlazing) + 1);

}  // namespace

const char* RoomTypeName(RoomType type) { return kRoomTypeNames[static_cast<size_t>(type)]; }
const char* OpeningKindName(OpeningKind kind) { return kOpeningNames[static_cast<size_t>(kind)]; }

bool IsDoor(OpeningKind kind) { return kind < OpeningKind::kPassage; }

bool IsPassable(const PlanOpening& opening) {
  return opening.kind == OpeningKind::kPassage || (IsDoor(opening.kind) && opening.open > 0.5f);
}

int InteriorPlan::RoomAt(Vec3f p) const {
  for (size_t i = 0; i < rooms.size(); ++i) {
    const PlanRoom& room = rooms[i];
    if (room.has_floor && room.clear.Contains({p.x, p.y}) && p.z >= room.floor_z && p.z <= room.ceiling_z) return static_cast<int>(i);
  }
  return -1;
}

double InteriorPlan::area_m2() const {
  double sum = 0;
  for (const PlanRoom& room : rooms)
    if (room.has_floor && room.type != RoomType::kLiftShaft) sum += static_cast<double>(room.clear.area());
  return sum;
}

InteriorPlan PlanBuilding(const BuildingSpec& spec, uint64_t seed) {
  spec.Check("building: ");
  PlanPen pen(spec, seed);
  switch (spec.use) {
    case BuildingUse::kApartment:
      PlanApartment(pen);
      break;
    case BuildingUse::kOffice:
      PlanOffice(pen);
      break;
    case BuildingUse::kWarehouse:
      PlanWarehouse(pen);
      break;
    case BuildingUse::kMall:
      PlanMall(pen);
      break;
    case BuildingUse::kCarPark:
      PlanCarPark(pen);
      break;
    case BuildingUse::kLibrary:
      PlanLibrary(pen);
      break;
  }
  return pen.Finish();
}

}  // namespace airsim360::internal
