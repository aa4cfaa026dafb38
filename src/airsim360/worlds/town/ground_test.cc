#include "airsim360/worlds/town/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/worlds/building/facade.h"

namespace airsim360 {
namespace {

// Area seen from above of the triangles of all parts whose entity has the category `path`, and their extreme
// heights.
struct Seen {
  double area = 0;
  float low = 1e9f, high = -1e9f;
};
Seen SeenFromAbove(const Scene& scene, std::string_view path) {
  Seen seen;
  for (const Mesh& mesh : scene.meshes) {
    for (const MeshPart& part : mesh.parts) {
      if (scene.tree[scene.entity(part.entity).category].path != path) continue;
      for (uint32_t i = 0; i < part.triangle_count; ++i) {
        const Vec3u t = mesh.triangles[part.first_triangle + i];
        const Vec3f a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        seen.area += Cross(b - a, c - a).z / 2;
        for (Vec3f p : {a, b, c}) {
          seen.low = std::min(seen.low, p.z);
          seen.high = std::max(seen.high, p.z);
        }
      }
    }
  }
  return seen;
}

TEST(Carriageway, HasACrownAboveItsGutters) {
  const StreetLine line{0, 6};
  EXPECT_FLOAT_EQ(CarriagewayHeight(line, 6), -0.13f);
  EXPECT_FLOAT_EQ(CarriagewayHeight(line, -6), -0.13f);
  EXPECT_NEAR(CarriagewayHeight(line, 0), -0.13 + 0.018 * 6, 1e-6);
}

TEST(Pavement, CoversTheRingBetweenKerbAndBuildingLineAndDropsAtCrossings) {
  SceneBuilder builder("pavement");
  const Surfaces surfaces = AddSurfaces(builder);
  Ground ground(builder, surfaces);
  Block block;
  block.kerb = {-50, -40, 50, 40};
  LayPavement(ground, block, Surface::kSlabs);
  ground.Finish("pavement");
  const auto scene = builder.Build();

  // Rounded rectangle 0.15 m inside the kerb face less the inner rectangle; arcs of ten chords lose a little.
  const GroundRect outer = block.kerb.Inset(0.15f);
  const double r = block.corner_radius - 0.15;
  const double chords = 20 * std::sin(std::numbers::pi / 20) / 2 * r * r;  // area of ten triangles under a quarter circle, times 2
  const double quarter = chords / 2;
  const double expected = outer.area() - 4 * (r * r - quarter) - block.inner().area();
  const Seen fields = SeenFromAbove(*scene, "ground/pavement/modular");
  EXPECT_NEAR(fields.area, expected, 0.003 * expected);
  EXPECT_NEAR(fields.high, 0, 1e-5);
  EXPECT_NEAR(fields.low, -0.11, 1e-4);  // two centimetres above the gutter
  EXPECT_LT(SeenFromAbove(*scene, "ground/kerb").low, -0.13f);
}

TEST(Streets, MarkingsLieAFewMillimetresAboveTheAsphalt) {
  SceneBuilder builder("streets");
  const Surfaces surfaces = AddSurfaces(builder);
  Ground ground(builder, surfaces);
  const StreetPlan plan = PlanDowntownWest();
  const std::vector<StreetStretch> streets = LayStreets(ground, plan, 0);
  ground.Finish("streets");
  const auto scene = builder.Build();
  EXPECT_EQ(streets.size(), 40u);  // eight core streets of five stretches
  for (const Mesh& mesh : scene->meshes) {
    for (const MeshPart& part : mesh.parts) {
      if (scene->tree[scene->entity(part.entity).category].path != "ground/lane_marking") continue;
      for (uint32_t i = 0; i < part.triangle_count; ++i) {
        const Vec3f p = mesh.positions[mesh.triangles[part.first_triangle + i].x];
        // The street under the point is the one whose centre line is nearest.
        float lift = 1e9f;
        for (const StreetStretch& s : streets) {
          const float along = s.along_x ? p.x : p.y, across = s.along_x ? p.y - s.line.center : s.line.center - p.x;
          if (along < s.s0 || along > s.s1 || std::abs(across) > s.line.half_width) continue;
          lift = p.z - CarriagewayHeight(s.line, across);
        }
        EXPECT_GE(lift, 0.003f);
        EXPECT_LE(lift, 0.0085f);  // signs lie on a coat of green
      }
    }
  }
}

// Windows are holes: the panes of every walled style lie behind the wall.
TEST(Facades, PanesAreSetBackIntoTheWall) {
  SceneBuilder builder("facade");
  const Surfaces surfaces = AddSurfaces(builder);
  MeshBuilder mesh;
  FacadeContext context{builder, surfaces, mesh, AddBalconyMesh(builder, surfaces), AddWindowBoxMesh(builder, surfaces)};
  BuildingPlan plan;
  plan.outline = {{0, 0}, {18, 0}, {18, 15}, {0, 15}};
  plan.edges.assign(4, EdgeKind::kStreet);
  plan.party_height.assign(4, 0);
  plan.seed = 5;
  for (int style = 0; style < static_cast<int>(FacadeStyle::kCount); ++style) {
    plan.style = static_cast<FacadeStyle>(style);
    if (plan.style == FacadeStyle::kCurtainWall || plan.style == FacadeStyle::kBracedGlass) continue;
    const EntityId entity = builder.AddEntity("building", builder.tree().At("construction/building"));
    BuildFacades(context, plan, entity, std::vector<FacadeDetail>(4, FacadeDetail::kFull));
    const Mesh built = mesh.Finish("facade");
    int panes = 0;
    for (const MeshPart& part : built.parts) {
      if (builder.material(part.material).kind != SurfaceKind::kGlass) continue;
      panes += static_cast<int>(part.triangle_count);
      for (uint32_t i = 0; i < part.triangle_count; ++i) {
        // Depth behind the wall that the pane faces.
        const uint32_t vertex = built.triangles[part.first_triangle + i].x;
        const Vec3f p = built.positions[vertex], n = built.normals[vertex];
        const float depth = n.x < -0.5f ? p.x : n.x > 0.5f ? 18 - p.x : n.y < -0.5f ? p.y : 15 - p.y;
        EXPECT_GE(depth, 0.099f) << "style " << style;
      }
    }
    EXPECT_GT(panes, 100);
  }
}

}  // namespace
}  // namespace airsim360
