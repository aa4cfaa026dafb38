// Flats: two rows of rooms along a corridor; those that want sun lie south, wet ones beside each other.
#include <array>

#include "airsim360/worlds/interior/plan_strips.h"
#include "airsim360/worlds/interior/plan_uses.h"

namespace airsim360::internal {
namespace {

using T = RoomType;
constexpr float kHomeCorridor = 1.5f, kCeiling = 2.6f;

void PlanFlat(PlanPen& pen, int storey, bool mirrored) {
  const float w = static_cast<float>(pen.plan().spec.width), d = static_cast<float>(pen.plan().spec.depth);
  const float south = (d - kHomeCorridor) * 0.5f, north = south + kHomeCorridor;
  const StripRoom sunny[] = {
      {T::kLivingRoom, 6.2f, kCeiling}, {T::kDiningRoom, 3.5f, kCeiling}, {T::kKitchen, 3.3f, kCeiling}, {T::kChildRoom, 3.2f, kCeiling}};
  const StripRoom shady[] = {{T::kStudy, 2.9f, kCeiling},  {T::kBedroom, 4.2f, kCeiling}, {T::kBathroom, 2.6f, 2.45f},
                             {T::kToilet, 1.65f, 2.45f},   {T::kHall, 2.2f, kCeiling},    {T::kStorage, 1.65f, 2.45f},
                             {T::kBedroom, 3.4f, kCeiling}};
  std::vector<StripRoom> row(std::begin(shady), std::end(shady));
  // A maisonette has its stairs where the store was.
  const bool stairs = pen.plan().spec.storeys > 1;
  if (stairs) row[5] = {T::kStairwell, 2.5f};
  const auto a = FillStrip(pen, storey, {0, 0, w, south}, sunny, mirrored);
  const auto b = FillStrip(pen, storey, {0, north, w, d}, row, mirrored, stairs ? 0.02f : 0.06f);
  pen.Room(T::kCorridor, storey, {0, south, w, north}, 2.45f);
  if (stairs) MakeStairwell(pen, b[5]);
}

void CutOpenings(PlanPen& pen, int storey) {
  std::vector<int> of(static_cast<size_t>(T::kBookStacks) + 1, -1), bedrooms;
  for (int i = 0; i < static_cast<int>(pen.plan().rooms.size()); ++i) {
    if (pen.room(i).storey != storey) continue;
    of[static_cast<size_t>(pen.room(i).type)] = i;
    if (pen.room(i).type == T::kBedroom) bedrooms.push_back(i);
  }
  const auto at = [&](T type) { return of[static_cast<size_t>(type)]; };
  const int corridor = at(T::kCorridor);
  pen.Wide(at(T::kLivingRoom), at(T::kDiningRoom), OpeningKind::kPassage, 0.7f, 0, 2.45f);
  pen.Door(at(T::kLivingRoom), corridor, 1.5f, 0.75f, OpeningKind::kDoubleDoor);
  pen.Door(at(T::kDiningRoom), at(T::kKitchen), 1.2f, 0.35f, OpeningKind::kPassage, 2.2f);
  pen.Door(at(T::kKitchen), corridor, 0.95f, 0.2f);
  for (const T type : {T::kChildRoom, T::kStudy}) pen.Door(at(type), corridor, 0.95f, static_cast<float>(pen.rng().Uniform(0.15, 0.85)));
  for (const int bedroom : bedrooms) pen.Door(bedroom, corridor, 0.95f, static_cast<float>(pen.rng().Uniform(0.1, 0.9)));
  for (const T type : {T::kBathroom, T::kToilet}) pen.Door(at(type), corridor, 0.85f, 0.5f);
  if (at(T::kStorage) >= 0) pen.Door(at(T::kStorage), corridor, 0.85f, 0.5f);
  if (at(T::kStairwell) >= 0) pen.Door(at(T::kStairwell), corridor, 1.0f, 0.5f, OpeningKind::kPassage);
  pen.Door(at(T::kHall), corridor, 1.3f, 0.5f, OpeningKind::kPassage, 2.3f);
  if (storey == 0) pen.OuterDoor(at(T::kHall), PlanSide::kNorth, 1.0f, 0.5f, OpeningKind::kDoor, 2.15f);
  if (storey == 0) pen.OuterDoor(at(T::kLivingRoom), PlanSide::kSouth, 1.8f, 0.5f, OpeningKind::kSlidingDoor, 2.25f);
  for (const PlanSide side : {PlanSide::kSouth, PlanSide::kNorth, PlanSide::kWest, PlanSide::kEast}) {
    pen.Windows(at(T::kLivingRoom), side, 1.5f, 2.0f, 0.85f, 2.3f);
    for (const T type : {T::kDiningRoom, T::kChildRoom, T::kStudy}) pen.Windows(at(type), side, 1.4f, 2.3f, 0.85f, 2.3f);
    pen.Windows(at(T::kKitchen), side, 1.2f, 2.6f, 1.1f, 2.25f);
    for (const int bedroom : bedrooms) pen.Windows(bedroom, side, 1.4f, 2.4f, 0.85f, 2.3f);
    for (const T type : {T::kBathroom, T::kToilet}) pen.Windows(at(type), side, 0.7f, 3.0f, 1.4f, 2.2f);
  }
  pen.Windows(corridor, PlanSide::kWest, 0.8f, 1.5f, 0.9f, 2.2f);
  pen.Windows(corridor, PlanSide::kEast, 0.8f, 1.5f, 0.9f, 2.2f);
}

}  // namespace

void PlanApartment(PlanPen& pen) {
  const bool mirrored = pen.rng().Chance(0.5);
  const int storeys = static_cast<int>(pen.plan().spec.storeys);
  for (int s = 0; s < storeys; ++s) PlanFlat(pen, s, mirrored);
  pen.FindWalls();
  for (int s = 0; s < storeys; ++s) CutOpenings(pen, s);
}

}  // namespace airsim360::internal
