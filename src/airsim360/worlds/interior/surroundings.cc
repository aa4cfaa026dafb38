#include "airsim360/worlds/interior/surroundings.h"

#include <cmath>
#include <numbers>

#include "airsim360/math/angles.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360::internal {
namespace {

constexpr float kApron = 3.0f, kVerge = 9.0f, kRoad = 7.5f, kWalk = 2.5f;

class Outside {
 public:
  Outside(const InteriorPlan& plan, InteriorPen& pen, Furnisher& furnisher)
      : plan_(plan),
        pen_(pen),
        furnisher_(furnisher),
        surfaces_(AddSurfaces(pen.builder())),
        rng_(plan.seed, "surroundings"),
        house_(plan.outline.Inset(-kOuterWall)) {}

  void Build() {
    LayGround();
    LayStreet();
    RaiseHouses();
    Plant();
  }

 private:
  PlanRect Ring(float d) const { return house_.Inset(-d); }
  float StreetY() const { return house_.y0 - kApron - kVerge - kWalk; }  // northern kerb

  // `outer` without `inner`.
  void Frame(const PlanRect& outer, const PlanRect& inner, float z) {
    pen_.Level({outer.x0, outer.y0, outer.x1, inner.y0}, z, true);
    pen_.Level({outer.x0, inner.y1, outer.x1, outer.y1}, z, true);
    pen_.Level({outer.x0, inner.y0, inner.x0, inner.y1}, z, true);
    pen_.Level({inner.x1, inner.y0, outer.x1, inner.y1}, z, true);
  }

  void LayGround() {
    const bool yard = plan_.spec.use == BuildingUse::kWarehouse || plan_.spec.use == BuildingUse::kCarPark;
    pen_.Start("apron", "ground/pavement/modular");
    pen_.Use(surfaces_[yard ? Surface::kConcrete : Surface::kSlabs]);
    Frame(Ring(kApron), house_, kOutsideZ);
    pen_.Start("lawn", yard ? "ground/pavement" : "ground/grass");
    pen_.Use(surfaces_[yard ? Surface::kAsphaltOld : Surface::kLawn]);
    const PlanRect plot = {house_.x0 - 24, StreetY() + kWalk, house_.x1 + 24, house_.y1 + 26};
    Frame(plot, Ring(kApron), kOutsideZ - 0.01f);
    pen_.Start("plain", "ground/terrain/landscape");
    pen_.Use(surfaces_[Surface::kPlain]);
    const Vec2f c = house_.center();
    // Two sheets, so that the far one need not be fine; below all that lies on them.
    pen_.Level({c.x - 3000, c.y - 3000, c.x + 3000, c.y + 3000}, kOutsideZ - 0.3f, true);
    pen_.Start("path", "ground/path/park_walkway");
    pen_.Use(surfaces_[Surface::kSlabsWarm]);
    for (const PlanWall& wall : plan_.walls) {
      for (const PlanOpening& o : wall.openings) {
        if (!o.outer || (!IsDoor(o.kind) && o.kind != OpeningKind::kPassage) || wall.storey > 0 || wall.low >= 0 || !wall.along_x) continue;
        const float x = wall.from + (o.from + o.to) / 2, half = (o.to - o.from) / 2 + 0.3f;
        pen_.Level({x - half, StreetY() + kWalk, x + half, house_.y0 - kApron}, kOutsideZ + 0.004f, true);
      }
    }
  }

  void LayStreet() {
    const float y = StreetY(), x0 = house_.center().x - 260, x1 = house_.center().x + 260;
    for (const auto& [name, from] : {std::pair{"pavement north", y}, {"pavement south", y - kRoad - kWalk}}) {
      pen_.Start(name, "ground/sidewalk");
      pen_.Use(surfaces_[Surface::kSlabs]);
      pen_.Level({x0, from, x1, from + kWalk}, kOutsideZ + 0.02f, true);
      pen_.Use(surfaces_[Surface::kKerb]);
      const bool north = from == y;
      const float edge = north ? from : from + kWalk;
      pen_.Box({x0, edge - 0.08f, kOutsideZ - 0.12f}, {x1, edge + 0.08f, kOutsideZ + 0.022f});
    }
    pen_.Start("road", "ground/road");
    pen_.Use(surfaces_[Surface::kAsphalt]);
    pen_.Level({x0, y - kRoad, x1, y}, kOutsideZ - 0.1f, true);
    pen_.Start("lane marking", "ground/lane_marking");
    pen_.Use(surfaces_[Surface::kPaintWhite]);
    for (float x = x0; x < x1; x += 9) pen_.Level({x, y - kRoad / 2 - 0.06f, x + 3, y - kRoad / 2 + 0.06f}, kOutsideZ - 0.092f, true);
    for (float x = x0 + 120; x < x1 - 120; x += static_cast<float>(rng_.Uniform(6, 13))) {
      if (!rng_.Chance(0.7)) continue;
      furnisher_.Put("car", {x, y - 1.15f, kOutsideZ - 0.1f}, kPiF / 2, rng_.Index(furnisher_.Variants("car")));
    }
    for (float x = x0 + 110; x < x1 - 110; x += 24) furnisher_.Put("street_light", {x, y - kRoad - 0.5f, kOutsideZ}, 0, 0);
  }

  void House(const PlanRect& r, float height) {
    constexpr Surface kWalls[] = {Surface::kFarWalls0, Surface::kFarWalls1, Surface::kFarWalls2,
                                  Surface::kFarWalls3, Surface::kFarPiers0, Surface::kFarRibbons0};
    pen_.Start("house", "construction/building");
    pen_.Use(surfaces_[kWalls[rng_.Index(6)]]);
    const Vec2f outline[] = {{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}};
    pen_.mesh().Walls(outline, kOutsideZ - 0.3f, height);
    pen_.Start("house roof", "construction/building/roof");
    pen_.Use(surfaces_[Surface::kFarRoof]);
    pen_.Level(r, height, true);
  }

  // A closed row across the street, single houses behind and beside.
  void RaiseHouses() {
    const float front = StreetY() - kRoad - 2 * kWalk - 3, cx = house_.center().x;
    float x = cx - 150;
    while (x < cx + 150) {
      const float w = static_cast<float>(rng_.Uniform(10, 22)), storeys = static_cast<float>(2 + rng_.Index(5));
      House({x, front - 14, x + w, front}, kOutsideZ + 3 * storeys);
      x += w + (rng_.Chance(0.2) ? 6.0f : 0.02f);
    }
    for (const float side : {-1.0f, 1.0f}) {
      for (float y = front; y < house_.y1 + 90; y += 30) {
        const float near = (side < 0 ? house_.x0 : house_.x1) + side * static_cast<float>(rng_.Uniform(30, 40)),
                    w = static_cast<float>(rng_.Uniform(12, 20));
        House({side < 0 ? near - w : near, y, side < 0 ? near : near + w, y + 18}, kOutsideZ + 3 * static_cast<float>(2 + rng_.Index(4)));
      }
    }
    for (int ring = 0; ring < 60; ++ring) {
      const double a = rng_.Uniform(0, 2 * std::numbers::pi), r = rng_.Uniform(150, 420);
      const Vec2f p = house_.center() + Vec2f{static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a))};
      if (std::abs(p.y - (StreetY() - kRoad / 2)) < 30) continue;
      const float w = static_cast<float>(rng_.Uniform(14, 34)) / 2, d = static_cast<float>(rng_.Uniform(12, 24)) / 2;
      House({p.x - w, p.y - d, p.x + w, p.y + d}, kOutsideZ + 3 * static_cast<float>(3 + rng_.Index(9)));
    }
    for (float hx = cx - 145; hx < cx + 150; hx += 28)
      House({hx, house_.y1 + 60, hx + 24, house_.y1 + 74}, kOutsideZ + 3 * static_cast<float>(2 + rng_.Index(4)));
  }

  void Plant() {
    const auto tree = [&](Vec2f p) {
      constexpr const char* kKinds[] = {"tree_generic", "tree_narrowleaf", "tree_generic", "red_tree"};
      const char* kind = kKinds[rng_.Index(4)];
      furnisher_.Put(kind, {p.x, p.y, kOutsideZ - 0.02f}, static_cast<float>(rng_.Uniform(0, 6)), rng_.Index(furnisher_.Variants(kind)));
    };
    const bool yard = plan_.spec.use == BuildingUse::kWarehouse;
    for (float x = house_.x0 - 40; x < house_.x1 + 40; x += 11)
      tree({x + static_cast<float>(rng_.Uniform(-1, 1)), StreetY() - kRoad - 1.2f});
    for (float x = house_.x0 - 20; x < house_.x1 + 20; x += 9) {
      if (!yard && rng_.Chance(0.6)) tree({x, house_.y0 - kApron - kVerge * 0.6f});
      if (rng_.Chance(0.7)) tree({x, house_.y1 + static_cast<float>(rng_.Uniform(10, 22))});
    }
    if (yard) return;
    for (const float side : {-1.0f, 1.0f})
      for (float y = house_.y0 - 6; y < house_.y1 + 12; y += 8)
        tree({(side < 0 ? house_.x0 : house_.x1) + side * static_cast<float>(rng_.Uniform(9, 18)), y});
    for (float x = house_.x0 - 15; x < house_.x1 + 15; x += 2.1f)
      furnisher_.Put("hedge", {x, StreetY() + kWalk + 0.5f, kOutsideZ - 0.02f}, 0, rng_.Index(furnisher_.Variants("hedge")));
    for (int i = 0; i < 40; ++i) {
      const bool north = rng_.Chance(0.6);
      const Vec2f p{static_cast<float>(rng_.Uniform(static_cast<double>(house_.x0 - 12), static_cast<double>(house_.x1 + 12))),
                    north ? house_.y1 + static_cast<float>(rng_.Uniform(4, 9)) : house_.y0 - static_cast<float>(rng_.Uniform(4, 6))};
      furnisher_.Put(rng_.Chance(0.5) ? "shrub" : "flower_bed", {p.x, p.y, kOutsideZ - 0.01f}, 0, rng_.Index(3));
    }
  }

  const InteriorPlan& plan_;
  InteriorPen& pen_;
  Furnisher& furnisher_;
  Surfaces surfaces_;
  RngStream rng_;
  PlanRect house_;
};

}  // namespace

void BuildSurroundings(const InteriorPlan& plan, InteriorPen& pen, Furnisher& furnisher) { Outside(plan, pen, furnisher).Build(); }

}  // namespace airsim360::internal
