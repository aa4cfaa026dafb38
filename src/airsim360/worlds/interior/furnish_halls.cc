// Warehouse halls and parking decks.
#include <cmath>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/interior/deck_bays.h"
#include "airsim360/worlds/interior/furnisher.h"

namespace airsim360::internal {
namespace {

// Double rows of racks along y with ways of 3.3 m for fork-lifts.
void Racks(RoomSpace& s) {
  const Vec3f bay = s.Size("rack_bay");
  const PlanRect r = s.rect();
  const float y0 = r.y0 + 11.2f, y1 = r.y1 - 3.2f, way = 3.3f, pair = 2 * bay.y + 0.2f;
  int number = 0;
  for (float x = r.x0 + 1.4f + pair / 2; x + pair / 2 + 1.2f < r.x1; x += pair + way) {
    for (float y = y0 + bay.x / 2; y + bay.x / 2 < y1; y += bay.x + 0.02f) {
      for (const float side : {-1.0f, 1.0f}) {
        s.At("rack_bay", {x + side * (bay.y + 0.1f) / 2, y}, side > 0 ? kPiF / 2 : -kPiF / 2);
        ++number;
      }
    }
    for (const float end : {y0 - 0.5f, y1 + 0.4f}) s.At("safety_barrier", {x, end}, 0);
  }
}

// Goods that wait before the docks, the machines that move them.
void Staging(RoomSpace& s, double clutter) {
  const PlanRect r = s.rect();
  for (const RoomSpace::Hole& hole : s.holes()) {
    if (hole.kind != OpeningKind::kDockDoor) continue;
    for (const float side : {-1.0f, 1.0f}) {
      for (int i = 0; i < 3; ++i) {
        if (!s.rng().Chance(0.55 + 0.3 * clutter)) continue;
        const Vec2f p = hole.spot.At(side * 2.6f, 1.4f + 1.5f * static_cast<float>(i));
        const double u = s.rng().Uniform();
        s.At(u < 0.35 ? "pallet_stack" : u < 0.75 ? "pallet_stack" : "pallet", p, static_cast<float>(s.rng().Uniform(-0.08, 0.08)));
      }
    }
  }
  for (int i = 0; i < 4; ++i) {
    const Vec2f p{static_cast<float>(s.rng().Uniform(static_cast<double>(r.x0 + 3), static_cast<double>(r.x1 - 3))),
                  r.y0 + static_cast<float>(s.rng().Uniform(7.6, 10.2))};
    s.At("forklift", p, static_cast<float>(s.rng().Uniform(0, 6.28)));
  }
  for (int i = 0; i < 12; ++i) s.AtWall(i % 3 == 0 ? "drum" : i % 3 == 1 ? "pallet_stack" : "pallet_stack");
  for (int i = 0; i < 8; ++i) s.AtWall("box_large");
  for (int i = 0; i < 3; ++i) s.AtWall(i == 0 ? "ladder" : "hand_truck");
  for (int i = 0; i < 5; ++i) s.AtWall("waste_bin_indoor");
  for (int i = 0; i < 2; ++i) s.AtWall("desk_office", 0.8f);
  for (int i = 0; i < 3; ++i) s.AtWall("electric_box");
}

constexpr Vec3f kCarPaints[] = {{1, 1, 1}, {0.9f, 0.9f, 0.92f}, {0.95f, 0.93f, 0.9f}};

}  // namespace

void FurnishHall(RoomSpace& s, const InteriorPlan&, double clutter) {
  Racks(s);
  Staging(s, clutter);
}

void FurnishDecks(const InteriorPlan& plan, Furnisher& furnisher) {
  RngStream rng(plan.seed, "parked cars");
  for (int storey = 0; storey < static_cast<int>(plan.spec.storeys); ++storey) {
    const float z = plan.StoreyZ(storey);
    const double fill = std::min(0.9, (storey == 0 ? 0.8 : 0.6) * (0.5 + 0.5 * plan.spec.clutter));
    for (const DeckBay& bay : DeckBays(plan, storey)) {
      const Vec2f c = bay.rect.center();
      const float nose = bay.nose_north ? 1.0f : -1.0f;
      furnisher.Put("wheel_stop", {c.x, c.y + nose * 2.05f, z}, bay.nose_north ? kPiF : 0, 0);
      if (!rng.Chance(fill)) continue;
      // Nose (-Y of a car) in, or backed in.
      const float yaw = (bay.nose_north != rng.Chance(0.25) ? kPiF : 0) + static_cast<float>(rng.Uniform(-0.03, 0.03));
      const bool van = rng.Chance(0.08);
      const char* kind = van ? "van" : "car";
      const uint32_t variant = rng.Index(furnisher.Variants(kind));
      const Vec3f size = furnisher.BoxOf(kind, variant).size();
      if (size.y > kBayDepth + 0.4f || size.z > 2.1f) continue;
      furnisher.Put(kind, {c.x + static_cast<float>(rng.Uniform(-0.12, 0.12)), c.y + static_cast<float>(rng.Uniform(-0.15, 0.1)), z}, yaw,
                    variant, kCarPaints[rng.Index(3)]);
    }
    for (size_t i = 0; i < plan.columns.size(); ++i) {
      const Vec2f c = plan.columns[i];
      if (i % 4 == 0) furnisher.Put("parking_sign", {c.x, c.y - plan.column / 2 - 0.03f, z + 1.7f}, 0, 0);
      if (i % 5 == 1) furnisher.Put("fire_extinguisher", {c.x, c.y + plan.column / 2 + 0.08f, z + 0.9f}, kPiF, 0);
    }
    furnisher.Put("ticket_machine", {6.3f, plan.outline.y1 - 7.0f, z}, kPiF / 2, 0);
    for (const PlanRect& aisle : DeckAisles(plan)) {
      const int cones = 1 + static_cast<int>(rng.Index(3));
      for (int i = 0; i < cones; ++i)
        furnisher.Put("traffic_cone",
                      {static_cast<float>(rng.Uniform(static_cast<double>(aisle.x0), static_cast<double>(aisle.x1))), aisle.y0 + 0.5f, z},
                      0, 0);
      furnisher.Put("trash_can", {aisle.x1 - 1, aisle.y1 + 0.2f, z}, 0, 0);
    }
  }
}

}  // namespace airsim360::internal
