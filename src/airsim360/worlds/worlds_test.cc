#include "airsim360/worlds/worlds.h"

#include <gtest/gtest.h>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

TEST(BoxRoom, HasSevenEntitiesAndTheContractsBounds) {
  const auto room = BuildWorld("box_room", {});
  ASSERT_EQ(room->entities.size(), 7u);
  EXPECT_EQ(room->sky_entity, kNoEntity);
  EXPECT_EQ(room->bounds.min, (Vec3f{-5, -5, 0}));
  EXPECT_EQ(room->bounds.max, (Vec3f{5, 5, 6}));
  const Entity& box = room->entity(7);
  EXPECT_EQ(box.bounds.min, (Vec3f{2.5f, -0.5f, 0}));
  EXPECT_EQ(box.bounds.max, (Vec3f{3.5f, 0.5f, 1}));
}

TEST(BoxRoom, FacesLookAtTheSpaceBetweenRoomAndBox) {
  const auto room = BuildWorld("box_room", {});
  const Vec3f inside{0, 0, 3}, box_center{3, 0, 0.5f};
  for (const Mesh& mesh : room->meshes) {
    for (Vec3u t : mesh.triangles) {
      const Vec3f a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
      const Vec3f normal = Cross(b - a, c - a);
      const Vec3f towards = mesh.name == "room" ? inside - a : a - box_center;
      EXPECT_GT(Dot(normal, towards), 0) << mesh.name;
    }
  }
}

TEST(Worlds, AnUnknownNameGetsTheNearestOne) {
  try {
    BuildWorld("downtown_wast", {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("downtown_west"), std::string::npos);
  }
}

}  // namespace
}  // namespace airsim360
