#include "airsim360/worlds/building/roof_clutter.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/building/facade.h"
#include "airsim360/worlds/props/placer.h"

namespace airsim360::internal {
namespace {

constexpr float kQuarterTurn = 6.2831853f / 4;

void Bulkhead(MeshBuilder& mesh, const Surfaces& surfaces, const BuildingPlan& plan, Vec2f at, EntityId building) {
  const float z = plan.height();
  mesh.SetEntity(building);
  mesh.SetMaterial(surfaces[WallSurfaceOf(plan)]);
  mesh.Box({at.x - 1.7f, at.y - 1.4f, z}, {at.x + 1.7f, at.y + 1.4f, z + 2.7f},
           MeshBuilder::kLeft | MeshBuilder::kRight | MeshBuilder::kFront | MeshBuilder::kBack);
  mesh.SetMaterial(surfaces[Surface::kCoping]);
  mesh.Box({at.x - 1.85f, at.y - 1.55f, z + 2.7f}, {at.x + 1.85f, at.y + 1.55f, z + 2.85f});
  mesh.SetMaterial(surfaces[Surface::kDoorGreen]);
  mesh.Box({at.x - 0.5f, at.y - 1.44f, z}, {at.x + 0.5f, at.y - 1.40f, z + 2.1f},
           MeshBuilder::kFront | MeshBuilder::kTop | MeshBuilder::kLeft | MeshBuilder::kRight);
}

// On the narrow deck of a row house: a hatch over the stairs, chimneys at the shared walls, a skylight, vents.
void HouseClutter(MeshBuilder& mesh, const Surfaces& surfaces, PropShelf& shelf, const BuildingPlan& plan, EntityId building,
                  EntityId roof) {
  RngStream rng(plan.seed, "house roof");
  const GroundRect r = plan.bounds().Inset(kParapetThickness);
  const auto uniform = [&](float a, float b) { return static_cast<float>(rng.Uniform(a, b)); };
  if (r.width() < 3 || r.depth() < 6) return;
  const float z = plan.height(), third = r.depth() / 3;
  constexpr unsigned kSides = MeshBuilder::kLeft | MeshBuilder::kRight | MeshBuilder::kFront | MeshBuilder::kBack;
  const auto box = [&](Surface surface, Vec2f at, Vec2f half, float z0, float z1, bool top) {
    mesh.SetMaterial(surfaces[surface]);
    mesh.Box({at.x - half.x, at.y - half.y, z0}, {at.x + half.x, at.y + half.y, z1}, kSides | (top ? MeshBuilder::kTop : 0u));
  };
  // The hatch in the middle third, chimneys in the outer ones.
  const float cx = r.center().x, y = r.y0 + third * uniform(1.2f, 1.8f);
  mesh.SetEntity(building);
  const Vec2f hatch{cx + uniform(-0.3f, 0.3f) * (r.width() - 2), y};
  box(WallSurfaceOf(plan), hatch, {0.65f, 1.2f}, z, z + 2.2f, false);
  box(Surface::kCoping, hatch, {0.75f, 1.3f}, z + 2.2f, z + 2.3f, true);
  box(rng.Chance(0.5) ? Surface::kDoorGreen : Surface::kFrameDark, hatch - Vec2f{0, 0.02f}, {0.4f, 1.21f}, z, z + 1.95f, true);
  for (int i = 0; i < 2; ++i) {
    const Vec2f at{i == 0 ? r.x0 + 0.45f : r.x1 - 0.45f, r.y0 + third * (i == 0 ? uniform(0.3f, 0.9f) : uniform(2.1f, 2.7f))};
    if (rng.Chance(0.25)) continue;
    box(Surface::kBrickBrown, at, {0.3f, uniform(0.4f, 0.9f)}, z, z + uniform(1.5f, 2.2f), true);
    box(Surface::kBrickRed, at, {0.12f, 0.12f}, z + 1.5f, z + 2.5f, true);
  }
  mesh.SetEntity(roof);
  const Vec2f light{cx + uniform(-0.6f, 0.6f), r.y0 + third * (rng.Chance(0.5) ? 0.5f : 2.5f)};
  box(Surface::kMetal, light, {0.55f, 0.8f}, z, z + 0.3f, false);
  box(Surface::kGlassBlue, light, {0.5f, 0.75f}, z + 0.3f, z + 0.38f, true);
  for (float t : {0.15f, 0.85f})
    shelf.Place("roof_vent", {cx + uniform(-0.25f, 0.25f) * r.width(), r.y0 + r.depth() * t, z}, 0, rng.Index(3));
  if (rng.Chance(0.35)) shelf.Place("antenna", {r.x1 - 0.6f, r.y0 + third * 1.1f, z}, 0, rng.Index(3));
}

// The wide deck of one building as it fills up.
class Deck {
 public:
  Deck(MeshBuilder& mesh, const Surfaces& surfaces, PropShelf& shelf, const BuildingPlan& plan, EntityId building, EntityId roof)
      : mesh_(mesh), surfaces_(surfaces), shelf_(shelf), plan_(plan), building_(building), roof_(roof), rng_(plan.seed, "roof clutter") {}

  bool wide() const { return area_.width() >= 5 && area_.depth() >= 5; }
  void ReserveStairs();
  void PlaceMachines();
  void LayDuct();
  void AddSkylights();

 private:
  bool Inside(Vec2f p) const;
  Vec2f Spot();
  void Scatter(std::string_view kind, int count, float yaw);

  MeshBuilder& mesh_;
  const Surfaces& surfaces_;
  PropShelf& shelf_;
  const BuildingPlan& plan_;
  const EntityId building_, roof_;
  RngStream rng_;
  const GroundRect area_ = plan_.bounds().Inset(1.6f);
  const float z_ = plan_.height();
  Occupancy taken_;
};

// The cut corner of a chamfered outline stays free.
bool Deck::Inside(Vec2f p) const {
  for (size_t i = 0; i < plan_.outline.size(); ++i) {
    const Vec2f a = plan_.outline[i], b = plan_.outline[(i + 1) % plan_.outline.size()];
    const float side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    if (side < 1.5f * std::hypot(b.x - a.x, b.y - a.y)) return false;
  }
  return true;
}

Vec2f Deck::Spot() { return {static_cast<float>(rng_.Uniform(area_.x0, area_.x1)), static_cast<float>(rng_.Uniform(area_.y0, area_.y1))}; }

void Deck::Scatter(std::string_view kind, int count, float yaw) {
  const float r = FindPropKind(kind).footprint_radius;
  for (int i = 0, tries = 0; i < count && tries < 40; ++tries) {
    const Vec2f p = Spot();
    const Footprint footprint{p, {r, r}, yaw};
    if (!Inside(p) || !taken_.IsFree(footprint)) continue;
    taken_.Add(footprint);
    shelf_.Place(kind, {p.x, p.y, z_}, yaw, rng_.Index(8));
    ++i;
  }
}

// The head of the stairs, or the next tier where one stands; and what the plan keeps free.
void Deck::ReserveStairs() {
  if (plan_.upper.empty()) {
    const Vec2f stair = plan_.bounds().center() + Vec2f{static_cast<float>(rng_.Uniform(-1, 1)), static_cast<float>(rng_.Uniform(-1, 1))};
    Bulkhead(mesh_, surfaces_, plan_, stair, building_);
    taken_.Add({stair, {2.6f, 2.4f}, 0});
  } else {
    BuildingPlan tier;
    tier.outline = plan_.upper;
    const GroundRect box = tier.bounds();
    taken_.Add({box.center(), {box.width() / 2 + 0.8f, box.depth() / 2 + 0.8f}, 0});
  }
  const GroundRect& free = plan_.kept_free;
  if (free.area() > 0) taken_.Add({free.center(), {free.width() / 2, free.depth() / 2}, 0});
}

// A row of air conditioners, vents, sometimes a tank and antennas.
void Deck::PlaceMachines() {
  const float area = area_.area();
  const bool old = plan_.style == FacadeStyle::kBrickWalkUp || plan_.style == FacadeStyle::kBrickLoft;
  if (rng_.Chance(plan_.style == FacadeStyle::kDeco ? 0.65 : old ? 0.45 : 0.12)) Scatter("water_tank", 1, 0);
  Scatter("ac_unit", std::min(6, 1 + static_cast<int>(area / 55)), kQuarterTurn * static_cast<float>(rng_.Index(4)));
  Scatter("roof_vent", std::min(8, 2 + static_cast<int>(area / 45)), 0);
  Scatter("antenna", rng_.Chance(0.6) ? 1 + static_cast<int>(rng_.Index(2)) : 0, 0);
}

// Across the deck, on three feet.
void Deck::LayDuct() {
  mesh_.SetEntity(roof_);
  mesh_.SetMaterial(surfaces_[Surface::kMetal]);
  const Footprint duct{{plan_.bounds().center().x, area_.y0 + 0.4f}, {area_.width() * 0.3f, 0.3f}, 0};
  const Vec2f c = duct.center, end{duct.half.x, 0};
  if (!taken_.IsFree(duct) || !Inside(c - end) || !Inside(c + end)) return;
  taken_.Add(duct);
  mesh_.Box({c.x - duct.half.x, c.y - 0.25f, z_ + 0.25f}, {c.x + duct.half.x, c.y + 0.25f, z_ + 0.7f});
  for (float t : {-0.8f, 0.0f, 0.8f}) {
    const float x = c.x + t * duct.half.x;
    mesh_.Box({x - 0.05f, c.y - 0.2f, z_}, {x + 0.05f, c.y + 0.2f, z_ + 0.25f}, 15);
  }
}

void Deck::AddSkylights() {
  for (int i = 0; i < 3; ++i) {
    const Vec2f p = Spot();
    const Footprint light{p, {1.0f, 0.7f}, 0};
    if (!Inside(p) || !taken_.IsFree(light)) continue;
    taken_.Add(light);
    mesh_.SetMaterial(surfaces_[Surface::kMetal]);
    mesh_.Box({p.x - 0.9f, p.y - 0.6f, z_}, {p.x + 0.9f, p.y + 0.6f, z_ + 0.35f}, 15);
    mesh_.SetMaterial(surfaces_[Surface::kGlassBlue]);
    mesh_.Box({p.x - 0.9f, p.y - 0.6f, z_ + 0.35f}, {p.x + 0.9f, p.y + 0.6f, z_ + 0.42f}, 15 | MeshBuilder::kTop);
  }
}

}  // namespace

void AddRoofClutter(MeshBuilder& mesh, const Surfaces& surfaces, PropShelf& shelf, const BuildingPlan& plan, EntityId building,
                    EntityId roof) {
  Deck deck(mesh, surfaces, shelf, plan, building, roof);
  if (!deck.wide()) {
    if (plan.upper.empty()) HouseClutter(mesh, surfaces, shelf, plan, building, roof);
    return;
  }
  deck.ReserveStairs();
  deck.PlaceMachines();
  deck.LayDuct();
  deck.AddSkylights();
}

}  // namespace airsim360::internal
