// Columns, beams and frames, and the markings of decks and halls.
#include <algorithm>

#include "airsim360/worlds/interior/deck_bays.h"
#include "airsim360/worlds/interior/interior.h"

namespace airsim360::internal {
namespace {

void BuildColumns(const InteriorPlan& plan, InteriorPen& pen) {
  const bool deck = plan.spec.use == BuildingUse::kCarPark, steel = plan.spec.use == BuildingUse::kWarehouse;
  for (const Vec2f& c : plan.columns) {
    for (int s = 0; s < static_cast<int>(plan.spec.storeys); ++s) {
      const float z0 = plan.StoreyZ(s), z1 = plan.StoreyZ(s + 1) - kSlab, h = plan.column / 2;
      pen.Start("column", "construction/column");
      pen.Use(deck ? Finish::kConcreteWall : steel ? Finish::kSteelGrey : Finish::kPlasterWhite);
      if (steel) {  // an H
        pen.Box({c.x - h, c.y - h, z0}, {c.x + h, c.y - h + 0.03f, z1});
        pen.Box({c.x - h, c.y + h - 0.03f, z0}, {c.x + h, c.y + h, z1});
        pen.Box({c.x - 0.015f, c.y - h + 0.03f, z0}, {c.x + 0.015f, c.y + h - 0.03f, z1});
      } else {
        pen.Box({c.x - h, c.y - h, z0}, {c.x + h, c.y + h, z1});
      }
      if (!deck && !steel) continue;
      // Yellow and black bands where vehicles come near.
      for (int band = 0; band < 4; ++band) {
        pen.Use(band % 2 ? Finish::kPaintBlack : Finish::kPaintYellow);
        const float z = z0 + 0.1f + 0.25f * static_cast<float>(band), e = h + 0.006f;
        pen.Box({c.x - e, c.y - e, z}, {c.x + e, c.y + e, z + 0.25f});
      }
    }
  }
}

// Along the lines of columns with the same x, from wall to wall.
void BuildBeams(const InteriorPlan& plan, InteriorPen& pen) {
  std::vector<float> lines;
  for (const Vec2f& c : plan.columns)
    if (std::none_of(lines.begin(), lines.end(), [&](float x) { return std::abs(x - c.x) < 0.01f; })) lines.push_back(c.x);
  const bool steel = plan.spec.use == BuildingUse::kWarehouse;
  const float deep = steel ? 0.7f : 0.38f, half = steel ? 0.15f : 0.2f;
  for (int s = 0; s < static_cast<int>(plan.spec.storeys); ++s) {
    const float z1 = plan.StoreyZ(s + 1) - kSlab, z0 = z1 - deep;
    for (const float x : lines) {
      pen.Start("beam", "construction/ceiling");
      pen.Use(steel ? Finish::kSteelGrey : Finish::kCeilingConcrete);
      const float y0 = plan.outline.y0 + kHalfWall, y1 = plan.outline.y1 - kHalfWall;
      if (steel) {
        pen.Box({x - half, y0, z0}, {x + half, y1, z0 + 0.03f});
        pen.Box({x - half, y0, z1 - 0.03f}, {x + half, y1, z1});
        pen.Box({x - 0.012f, y0, z0 + 0.03f}, {x + 0.012f, y1, z1 - 0.03f});
      } else {
        pen.Box({x - half, y0, z0}, {x + half, y1, z1});
      }
    }
    if (!steel) continue;
    // Purlins across.
    pen.Start("purlins", "construction/ceiling");
    for (float y = plan.outline.y0 + 2; y < plan.outline.y1; y += 2.5f)
      pen.Box({plan.outline.x0 + kHalfWall, y - 0.05f, z1 - 0.2f}, {plan.outline.x1 - kHalfWall, y + 0.05f, z1 - 0.02f});
  }
}

void Stripe(InteriorPen& pen, const PlanRect& r, float z) { pen.Level(r, z + 0.004f, true); }

// Lines between the bays of a deck, arrows in its aisles.
void MarkDecks(const InteriorPlan& plan, InteriorPen& pen) {
  for (int s = 0; s < static_cast<int>(plan.spec.storeys); ++s) {
    const float z = plan.StoreyZ(s);
    for (const DeckBay& bay : DeckBays(plan, s)) {
      pen.Start("bay marking", "ground/lane_marking");
      pen.Use(Finish::kPaintWhite);
      const PlanRect r = bay.rect;
      Stripe(pen, {r.x0 - 0.05f, r.y0 + 0.1f, r.x0 + 0.05f, r.y1 - 0.1f}, z);
      Stripe(pen, {r.x1 - 0.05f, r.y0 + 0.1f, r.x1 + 0.05f, r.y1 - 0.1f}, z);
    }
    for (const PlanRect& aisle : DeckAisles(plan)) {
      pen.Start("arrows", "ground/lane_marking");
      pen.Use(Finish::kPaintWhite);
      const float y = aisle.center().y;
      const float dir = y < plan.outline.center().y ? 1.0f : -1.0f;
      for (float x = aisle.x0 + 5; x < aisle.x1 - 4; x += 12) {
        Stripe(pen, {x - 1, y - 0.08f, x + 1, y + 0.08f}, z);
        const Vec3f tip{x + dir * 1.9f, y, z + 0.004f}, a{x + dir * 1.0f, y - 0.4f, z + 0.004f}, b{x + dir * 1.0f, y + 0.4f, z + 0.004f};
        if (dir > 0)
          pen.mesh().Triangle(a, tip, b);
        else
          pen.mesh().Triangle(b, tip, a);
      }
    }
  }
}

// Yellow lines along the ways of fork-lifts, hatched places before the docks.
void MarkHall(const InteriorPlan& plan, InteriorPen& pen) {
  for (const PlanRoom& room : plan.rooms) {
    if (room.type != RoomType::kWarehouseHall) continue;
    const PlanRect r = room.clear;
    pen.Start("floor marking", "ground/lane_marking");
    pen.Use(Finish::kPaintYellow);
    for (const float y : {r.y0 + 7.2f, r.y0 + 10.6f, r.y1 - 2.4f}) Stripe(pen, {r.x0 + 0.6f, y, r.x1 - 0.6f, y + 0.1f}, 0);
    for (const PlanWall& wall : plan.walls) {
      for (const PlanOpening& o : wall.openings) {
        if (o.kind != OpeningKind::kDockDoor) continue;
        const float a = wall.from + o.from, b = wall.from + o.to;
        for (const float x : {a - 0.3f, b + 0.2f}) Stripe(pen, {x, r.y0 + 0.5f, x + 0.1f, r.y0 + 6.4f}, 0);
        for (int i = 0; i < 6; ++i)
          Stripe(pen, {a, r.y0 + 0.6f + 0.3f * static_cast<float>(i), b, r.y0 + 0.7f + 0.3f * static_cast<float>(i)}, 0);
      }
    }
  }
}

}  // namespace

void BuildStructure(const InteriorPlan& plan, InteriorPen& pen) {
  BuildColumns(plan, pen);
  if (plan.spec.use == BuildingUse::kWarehouse || plan.spec.use == BuildingUse::kCarPark) BuildBeams(plan, pen);
  if (plan.spec.use == BuildingUse::kCarPark) MarkDecks(plan, pen);
  MarkHall(plan, pen);
}

}  // namespace airsim360::internal
