#include "airsim360/worlds/building/roofs.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/worlds/building/facade.h"
#include "airsim360/worlds/building/roof_clutter.h"

namespace airsim360 {
namespace {

using internal::kParapetThickness;

// Ring between two outlines of the same corner count at heights za and zb, facing up.
void Ring(MeshBuilder& mesh, const std::vector<Vec2f>& outer, const std::vector<Vec2f>& inner, float za, float zb) {
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

void FlatDeck(MeshBuilder& mesh, const Surfaces& surfaces, const BuildingPlan& plan, EntityId building, EntityId roof) {
  const float deck = plan.height(), top = deck + ParapetHeight(plan);
  const std::vector<Vec2f> inner = OffsetConvex(plan.outline, kParapetThickness);
  mesh.SetEntity(roof);
  // Some have a coat that throws the sun back.
  mesh.SetMaterial(surfaces[plan.seed % 5 == 0                   ? Surface::kAsphaltPale
                            : plan.roof == RoofKind::kFlatGravel ? Surface::kRoofGravel
                                                                 : Surface::kRoofBitumen]);
  mesh.Polygon(inner, deck);
  // A flashing strip folds up along the parapet, coping lies on top.
  mesh.SetMaterial(surfaces[Surface::kRoofBitumen]);
  Ring(mesh, OffsetConvex(inner, -0.001f), OffsetConvex(inner, 0.16f), deck + 0.18f, deck + 0.004f);
  mesh.SetMaterial(surfaces[Surface::kCoping]);
  const std::vector<Vec2f> out = OffsetConvex(plan.outline, -0.06f), in = OffsetConvex(plan.outline, kParapetThickness + 0.05f);
  mesh.Walls(out, top, top + 0.09f);
  Ring(mesh, out, in, top + 0.09f, top + 0.09f);
  Ring(mesh, plan.outline, out, top, top);
  mesh.Walls(Reversed(in), top, top + 0.09f);
  mesh.SetEntity(building);
  mesh.SetMaterial(surfaces[WallSurfaceOf(plan)]);
  mesh.Walls(Reversed(inner), deck, top);
}

// Hip roof over a rectangle, with overhanging eaves, a fascia and a chimney.
void HipRoof(MeshBuilder& mesh, const Surfaces& surfaces, const BuildingPlan& plan, EntityId building, EntityId roof) {
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
  const Vec3f at = p0 + (p1 - p0) * static_cast<float>(rng.Uniform(0.1, 0.9)) + Vec3f{long_x ? 0.0f : 1.5f, long_x ? 1.5f : 0.0f, 0};
  mesh.Box({at.x - 0.35f, at.y - 0.5f, ridge - 2}, {at.x + 0.35f, at.y + 0.5f, ridge + 0.9f},
           MeshBuilder::kAllSides & ~MeshBuilder::kBottom);
  mesh.SetMaterial(surfaces[Surface::kBrickRed]);
  for (float dy : {-0.25f, 0.25f}) mesh.Tube({at.x, at.y + dy, ridge + 0.9f}, {at.x, at.y + dy, ridge + 1.3f}, 0.13f, 0.1f, 8, false, true);
}

}  // namespace

void BuildRoof(SceneBuilder&, MeshBuilder& mesh, const Surfaces& surfaces, PropShelf* shelf, const BuildingPlan& building,
               EntityId building_entity, EntityId roof_entity) {
  mesh.SetTransform({});
  if (building.roof == RoofKind::kHipTile || building.roof == RoofKind::kHipSlate) {
    HipRoof(mesh, surfaces, building, building_entity, roof_entity);
    return;
  }
  FlatDeck(mesh, surfaces, building, building_entity, roof_entity);
  if (shelf) internal::AddRoofClutter(mesh, surfaces, *shelf, building, building_entity, roof_entity);
}

}  // namespace airsim360
