#include "airsim360/worlds/building/roofs.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/building/facade.h"
#include "airsim360/worlds/props/placer.h"

namespace airsim360 {
namespace {

constexpr float kParapetThickness = 0.3f, kTau = 6.2831853f;

// Ring between two outlines of the same corner count at heights za and zb, facing up.
void Ring(MeshBuilder& mesh, const std::vector<Vec2f>& outer, const std::vector<Vec2f>& inner, float za,
          float zb) {
  for (size_t i = 0; i < outer.size(); ++i) {
    const size_t k = (i + 1) % outer.size();
    const Vec3f a{outer[i].x, outer[i].y, za}, b{outer[k].x, outer[k].y, za};
    const Vec3f c{inner[k].x, inner[k].y, zb}, d{inner[i].x, inner[i].y, zb};
    mesh.Quad(a, b, c, d);
  }
}

std::vector<Vec2f> Reversed(std::vector<Vec2f> outline) {
  std::reverse(outline.begin(), outline.end());
  return outline;
}

void FlatDeck(MeshBuilder& mesh, const Surfaces& surfaces, const BuildingPlan& plan, EntityId building,
              EntityId roof) {
  const float deck = plan.height(), top = deck + ParapetHeight(plan);
  const std::vector<Vec2f> inner = OffsetConvex(plan.outline, kParapetThickness);
  mesh.SetEntity(roof);
  // Some have a coat that throws the sun back.
  mesh.SetMaterial(surfaces[plan.seed % 5 == 0                      ? Surface::kAsphaltPale
                            : plan.roof == RoofKind::kFlatGravel ? Surface::kRoofGravel
                                                                 : Surface::kRoofBitumen]);
  mesh.Polygon(inner, deck);
  // A flashing strip folds up along the parapet, coping lies on top.
  mesh.SetMaterial(surfaces[Surface::kRoofBitumen]);
  Ring(mesh, OffsetConvex(inner, -0.001f), OffsetConvex(inner, 0.16f), deck + 0.18f, deck + 0.004f);
  mesh.SetMaterial(surfaces[Surface::kCoping]);
  const std::vector<Vec2f> out = OffsetConvex(plan.outline, -0.06f),
                           in = OffsetConvex(plan.outline, kParapetThickness + 0.05f);
  mesh.Walls(out, top, top + 0.09f);
  Ring(mesh, out, in, top + 0.09f, top + 0.09f);
  Ring(mesh, plan.outline, out, top, top);
  mesh.Walls(Reversed(in), top, top + 0.09f);
  mesh.SetEntity(building);
  mesh.SetMaterial(surfaces[WallSurfaceOf(plan)]);
  mesh.Walls(Reversed(inner), deck, top);
}

// Hip roof over a rectangle, with overhanging eaves, a fascia and a chimney.
void HipRoof(MeshBuilder& mesh, const Surfaces& surfaces, const BuildingPlan& plan, EntityId building,
             EntityId roof) {
  const float eaves = plan.height() + 0.05f, overhang = 0.45f;
  GroundRect r = plan.bounds().Inset(0);
  // Eaves hang over streets and yard, not over neighbours.
  const auto out = [&](size_t edge) { return plan.edges[edge] == EdgeKind::kParty ? 0.0f : overhang; };
  for (size_t e = 0; e < 4; ++e) {
    const Vec2f a = plan.outline[e], b = plan.outline[(e + 1) % 4];
    if (std::abs(b.y - a.y) < 0.01f) {
      (b.x > a.x ? r.y0 : r.y1) += b.x > a.x ? -out(e) : out(e);
    } else {
      (b.y > a.y ? r.x1 : r.x0) += b.y > a.y ? out(e) : -out(e);
    }
  }
  const bool long_x = r.width() >= r.depth();
  const float half = std::min(r.width(), r.depth()) / 2, rise = half * 0.62f, ridge = eaves + rise;
  const Vec2f c = r.center();
  const Vec3f p0 = long_x ? Vec3f{r.x0 + half, c.y, ridge} : Vec3f{c.x, r.y0 + half, ridge};
  const Vec3f p1 = long_x ? Vec3f{r.x1 - half, c.y, ridge} : Vec3f{c.x, r.y1 - half, ridge};
  const Vec3f a{r.x0, r.y0, eaves}, b{r.x1, r.y0, eaves}, d{r.x1, r.y1, eaves}, e{r.x0, r.y1, eaves};
  mesh.SetEntity(roof);
  mesh.SetMaterial(surfaces[plan.roof == RoofKind::kHipTile ? Surface::kRoofTile : Surface::kRoofSlate]);
  const auto slope = [&](Vec3f lower0, Vec3f lower1, Vec3f upper1, Vec3f upper0) {
    // uv: u along the eaves, v down the slope.
    const Vec3f u = Normalized(lower1 - lower0);
    const Vec3f up = Normalized(Cross(Normalized(Cross(u, upper0 - lower0)), u));
    const auto uv = [&](Vec3f p) { return Vec2f{Dot(p - lower0, u), -Dot(p - lower0, up)}; };
    if (Norm(upper1 - upper0) > 0.01f) {
      mesh.QuadUv(lower0, lower1, upper1, upper0, uv(lower0), uv(lower1), uv(upper1), uv(upper0));
    } else {
      mesh.Triangle(lower0, lower1, upper0, uv(lower0), uv(lower1), uv(upper0));
    }
  };
  slope(a, b, long_x ? p1 : p0, p0);
  slope(b, d, p1, long_x ? p1 : p0);
  slope(d, e, long_x ? p0 : p1, p1);
  slope(e, a, p0, long_x ? p0 : p1);
  // Fascia and soffit.
  mesh.SetMaterial(surfaces[Surface::kTrimWhite]);
  const std::vector<Vec2f> rim = r.Outline();
  mesh.Walls(rim, eaves - 0.2f, eaves);
  mesh.Polygon(rim, eaves - 0.2f, false);
  // Chimney and two dormer-like skylights.
  RngStream rng(plan.seed, "hip roof");
  mesh.SetEntity(building);
  mesh.SetMaterial(surfaces[Surface::kBrickBrown]);
  const Vec3f at = p0 + (p1 - p0) * static_cast<float>(rng.Uniform(0.1, 0.9)) +
                   Vec3f{long_x ? 0.0f : 1.5f, long_x ? 1.5f : 0.0f, 0};
  mesh.Box({at.x - 0.35f, at.y - 0.5f, ridge - 2}, {at.x + 0.35f, at.y + 0.5f, ridge + 0.9f},
           MeshBuilder::kAllSides & ~MeshBuilder::kBottom);
  mesh.SetMaterial(surfaces[Surface::kBrickRed]);
  for (float dy : {-0.25f, 0.25f})
    mesh.Tube({at.x, at.y + dy, ridge + 0.9f}, {at.x, at.y + dy, ridge + 1.3f}, 0.13f, 0.1f, 8, false, true);
}

void Bulkhead(MeshBuilder& mesh, const Surfaces& surfaces, const BuildingPlan& plan, Vec2f at,
              EntityId building) {
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
  for (float t : {0.15f, 0.85f}) shelf.Place("roof_vent", {cx + uniform(-0.25f, 0.25f) * r.width(), r.y0 + r.depth() * t, z}, 0, rng.Index(3));
  if (rng.Chance(0.35)) shelf.Place("antenna", {r.x1 - 0.6f, r.y0 + third * 1.1f, z}, 0, rng.Index(3));
}

// Machines on a deck: a row of air conditioners, vents, sometimes a tank and antennas, a duct and pipes.
void Clutter(MeshBuilder& mesh, const Surfaces& surfaces, PropShelf& shelf, const BuildingPlan& plan,
             EntityId building, EntityId roof) {
  RngStream rng(plan.seed, "roof clutter");
  const GroundRect deck = plan.bounds().Inset(1.6f);
  if (deck.width() < 5 || deck.depth() < 5) {
    if (plan.upper.empty()) HouseClutter(mesh, surfaces, shelf, plan, building, roof);
    return;
  }
  const float z = plan.height();
  Occupancy taken;
  // The cut corner of a chamfered outline stays free.
  const Vec2f c = plan.bounds().center();
  const auto inside = [&](Vec2f p) {
    for (size_t i = 0; i < plan.outline.size(); ++i) {
      const Vec2f a = plan.outline[i], b = plan.outline[(i + 1) % plan.outline.size()];
      const float side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      if (side < 1.5f * std::hypot(b.x - a.x, b.y - a.y)) return false;
    }
    return true;
  };
  const auto spot = [&] {
    return Vec2f{static_cast<float>(rng.Uniform(deck.x0, deck.x1)),
                 static_cast<float>(rng.Uniform(deck.y0, deck.y1))};
  };
  if (plan.upper.empty()) {
    const Vec2f stair =
        c + Vec2f{static_cast<float>(rng.Uniform(-1, 1)), static_cast<float>(rng.Uniform(-1, 1))};
    Bulkhead(mesh, surfaces, plan, stair, building);
    taken.Add({stair, {2.6f, 2.4f}, 0});
  } else {
    // The next tier stands there.
    BuildingPlan tier;
    tier.outline = plan.upper;
    const GroundRect box = tier.bounds();
    taken.Add({box.center(), {box.width() / 2 + 0.8f, box.depth() / 2 + 0.8f}, 0});
  }
  if (plan.kept_free.area() > 0)
    taken.Add({plan.kept_free.center(), {plan.kept_free.width() / 2, plan.kept_free.depth() / 2}, 0});
  const auto scatter = [&](std::string_view kind, int count, float yaw) {
    const float r = FindPropKind(kind).footprint_radius;
    for (int i = 0, tries = 0; i < count && tries < 40; ++tries) {
      const Vec2f p = spot();
      const Footprint footprint{p, {r, r}, yaw};
      if (!inside(p) || !taken.IsFree(footprint)) continue;
      taken.Add(footprint);
      shelf.Place(kind, {p.x, p.y, z}, yaw, rng.Index(8));
      ++i;
    }
  };
  const float area = deck.area(), quarter = kTau / 4;
  const bool old = plan.style == FacadeStyle::kBrickWalkUp || plan.style == FacadeStyle::kBrickLoft;
  if (rng.Chance(plan.style == FacadeStyle::kDeco ? 0.65 : old ? 0.45 : 0.12)) scatter("water_tank", 1, 0);
  scatter("ac_unit", std::min(6, 1 + static_cast<int>(area / 55)),
          quarter * static_cast<float>(rng.Index(4)));
  scatter("roof_vent", std::min(8, 2 + static_cast<int>(area / 45)), 0);
  scatter("antenna", rng.Chance(0.6) ? 1 + static_cast<int>(rng.Index(2)) : 0, 0);
  // A duct across the deck and skylights.
  mesh.SetEntity(roof);
  mesh.SetMaterial(surfaces[Surface::kMetal]);
  const Footprint duct{{c.x, deck.y0 + 0.4f}, {deck.width() * 0.3f, 0.3f}, 0};
  if (taken.IsFree(duct) && inside(duct.center - Vec2f{duct.half.x, 0}) &&
      inside(duct.center + Vec2f{duct.half.x, 0})) {
    taken.Add(duct);
    mesh.Box({duct.center.x - duct.half.x, duct.center.y - 0.25f, z + 0.25f},
             {duct.center.x + duct.half.x, duct.center.y + 0.25f, z + 0.7f});
    for (float t : {-0.8f, 0.0f, 0.8f}) {
      const float x = duct.center.x + t * duct.half.x;
      mesh.Box({x - 0.05f, duct.center.y - 0.2f, z}, {x + 0.05f, duct.center.y + 0.2f, z + 0.25f}, 15);
    }
  }
  for (int i = 0; i < 3; ++i) {
    const Vec2f p = spot();
    const Footprint light{p, {1.0f, 0.7f}, 0};
    if (!inside(p) || !taken.IsFree(light)) continue;
    taken.Add(light);
    mesh.SetMaterial(surfaces[Surface::kMetal]);
    mesh.Box({p.x - 0.9f, p.y - 0.6f, z}, {p.x + 0.9f, p.y + 0.6f, z + 0.35f}, 15);
    mesh.SetMaterial(surfaces[Surface::kGlassBlue]);
    mesh.Box({p.x - 0.9f, p.y - 0.6f, z + 0.35f}, {p.x + 0.9f, p.y + 0.6f, z + 0.42f},
             15 | MeshBuilder::kTop);
  }
}

}  // namespace

void BuildRoof(SceneBuilder&, MeshBuilder& mesh, const Surfaces& surfaces, PropShelf* shelf,
               const BuildingPlan& building, EntityId building_entity, EntityId roof_entity) {
  mesh.SetTransform({});
  if (building.roof == RoofKind::kHipTile || building.roof == RoofKind::kHipSlate) {
    HipRoof(mesh, surfaces, building, building_entity, roof_entity);
    return;
  }
  FlatDeck(mesh, surfaces, building, building_entity, roof_entity);
  if (shelf) Clutter(mesh, surfaces, *shelf, building, building_entity, roof_entity);
}

}  // namespace airsim360
