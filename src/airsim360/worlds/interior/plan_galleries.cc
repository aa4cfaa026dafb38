// Malls and libraries: rooms on both sides of a hall through all storeys (of libraries, where it is asked for), with galleries along it.
#include <algorithm>

#include "airsim360/worlds/interior/plan_strips.h"
#include "airsim360/worlds/interior/plan_uses.h"

namespace airsim360::internal {
namespace {

using T = RoomType;

// What malls and libraries differ in.
struct GalleryStyle {
  float strip, gallery, west, east, bridge;  ///< metres
  float ceiling;                             ///< of rooms and galleries, 0 = as high as can be
  T room, ground_way, east_room;
  bool shopfronts, escalators;
  bool hall;  ///< through all storeys; else floors go through, with rooms of the east_room's kind
};

struct GalleryFloor {
  std::vector<int> south, north;
  int way_south, way_north, west, east, atrium_west, bridge, atrium_east;
};

std::vector<StripRoom> Row(PlanPen& pen, const GalleryStyle& style, float width, int storey, bool stairs) {
  std::vector<StripRoom> row;
  const bool mall = style.shopfronts;
  float left = width - (stairs ? 6.4f : 0);
  while (left > 5) {
    const auto w = static_cast<float>(pen.rng().Uniform(mall ? 7.5 : 8, mall ? 13 : 14));
    T type = style.room;
    if (mall && storey == 0 && row.size() == 1) type = T::kSupermarket;
    if (!mall && row.size() % 2 == 1) type = T::kBookStacks;
    row.push_back({type, type == T::kSupermarket ? w + 6 : w, style.ceiling});
    left -= row.back().share;
  }
  if (stairs) {
    row.insert(row.begin() + static_cast<std::ptrdiff_t>(row.size() / 2), {{T::kStairwell, 3.4f}, {T::kLiftShaft, 2.8f}});
    row.push_back({T::kToilet, 4.2f, 2.7f});
  }
  return row;
}

GalleryFloor PlanFloor(PlanPen& pen, const GalleryStyle& style, int storey, const std::vector<StripRoom>& south,
                       const std::vector<StripRoom>& north) {
  const float w = static_cast<float>(pen.plan().spec.width), d = static_cast<float>(pen.plan().spec.depth);
  const float y1 = style.strip, y2 = y1 + style.gallery, y3 = d - style.strip - style.gallery, y4 = d - style.strip;
  const float xw = style.west, xe = w - style.east, xb = (xw + xe) / 2;
  const T way = storey == 0 ? style.ground_way : T::kGallery;
  GalleryFloor f;
  f.south = FillStrip(pen, storey, {0, 0, w, y1}, south, false, 0.02f);
  f.north = FillStrip(pen, storey, {0, y4, w, d}, north, false, 0);
  f.way_south = pen.Room(way, storey, {xw, y1, xe, y2}, style.ceiling);
  f.way_north = pen.Room(way, storey, {xw, y3, xe, y4}, style.ceiling);
  f.west = pen.Room(storey == 0 ? T::kLobby : T::kGallery, storey, {0, y1, xw, y4}, style.ceiling);
  f.east = pen.Room(style.east_room, storey, {xe, y1, w, y4}, style.ceiling);
  const T middle = style.hall ? T::kAtrium : style.east_room;
  const float ceiling = style.hall ? 0 : style.ceiling;
  f.atrium_west = pen.Room(middle, storey, {xw, y2, xb - style.bridge / 2, y3}, ceiling);
  f.bridge = pen.Room(way, storey, {xb - style.bridge / 2, y2, xb + style.bridge / 2, y3}, style.ceiling);
  f.atrium_east = pen.Room(middle, storey, {xb + style.bridge / 2, y2, xe, y3}, ceiling);
  if (style.hall) {
    MakeAtrium(pen, f.atrium_west);
    MakeAtrium(pen, f.atrium_east);
  }
  for (const int room : f.north) {
    if (pen.room(room).type == T::kStairwell) MakeStairwell(pen, room);
    if (pen.room(room).type == T::kLiftShaft)
      pen.room(room).has_floor = storey == 0, pen.room(room).has_ceiling = storey + 1 == static_cast<int>(pen.plan().spec.storeys);
  }
  return f;
}

void OpenHall(PlanPen& pen, const GalleryStyle& style, const GalleryFloor& f, int storey) {
  const WallKind edge = storey == 0 || !style.hall ? WallKind::kOpen : WallKind::kBalustrade;
  for (const int hall : {f.atrium_west, f.atrium_east})
    for (const int beside : {f.way_south, f.way_north, f.bridge, f.west, f.east}) pen.Between(hall, beside, edge);
  for (const int way : {f.way_south, f.way_north})
    for (const int beside : {f.bridge, f.west}) pen.Between(way, beside, WallKind::kOpen);
}

// The ways that a room of a row touches, the one along the gallery first.
int WayBefore(PlanPen& pen, const GalleryFloor& f, int room, bool south) {
  const float x = pen.room(room).cell.center().x;
  if (x < pen.room(f.west).cell.x1) return f.west;
  if (x > pen.room(f.east).cell.x0) return f.east;
  return south ? f.way_south : f.way_north;
}

void OpenRow(PlanPen& pen, const GalleryStyle& style, const GalleryFloor& f, const std::vector<int>& row, bool south) {
  for (const int room : row) {
    const int way = WayBefore(pen, f, room, south);
    switch (pen.room(room).type) {
      case T::kStairwell:
        pen.Door(room, way, 1.2f, 0.5f);
        break;
      case T::kLiftShaft:
        pen.Door(room, way, 1.3f, 0.5f, OpeningKind::kLiftDoor, 2.1f);
        break;
      case T::kToilet:
        pen.Door(room, way, 1.0f, 0.3f, OpeningKind::kPassage, 2.2f);
        break;
      default:
        pen.Door(room, way, style.shopfronts ? 3.0f : 1.8f, static_cast<float>(pen.rng().Uniform(0.2, 0.8)),
                 style.shopfronts ? OpeningKind::kPassage : OpeningKind::kDoubleDoor, style.shopfronts ? 2.8f : 2.2f);
        if (style.shopfronts)
          pen.Glaze(room, way, 0.08f, 2.8f);
        else
          pen.Between(room, way, WallKind::kGlassPartition);
    }
  }
}

void OpenFacades(PlanPen& pen, const GalleryStyle& style, const GalleryFloor& f, int storey) {
  if (storey == 0) {
    pen.OuterDoor(f.west, PlanSide::kWest, 3.2f, 0.5f, OpeningKind::kSlidingDoor, 2.6f);
    pen.OuterDoor(f.west, PlanSide::kWest, 1.8f, 0.2f, OpeningKind::kDoubleDoor, 2.4f);
  }
  const float head = std::min(pen.height() - kSlab - 0.3f, style.ceiling > 0 ? style.ceiling - 0.1f : 99.0f);
  pen.Windows(f.west, PlanSide::kWest, 1.9f, 2.1f, 0.15f, head, OpeningKind::kGlazing);
  pen.Windows(f.east, PlanSide::kEast, 2.2f, 2.6f, 0.6f, head);
  if (style.shopfronts && storey == 0) return;
  for (const int room : f.south) pen.Windows(room, PlanSide::kSouth, 2.0f, 3.0f, 0.8f, head);
  for (const int room : f.north)
    if (pen.room(room).type == style.room || pen.room(room).type == T::kBookStacks)
      pen.Windows(room, PlanSide::kNorth, 2.0f, 3.0f, 0.8f, head);
}

// Side by side in the western hall, one up and one down, to the edge of the bridge.
void AddEscalators(PlanPen& pen, const GalleryFloor& f, const GalleryFloor& above) {
  const PlanRect hall = pen.room(f.atrium_west).cell;
  const float run = pen.height() / 0.57735f + 2.4f, y = hall.center().y;
  for (const float side : {-1.0f, 1.0f}) {
    const float y0 = y + side * 1.0f - 0.8f;
    pen.plan().escalators.push_back(
        {{hall.x1 - run, y0, hall.x1, y0 + 1.6f}, pen.room(f.atrium_west).floor_z, pen.room(above.atrium_west).floor_z, true, false});
  }
  pen.Gap(above.atrium_west, above.bridge, y - 1.8f, y + 1.8f);
}

void PlanGalleries(PlanPen& pen, const GalleryStyle& style) {
  const float w = static_cast<float>(pen.plan().spec.width);
  std::vector<GalleryFloor> floors;
  const std::vector<StripRoom> north = Row(pen, style, w, 1, true);
  for (int s = 0; s < static_cast<int>(pen.plan().spec.storeys); ++s)
    floors.push_back(PlanFloor(pen, style, s, Row(pen, style, w, s, false), north));
  pen.FindWalls();
  for (size_t s = 0; s < floors.size(); ++s) {
    const int storey = static_cast<int>(s);
    OpenHall(pen, style, floors[s], storey);
    OpenRow(pen, style, floors[s], floors[s].south, true);
    OpenRow(pen, style, floors[s], floors[s].north, false);
    if (!style.shopfronts) {
      for (const int way : {floors[s].way_south, floors[s].way_north}) pen.Door(floors[s].east, way, 1.8f, 0.5f, OpeningKind::kDoubleDoor);
      if (storey == 0) pen.Door(floors[s].east, floors[s].atrium_east, 2.4f, 0.5f, OpeningKind::kPassage, 2.4f);
    } else {
      for (const int way : {floors[s].way_south, floors[s].way_north}) pen.Between(floors[s].east, way, WallKind::kOpen);
    }
    OpenFacades(pen, style, floors[s], storey);
  }
  if (style.escalators && floors.size() > 1) AddEscalators(pen, floors[0], floors[1]);
  // Columns along the edges of the galleries.
  const PlanRect south = pen.room(floors[0].way_south).cell, north_way = pen.room(floors[0].way_north).cell;
  const int spans = std::max(2, static_cast<int>(south.width() / 9));
  for (int i = 0; i <= spans; ++i) {
    const float x = south.x0 + 0.4f + (south.width() - 0.8f) * static_cast<float>(i) / static_cast<float>(spans);
    pen.plan().columns.push_back({x, south.y1 - 0.5f});
    pen.plan().columns.push_back({x, north_way.y0 + 0.5f});
  }
  pen.plan().column = 0.5f;
}

}  // namespace

void PlanMall(PlanPen& pen) {
  PlanGalleries(pen, {.strip = 10,
                      .gallery = 4.2f,
                      .west = 9,
                      .east = 13,
                      .bridge = 6,
                      .ceiling = 3.7f,
                      .room = T::kShop,
                      .ground_way = T::kConcourse,
                      .east_room = T::kFoodCourt,
                      .shopfronts = true,
                      .escalators = true,
                      .hall = true});
}

void PlanLibrary(PlanPen& pen) {
  PlanGalleries(pen, {.strip = 7,
                      .gallery = 2.8f,
                      .west = 7,
                      .east = 9,
                      .bridge = 3,
                      .ceiling = 3.4f,
                      .room = T::kReadingRoom,
                      .ground_way = T::kGallery,
                      .east_room = T::kReadingRoom,
                      .shopfronts = false,
                      .escalators = false,
                      .hall = pen.plan().spec.atrium});
}

}  // namespace airsim360::internal
