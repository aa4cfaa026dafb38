#include "airsim360/worlds/building/bay_house.h"

#include <gtest/gtest.h>

#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/texture/test_surfaces.h"

namespace airsim360::internal {
namespace {

using Kind = BayHouse::Kind;

struct Built {
  Mesh mesh;
  EntityId building = kNoEntity, roof = kNoEntity;
};

Built Build(const BayHouse& house) {
  SceneBuilder builder("bay house");
  const Surfaces surfaces = AddTestSurfaces(builder);
  MeshBuilder mesh;
  FacadeContext context{builder, surfaces, mesh, 0, 0};
  Built built;
  built.building = builder.AddEntity("house", builder.tree().At("construction/building"));
  built.roof = builder.AddEntity("roof", builder.tree().At("construction/building/roof"));
  BuildBayHouse(context, house, built.building, built.roof);
  built.mesh = mesh.Finish("house");
  return built;
}

BayHouse OnSlope(Kind kind, bool door_right = true) {
  BayHouse house;
  house.kind = kind;
  house.door_right = door_right;
  (door_right ? house.fall_left : house.fall_right) = 2.2f;
  house.foot = 2.9f;
  house.hidden_left = house.hidden_right = -house.foot;
  house.seed = 11;
  return house;
}

class EveryBayHouse : public testing::TestWithParam<std::tuple<Kind, bool>> {
 protected:
  BayHouse house() const { return OnSlope(std::get<0>(GetParam()), std::get<1>(GetParam())); }
};

INSTANTIATE_TEST_SUITE_P(Houses, EveryBayHouse,
                         testing::Combine(testing::Values(Kind::kItalianate, Kind::kGabled, Kind::kStucco), testing::Bool()));

// Rays from the street, from both sides and from the yard end at the house.
TEST_P(EveryBayHouse, HasNoHoleInItsWalls) {
  const BayHouse h = house();
  const TestRays rays(Build(h).mesh);
  int holes = 0;
  for (float z = -h.foot + 0.05f; z < h.height() - 0.05f; z += 0.37f) {
    for (float s = 0.11f; s < h.width - 0.05f; s += 0.29f) {
      const auto front = rays.First({s, -9, z}, {0, 1, 0}, 40), back = rays.First({s, 40, z}, {0, -1, 0}, 60);
      holes += !front || front->t > 9 + 1.3f;
      holes += !back || back->t < 40 - h.depth - 0.3f || back->t > 40 - h.depth + 0.2f;
    }
    for (float s = 0.13f; s < h.depth - 0.05f; s += 0.61f) {
      const auto left = rays.First({-9, s, z}, {1, 0, 0}, 40), right = rays.First({30, s, z}, {-1, 0, 0}, 60);
      holes += !left || left->t > 9.01f;
      holes += !right || right->t > 30 - h.width + 0.01f;
    }
  }
  EXPECT_EQ(holes, 0);
}

TEST_P(EveryBayHouse, IsCoveredFromAbove) {
  const BayHouse h = house();
  const Built built = Build(h);
  const TestRays rays(built.mesh);
  int open = 0, roof = 0, all = 0;
  for (float x = 0.07f; x < h.width; x += 0.21f) {
    for (float y = 0.07f; y < h.depth; y += 0.33f) {
      const auto hit = rays.First({x, y, 60}, {0, 0, -1}, 100);
      ++all;
      open += !hit || 60 - hit->t < h.height() - 0.2f || 60 - hit->t > h.top() + 4;
      roof += hit && hit->entity == built.roof;
    }
  }
  EXPECT_EQ(open, 0);
  EXPECT_GT(roof, 0.8 * all);
}

// The stoop climbs from the ground to the sill in steps that one can walk.
TEST_P(EveryBayHouse, HasStepsToItsDoor) {
  const BayHouse h = house();
  const TestRays rays(Build(h).mesh);
  const float x = BayHouseStoop(h);
  const float fall = h.fall_left + (h.fall_right - h.fall_left) * x / h.width;
  float before = -fall;
  int steps = 0;
  for (float y = -kStoopReach - 0.3f; y < 1.15f; y += 0.02f) {
    const auto hit = rays.First({x, y, std::min(2.2f, before + 1.2f)}, {0, 0, -1}, 20);
    const float z = hit ? std::max(std::min(2.2f, before + 1.2f) - hit->t, -fall) : -fall;
    EXPECT_LT(z - before, 0.26f) << "y " << y;
    steps += z > before + 0.05f;
    before = std::max(before, z);
  }
  EXPECT_NEAR(before, 1.1f, 0.02f);
  EXPECT_GE(steps, 4);
}

TEST_P(EveryBayHouse, HasSoundNumbersAndIsTheSameAgain) {
  const BayHouse h = house();
  const Mesh mesh = Build(h).mesh;
  EXPECT_EQ(FaultOf(mesh), "");
  EXPECT_TRUE(SameBytes(mesh, Build(h).mesh));
  EXPECT_LT(mesh.triangles.size(), 8000u);
}

// A garage that the street passes lower down has its door there.
TEST(BayHouse, PutsTheGarageAtTheStreet) {
  BayHouse h = OnSlope(Kind::kItalianate);
  const TestRays rays(Build(h).mesh);
  const float m = (h.width - 2.2f) / 2, street = -h.fall_left * (1 - m / h.width);
  // Half a metre above the street the ray goes into the recess, at two metres under the bay it meets door or wall.
  const auto low = rays.First({m, -9, street + 0.5f}, {0, 1, 0}, 30), below = rays.First({m, -9, street - 0.3f}, {0, 1, 0}, 30);
  ASSERT_TRUE(low && below);
  EXPECT_GT(low->t, 9.3f);
  EXPECT_NEAR(below->t, 9, 0.02f);
}

TEST(BayHouse, HidesWhatANeighbourCovers) {
  BayHouse h = OnSlope(Kind::kStucco);
  h.hidden_left = h.hidden_right = h.height() - 2;
  const TestRays rays(Build(h).mesh);
  EXPECT_TRUE(rays.First({-3, 7, h.height() - 1}, {1, 0, 0}, 4));
  EXPECT_FALSE(rays.First({-3, 7, h.height() - 3}, {1, 0, 0}, 4));
}

}  // namespace
}  // namespace airsim360::internal
