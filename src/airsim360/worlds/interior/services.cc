// What hangs under ceilings and on walls for light, air and safety: lamps by the use of the room, vents, ducts, sprinklers, signs.
#include <algorithm>
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/interior/furnisher.h"

namespace airsim360::internal {
namespace {

// Lamps of a room: a grid with about so many metres between them.
struct Lighting {
  const char* lamp = nullptr;
  float pitch_x = 0, pitch_y = 0;
  float drop = 0;  ///< metres below the ceiling
};

Lighting LightingOf(const InteriorPlan& plan, const PlanRoom& room) {
  using T = RoomType;
  const bool home = plan.spec.use == BuildingUse::kApartment;
  switch (room.type) {
    case T::kLivingRoom:
      return {"pendant_lamp", 2.9f, 2.9f};
    case T::kDiningRoom:
    case T::kBedroom:
    case T::kChildRoom:
    case T::kStudy:
      return {"pendant_lamp", 9, 9};
    case T::kKitchen:
    case T::kBathroom:
    case T::kToilet:
      if (home) return {"downlight", 1.3f, 1.4f};
      return {"ceiling_panel", 2.4f, 2.4f};
    case T::kHall:
    case T::kStorage:
      return {"downlight", 1.4f, 1.6f};
    case T::kCorridor:
      return home ? Lighting{"downlight", 1.9f, 1.9f} : Lighting{"downlight", 1.6f, 1.6f};
    case T::kOpenOffice:
    case T::kCellOffice:
    case T::kPrintRoom:
    case T::kDispatchOffice:
      return {"ceiling_panel", 2.4f, 2.4f};
    case T::kMeetingRoom:
    case T::kPantry:
    case T::kBreakRoom:
      return {"ceiling_panel", 2.4f, 2.4f};
    case T::kReadingRoom:
    case T::kBookStacks:
      return {"ceiling_panel", 2.4f, 2.4f};
    case T::kWarehouseHall:
      return {"high_bay_lamp", 5.6f, 7.5f, 0.8f};
    case T::kParkingDeck:
      return {"tube_light", 7.5f, 4.2f, 0.02f};
    case T::kRamp:
      return {"tube_light", 9, 6, 0.02f};
    case T::kStairwell:
      return {"tube_light", 9, 4};
    case T::kShop:
      return {"downlight", 1.5f, 1.5f};
    case T::kSupermarket:
      return {"ceiling_panel", 2.4f, 2.4f};
    case T::kFoodCourt:
      return {"pendant_lamp", 2.6f, 2.6f};
    case T::kConcourse:
    case T::kGallery:
    case T::kLobby:
      return {"downlight", 1.7f, 1.7f};
    case T::kAtrium:
      return {"downlight", 2.6f, 2.6f};
    case T::kLiftShaft:
      break;
  }
  return {};
}

// Middles of a grid over a rectangle.
template <class Visit>
void Grid(const PlanRect& r, float pitch_x, float pitch_y, const Visit& visit) {
  const int nx = std::max(1, static_cast<int>(std::lround(r.width() / pitch_x))),
            ny = std::max(1, static_cast<int>(std::lround(r.depth() / pitch_y)));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      visit(Vec2f{r.x0 + r.width() * (static_cast<float>(i) + 0.5f) / static_cast<float>(nx),
                  r.y0 + r.depth() * (static_cast<float>(j) + 0.5f) / static_cast<float>(ny)});
}

bool UnderSkylight(const PlanRoom& room, Vec2f p, float margin) {
  return std::any_of(room.skylights.begin(), room.skylights.end(), [&](const PlanRect& hole) { return hole.Inset(-margin).Contains(p); });
}

void HangLamps(const InteriorPlan& plan, const PlanRoom& room, float ceiling, Furnisher& furnisher) {
  const Lighting lighting = LightingOf(plan, room);
  if (!lighting.lamp) return;
  const std::string_view lamp = lighting.lamp;
  const bool tube = lamp == "tube_light", panel = lamp == "ceiling_panel";
  // One model in all of the house; of downlights those that burn by day too, as in rooms without windows.
  const uint32_t models = tube || panel ? 1 : lamp == "downlight" ? 2 : furnisher.Variants(lamp);
  const uint32_t variant = RngStream(plan.seed, "lamp of the house").Index(models);
  // Rooms smaller than a lamp have none.
  const Vec3f size = furnisher.BoxOf(lighting.lamp, variant).size();
  if (std::min(room.clear.width(), room.clear.depth()) < std::min(size.x, size.y) + 0.1f) return;
  Grid(room.clear, lighting.pitch_x, lighting.pitch_y, [&](Vec2f p) {
    if (UnderSkylight(room, p, 0.5f)) return;
    // Panels take the place of a tile of the ceiling.
    if (panel) p = {std::floor(p.x / 0.6f) * 0.6f + 0.3f, std::floor(p.y / 0.6f) * 0.6f + 0.3f};
    furnisher.Hang(lighting.lamp, {p.x, p.y, ceiling - lighting.drop}, tube && room.clear.depth() > room.clear.width() ? kPiF / 2 : 0,
                   variant);
  });
}

bool HasSprinklers(const InteriorPlan& plan) { return plan.spec.use != BuildingUse::kApartment; }

// Every 3 to 4 m, as EN 12845 asks of ordinary hazards, between the lamps.
void HangSafety(const InteriorPlan& plan, const PlanRoom& room, float ceiling, Furnisher& furnisher) {
  const bool big = room.clear.area() > 400;
  if (HasSprinklers(plan) && room.type != RoomType::kLiftShaft && room.type != RoomType::kStairwell)
    Grid(room.clear, big ? 5.0f : 3.4f, big ? 5.0f : 3.4f, [&](Vec2f p) {
      if (!UnderSkylight(room, p, 0.2f)) furnisher.Hang("sprinkler", {p.x + 0.62f, p.y + 0.4f, ceiling});
    });
  if (room.clear.width() > 1.6f && room.clear.depth() > 1.6f && room.type != RoomType::kBathroom)
    furnisher.Hang("smoke_detector", {room.clear.center().x + 0.5f, room.clear.center().y + 0.75f, ceiling});
  const bool aired = !HasSprinklers(plan)
                         ? room.type == RoomType::kBathroom || room.type == RoomType::kToilet || room.type == RoomType::kKitchen
                         : room.ceiling_z - room.floor_z < 4;
  if (aired && plan.spec.use != BuildingUse::kCarPark && room.clear.width() > 1.8f && room.clear.depth() > 1.8f)
    Grid(room.clear, 4.8f, 4.8f, [&](Vec2f p) { furnisher.Hang("air_vent", {p.x - 0.6f, p.y - 0.55f, ceiling}); });
}

// Ducts and pipes along a hall or deck.
void HangDucts(const PlanRoom& room, float ceiling, Furnisher& furnisher) {
  const bool hall = room.type == RoomType::kWarehouseHall, deck = room.type == RoomType::kParkingDeck && room.clear.width() > 20;
  if (!hall && !deck) return;
  const Vec3f duct = furnisher.BoxOf("duct", 0).size();
  const bool long_x = duct.x >= duct.y;
  const float length = std::max(duct.x, duct.y), drop = hall ? 1.2f : 0.02f;
  const auto run = [&](const char* kind, float y, float below) {
    for (float x = room.clear.x0 + 1.2f + length / 2; x + length / 2 < room.clear.x1 - 0.5f; x += length)
      furnisher.Hang(kind, {x, y, ceiling - below}, long_x ? 0 : kPiF / 2, 0);
  };
  if (hall) {
    run("duct", room.clear.y0 + 4.0f, drop);
    run("duct", room.clear.y1 - 2.0f, drop);
  } else {
    // Above the bays, where it is in nobody's way.
    run("duct", room.clear.y0 + 1.2f, 0.4f);
    run("duct", room.clear.y1 - 1.2f, 0.4f);
  }
}

// A sign above doors that lead out or to stairs, an extinguisher beside every second.
void HangSigns(const InteriorPlan& plan, Furnisher& furnisher) {
  if (plan.spec.use == BuildingUse::kApartment) return;
  int doors = 0;
  for (const PlanWall& wall : plan.walls) {
    for (const PlanOpening& o : wall.openings) {
      if (!IsDoor(o.kind) || o.kind == OpeningKind::kDockDoor || o.kind == OpeningKind::kLiftDoor) continue;
      const auto stairs = [&](int r) { return r >= 0 && plan.rooms[static_cast<size_t>(r)].type == RoomType::kStairwell; };
      const bool way_out = o.outer || stairs(wall.low) || stairs(wall.high);
      if (!way_out && ++doors % 4 != 0) continue;
      // On the side from which one leaves.
      const bool to_high = o.outer ? wall.low < 0 : stairs(wall.low);
      const float inward = to_high ? 1.0f : -1.0f, middle = wall.from + (o.from + o.to) / 2, z = plan.StoreyZ(wall.storey);
      const float yaw = wall.along_x ? (to_high ? kPiF : 0) : (to_high ? kPiF / 2 : -kPiF / 2);
      const auto at = [&](float along, float across) {
        return wall.along_x ? Vec2f{along, wall.at + inward * across} : Vec2f{wall.at + inward * across, along};
      };
      if (way_out) {
        const Vec2f p = at(middle, kHalfWall + 0.06f + (o.kind == OpeningKind::kSlidingDoor ? 0.12f : 0.0f));
        furnisher.Put("exit_sign", {p.x, p.y, z + o.head + 0.03f}, yaw, 0);
      }
      const float beside = wall.from + o.to + 0.45f;
      if (beside + 0.3f > wall.to || (wall.low < 0 ? false : wall.kind == WallKind::kGlassPartition)) continue;
      const bool clear = std::none_of(wall.openings.begin(), wall.openings.end(), [&](const PlanOpening& w) {
        return &w != &o && beside > wall.from + w.from - 0.2f && beside < wall.from + w.to + 0.2f;
      });
      const Vec2f p = at(beside, kHalfWall + furnisher.BoxOf("fire_extinguisher", 0).size().y / 2 + 0.01f);
      if (clear) furnisher.Put("fire_extinguisher", {p.x, p.y, z + 0.9f}, yaw, 0);
    }
  }
}

}  // namespace

void InstallServices(const InteriorPlan& plan, Furnisher& furnisher) {
  for (const PlanRoom& room : plan.rooms) {
    if (!room.has_ceiling || room.type == RoomType::kLiftShaft) continue;
    // The lamps of a hall through several storeys hang below its roof.
    const float ceiling = room.has_floor ? room.ceiling_z : plan.StoreyZ(room.storey + 1) - kSlab;
    HangLamps(plan, room, ceiling, furnisher);
    HangSafety(plan, room, ceiling, furnisher);
    HangDucts(room, ceiling, furnisher);
  }
  HangSigns(plan, furnisher);
}

}  // namespace airsim360::internal
