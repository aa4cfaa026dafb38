// Doors of every make, and back doors where the ground falls away.
#include "airsim360/worlds/building/doors.h"

#include <gtest/gtest.h>

#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/texture/test_surfaces.h"

namespace airsim360 {
namespace {

using namespace internal;

constexpr float kWall = 20;  // metres, along x; the street lies at y < 0

struct Drawn {
  SceneBuilder builder{"doors"};
  Surfaces surfaces = AddTestSurfaces(builder);
  MeshBuilder mesh;
  FacadePen pen{mesh, surfaces};
  explicit Drawn(float reach = 1) {
    pen.SetScale(0, 1, reach);
    pen.SetWall({0, 0}, {kWall, 0});
  }
};

class EveryDoor : public testing::TestWithParam<DoorMake> {};
INSTANTIATE_TEST_SUITE_P(Makes, EveryDoor,
                         testing::Values(DoorMake::kFlush, DoorMake::kPanelled, DoorMake::kHalfGlazed, DoorMake::kBoarded,
                                         DoorMake::kRollerShutter));

TEST_P(EveryDoor, FillsItsOpeningAndKeepsToItsRelief) {
  for (float height : {2.1f, 2.9f}) {
    Drawn d;
    HangDoor(d.pen, GetParam(), Surface::kDoorGrey, Surface::kFrameDark, 8, 9.1f, 0.1f, 0.1f + height, 0.3f);
    const TestRays rays(d.mesh.Finish("door"));
    for (float x = 8.01f; x < 9.1f; x += 0.0371f) {
      for (float z = 0.11f; z < 0.09f + height; z += 0.0413f) {
        const auto hit = rays.First({x, -5, z}, {0, 1, 0}, 10);
        ASSERT_TRUE(hit) << "hole at x " << x << ", z " << z;
        EXPECT_GE(hit->t, 5.3f - kDoorRelief - 1e-4f) << x << " " << z;
        EXPECT_LE(hit->t, 5.3f + 1e-4f) << x << " " << z;
      }
    }
  }
}

TEST_P(EveryDoor, IsNoPlainSlab) {
  Drawn d;
  HangDoor(d.pen, GetParam(), Surface::kDoorGrey, Surface::kFrameDark, 8, 9.1f, 0.1f, 2.3f, 0.3f);
  const Mesh mesh = d.mesh.Finish("door");
  const TestRays rays(mesh);
  std::set<int> depths;  // millimetres
  for (float x = 8.01f; x < 9.1f; x += 0.0123f)
    for (float z = 0.11f; z < 2.29f; z += 0.0171f) {
      if (const auto hit = rays.First({x, -5, z}, {0, 1, 0}, 10)) depths.insert(static_cast<int>(std::lround(1000 * hit->t)));
    }
  EXPECT_GE(depths.size(), 4u);
  std::set<MaterialId> materials;
  for (const MeshPart& part : mesh.parts) materials.insert(part.material);
  EXPECT_GE(materials.size(), 3u);
}

BuildingPlan House() {
  BuildingPlan plan;
  plan.floors = 4;
  return plan;
}
const Bay kBay{8, 11.4f, 0, 4.2f, 0, 4};

// Who leaves the door steps down to the ground by no more than a stair's rise at a time.
TEST(BackDoor, HasStepsDownToTheGroundOfASlope) {
  for (float fall : {0.0f, 0.15f, 0.3f, 0.8f, 1.6f}) {
    Drawn d;
    ASSERT_TRUE(TakesDoor(d.pen, kBay, fall)) << fall;
    RngStream rng(3, "door");
    BuildBackDoor(d.pen, House(), DressOf(House()), kBay, fall, rng);
    const TestRays rays(d.mesh.Finish("back door"));
    float last = 0.2f, lowest = last;
    for (float x = kBay.middle(); x < kBay.middle() + 5; x += 0.05f) {
      const auto hit = rays.First({x, -0.3f, 1.0f}, {0, 0, -1}, 8);
      const float z = hit ? std::max(1 - hit->t, -fall) : -fall;
      EXPECT_LE(last - z, 0.33f) << "fall " << fall << ", x " << x;
      last = z;
      lowest = std::min(lowest, z);
    }
    EXPECT_NEAR(lowest, -fall, 1e-3f);
  }
}

TEST(BackDoor, StandsOnlyWhereStepsFit) {
  Drawn town, map(0.6f);
  EXPECT_FALSE(TakesDoor(town.pen, kBay, 2.5f)) << "too high";
  EXPECT_FALSE(TakesDoor(town.pen, kBay, -0.5f)) << "under the ground";
  EXPECT_FALSE(TakesDoor(town.pen, {8, 9.2f, 0, 4.2f, 0, 4}, 0)) << "too narrow";
  EXPECT_TRUE(TakesDoor(map.pen, kBay, 0.1f));
  EXPECT_FALSE(TakesDoor(map.pen, kBay, 0.8f)) << "a building of a map keeps within its outline";
  EXPECT_TRUE(TakesDoor(town.pen, {kWall - 3.4f, kWall, 0, 4.2f, 0, 4}, 0.8f)) << "steps lead to the other side";
}

TEST(BackDoor, DiffersFromWallToWall) {
  std::set<std::vector<MaterialId>> looks;
  for (uint64_t seed = 0; seed < 24; ++seed) {
    Drawn d;
    RngStream rng(seed, "door");
    BuildBackDoor(d.pen, House(), DressOf(House()), kBay, 0, rng);
    std::vector<MaterialId> materials;
    for (const MeshPart& part : d.mesh.Finish("back door").parts) materials.push_back(part.material);
    looks.insert(materials);
  }
  EXPECT_GE(looks.size(), 16u);
}

}  // namespace
}  // namespace airsim360
