// Warehouses: one hall with docks and a strip of offices. Car parks: decks with a ramp between each two.
#include "airsim360/worlds/interior/plan_strips.h"
#include "airsim360/worlds/interior/plan_uses.h"

namespace airsim360::internal {
namespace {

using T = RoomType;
constexpr float kOfficeStrip = 6.5f, kRampLane = 4.6f, kRampEnd = 5.2f;

// The rooms of one end of a deck: foot, ramp or opening or deck, head.
struct DeckEnd {
  int south, middle, north;
};

DeckEnd PlanEnd(PlanPen& pen, int storey, float x0, float x1, bool ramp, bool opening, bool core) {
  const float d = static_cast<float>(pen.plan().spec.depth);
  DeckEnd end{};
  end.south = pen.Room(T::kParkingDeck, storey, {x0, 0, x1, kRampEnd});
  end.middle = pen.Room(ramp || opening ? T::kRamp : T::kParkingDeck, storey, {x0, kRampEnd, x1, d - kRampEnd});
  end.north = pen.Room(core ? T::kStairwell : T::kParkingDeck, storey, {x0, d - kRampEnd, x1, d});
  if (ramp) pen.room(end.middle).has_ceiling = false;
  if (opening) pen.room(end.middle).has_floor = false;
  if (core) MakeStairwell(pen, end.north);
  return end;
}

void JoinEnd(PlanPen& pen, const DeckEnd& end, int deck, bool ramp, bool opening, bool core) {
  pen.Between(end.south, deck, WallKind::kOpen);
  if (core)
    pen.Door(end.north, deck, 1.0f, 0.0f, OpeningKind::kDoor, 2.1f);
  else
    pen.Between(end.north, deck, WallKind::kOpen);
  if (!ramp && !opening) {
    pen.Between(end.middle, deck, WallKind::kOpen);
    pen.Between(end.middle, end.south, WallKind::kOpen);
    if (!core) pen.Between(end.middle, end.north, WallKind::kOpen);
    return;
  }
  if (ramp) {
    pen.Between(end.middle, end.south, WallKind::kOpen);
    return;
  }
  pen.Between(end.middle, end.south, WallKind::kUpstand);
  pen.Between(end.middle, deck, WallKind::kUpstand);
  pen.Between(end.middle, end.north, WallKind::kOpen);
}

}  // namespace

void PlanWarehouse(PlanPen& pen) {
  const float w = static_cast<float>(pen.plan().spec.width), d = static_cast<float>(pen.plan().spec.depth);
  const bool mirrored = pen.rng().Chance(0.5);
  const float hall_x0 = mirrored ? 0 : kOfficeStrip, hall_x1 = mirrored ? w - kOfficeStrip : w;
  const float ox0 = mirrored ? w - kOfficeStrip : 0, ox1 = ox0 + kOfficeStrip;
  const int hall = pen.Room(T::kWarehouseHall, 0, {hall_x0, 0, hall_x1, d});
  struct Small {
    T type;
    float share;
  };
  constexpr Small kSmall[] = {{T::kDispatchOffice, 7}, {T::kToilet, 3},     {T::kBreakRoom, 6.5f},
                              {T::kStorage, 5},        {T::kCellOffice, 5}, {T::kMeetingRoom, 6}};
  float sum = 0, y = 0;
  for (const Small& s : kSmall) sum += s.share;
  std::vector<int> small;
  for (const Small& s : kSmall) {
    const float to = y + d * s.share / sum;
    small.push_back(pen.Room(s.type, 0, {ox0, y, ox1, to}, 2.8f));
    y = to;
  }
  pen.FindWalls();
  const PlanSide outside = mirrored ? PlanSide::kEast : PlanSide::kWest;
  for (const int room : small) {
    pen.Door(room, hall, 1.0f, static_cast<float>(pen.rng().Uniform(0.2, 0.8)));
    if (pen.room(room).type != T::kStorage) pen.Windows(room, outside, 1.5f, 2.4f, 0.9f, 2.3f);
  }
  // Docks to the south with doors of 3.4 x 3.8 m, people's doors in the other walls.
  const int docks = static_cast<int>((hall_x1 - hall_x0) / 8);
  for (int i = 0; i < docks; ++i)
    pen.OuterDoor(hall, PlanSide::kSouth, 3.4f, (static_cast<float>(i) + 0.5f) / static_cast<float>(docks), OpeningKind::kDockDoor, 3.8f);
  pen.OuterDoor(hall, PlanSide::kNorth, 1.0f, 0.1f, OpeningKind::kDoor, 2.1f);
  pen.OuterDoor(hall, PlanSide::kNorth, 1.0f, 0.9f, OpeningKind::kDoor, 2.1f);
  const float top = pen.room(hall).ceiling_z;
  pen.Windows(hall, PlanSide::kNorth, 5.0f, 6.0f, top - 2.2f, top - 0.9f);
  for (int i = 0; i < 4; ++i) {
    const float x = hall_x0 + (hall_x1 - hall_x0) * (static_cast<float>(i) + 0.5f) / 4;
    pen.room(hall).skylights.push_back({x - 1.2f, 5, x + 1.2f, d - 5});
  }
  // Columns in the middle line and along the walls.
  const int frames = static_cast<int>((hall_x1 - hall_x0) / 12);
  for (int i = 0; i <= frames; ++i) {
    const float x = hall_x0 + 0.35f + (hall_x1 - hall_x0 - 0.7f) * static_cast<float>(i) / static_cast<float>(frames);
    for (const float at : {0.35f, d / 2, d - 0.35f}) pen.plan().columns.push_back({x, at});
  }
  pen.plan().column = 0.35f;
}

void PlanCarPark(PlanPen& pen) {
  const float w = static_cast<float>(pen.plan().spec.width), d = static_cast<float>(pen.plan().spec.depth);
  const int storeys = static_cast<int>(pen.plan().spec.storeys);
  struct Deck {
    int main;
    DeckEnd west, east;
    bool west_up, west_hole, east_up, east_hole;
  };
  std::vector<Deck> decks;
  for (int s = 0; s < storeys; ++s) {
    Deck deck{};
    const bool up = s + 1 < storeys;
    deck.west_up = up && s % 2 == 0, deck.east_up = up && s % 2 == 1;
    deck.west_hole = s % 2 == 1, deck.east_hole = s % 2 == 0 && s > 0;
    deck.main = pen.Room(T::kParkingDeck, s, {kRampLane, 0, w - kRampLane, d});
    deck.west = PlanEnd(pen, s, 0, kRampLane, deck.west_up, deck.west_hole, false);
    deck.east = PlanEnd(pen, s, w - kRampLane, w, deck.east_up, deck.east_hole, true);
    decks.push_back(deck);
  }
  pen.FindWalls();
  for (int s = 0; s < storeys; ++s) {
    const Deck& deck = decks[static_cast<size_t>(s)];
    JoinEnd(pen, deck.west, deck.main, deck.west_up, deck.west_hole, false);
    JoinEnd(pen, deck.east, deck.main, deck.east_up, deck.east_hole, true);
    for (const auto& [room, up] : {std::pair{deck.west.middle, deck.west_up}, {deck.east.middle, deck.east_up}})
      if (up)
        pen.plan().ramps.push_back({pen.room(room).cell, pen.room(room).floor_z, pen.room(room).floor_z + pen.height(), false, false});
    // Open to the air above a parapet; closed around the stairs.
    for (const int room : {deck.main, deck.west.south, deck.west.middle, deck.west.north, deck.east.south, deck.east.middle})
      for (const PlanSide side : {PlanSide::kWest, PlanSide::kEast, PlanSide::kSouth, PlanSide::kNorth})
        pen.OuterWall(room, side, WallKind::kParapet);
    if (s == 0) {
      pen.OuterDoor(deck.east.south, PlanSide::kEast, 3.4f, 0.5f, OpeningKind::kPassage, 2.4f);
      pen.OuterDoor(deck.west.south, PlanSide::kWest, 3.4f, 0.5f, OpeningKind::kPassage, 2.4f);
    }
  }
  // Columns between the bays, three cars apart.
  const float x0 = kRampLane + 0.3f, x1 = w - kRampLane - 0.3f;
  const int spans = static_cast<int>((x1 - x0) / 7.5f);
  for (int i = 0; i <= spans; ++i)
    for (const float y : {5.3f, d / 2, d - 5.3f})
      pen.plan().columns.push_back({x0 + (x1 - x0) * static_cast<float>(i) / static_cast<float>(spans), y});
  pen.plan().column = 0.45f;
}

}  // namespace airsim360::internal
