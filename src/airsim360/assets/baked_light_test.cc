#include "airsim360/assets/baked_light.h"

#include <gtest/gtest.h>

#include "airsim360/assets/importing/place_model.h"
#include "airsim360/assets/importing/scene_assembly.h"
#include "airsim360/base/error.h"
#include "airsim360/scene/luminance.h"

namespace airsim360::internal {
namespace {

/// A box of 4 x 5 x 3 m with vertex colours; its faces look inwards, or outwards as those of a thing.
ImportedFile ScannedRoom(bool inwards = true, bool roof = true) {
  ImportedFile file;
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back({i & 1 ? 4.0f : 0, i & 2 ? 5.0f : 0, i & 4 ? 3.0f : 0});
  const uint32_t faces[6][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};
  for (int f = 0; f < (roof ? 6 : 5); ++f) {
    const uint32_t* q = faces[f];
    mesh.triangles.push_back(inwards ? Vec3u{q[0], q[1], q[2]} : Vec3u{q[0], q[2], q[1]});
    mesh.triangles.push_back(inwards ? Vec3u{q[0], q[2], q[3]} : Vec3u{q[0], q[3], q[2]});
  }
  mesh.normals.assign(8, {0, 0, 1});
  mesh.colors.assign(8, {30000, 20000, 10000});
  mesh.parts = {{0, static_cast<uint32_t>(mesh.triangles.size()), 0, kNoEntity}};
  file.materials.emplace_back();
  file.meshes.push_back(mesh);
  ImportedNode node;
  node.mesh = 0;
  file.nodes.push_back(node);
  return file;
}

TEST(BakedLight, IsThatOfClosedRoomsWithColoursAndNothingThatShines) {
  EXPECT_FALSE(WhyBaked(ScannedRoom(), false).empty());
  EXPECT_TRUE(WhyBaked(ScannedRoom(), true).empty());              // somebody's model of a house
  EXPECT_TRUE(WhyBaked(ScannedRoom(false), false).empty());        // a box
  EXPECT_TRUE(WhyBaked(ScannedRoom(true, false), false).empty());  // a yard
  ImportedFile lamp = ScannedRoom();
  lamp.materials[0].emission = {1, 1, 1};
  EXPECT_TRUE(WhyBaked(lamp, false).empty());
  ImportedFile grey = ScannedRoom();
  grey.meshes[0].colors.clear();
  EXPECT_TRUE(WhyBaked(grey, false).empty());
  // What says of itself that it is unlit is believed, whatever its names.
  grey.unlit = {0};
  EXPECT_FALSE(WhyBaked(grey, true).empty());
  ImportedFile yard = ScannedRoom(true, false);
  yard.unlit = {0};
  EXPECT_TRUE(WhyBaked(yard, false).empty());
}

TEST(BakedLight, TurnsWithTheModel) {
  ImportedFile side = ScannedRoom();
  // On its side, two walls would be floor and ceiling too: only its size speaks.
  side.nodes[0].X_WM.A = Mat3f::FromColumns({3, 0, 0}, {0, 0, 2}, {0, -1, 0});
  EXPECT_EQ(GuessUp(side, "y"), "looks as if it lay on its side: use up: z");
  EXPECT_EQ(GuessUp(side, "z"), "");
  ImportedFile upright = ScannedRoom();
  upright.nodes[0].X_WM.A = Mat3f::FromColumns({3, 0, 0}, {0, 2, 0}, {0, 0, 1});
  EXPECT_EQ(GuessUp(upright, "y"), "");
  // A textured slab of a house without rooms, 30 x 15 x 60 m, stands.
  ImportedFile slab = ScannedRoom(false);
  slab.nodes[0].X_WM.A = Mat3f::FromColumns({7.5f, 0, 0}, {0, 3, 0}, {0, 0, 20});
  EXPECT_EQ(GuessUp(slab, "y"), "");
}

// A plain that the user asks for is no part of the file: the guesses are as without it.
TEST(BakedLight, IsGuessedWithAPlainToo) {
  const auto placed = [](ImportedFile file) {
    PlaceModel({.ground = true}, "y", file);
    return file;
  };
  EXPECT_FALSE(WhyBaked(placed(ScannedRoom()), false).empty());
  EXPECT_NE(AssembleScene(placed(ScannedRoom()), {}, "my_house", "my_house.glb")->interior_light, Vec3f{});
  EXPECT_TRUE(WhyBaked(placed(ScannedRoom(true, false)), false).empty());
  ImportedFile side = ScannedRoom();
  side.nodes[0].X_WM.A = Mat3f::FromColumns({3, 0, 0}, {0, 0, 2}, {0, -1, 0});
  EXPECT_NE(GuessUp(placed(side), "y"), "");
}

// One mesh that a file shows too often to be measured is left as it is.
TEST(BakedLight, IsNotGuessedOfEndlessCopies) {
  ImportedFile many = ScannedRoom();
  many.meshes[0].triangles.resize(size_t{1} << 16, many.meshes[0].triangles[0]);
  many.meshes[0].parts[0].triangle_count = 1 << 16;
  many.nodes.resize((size_t{1} << 11) + 1, many.nodes[0]);
  EXPECT_EQ(WhyBaked(many, false), "");
  EXPECT_EQ(GuessUp(many, "y"), "");
}

TEST(BakedLight, OfAnExportedWorldIsItsOwn) {
  ImportedFile file = ScannedRoom();
  file.written.emplace();
  for (const bool baked : {false, true}) {
    try {
      AssembleScene(file, {}, "town", "town.glb", baked);
      ADD_FAILURE();
    } catch (const InputError& error) {
      const std::string what = error.what();
      for (const char* part : {"town.glb", baked ? "light: baked" : "light: lit", "leave light out"})
        EXPECT_NE(what.find(part), std::string::npos) << what;
    }
  }
  EXPECT_EQ(AssembleScene(file, {}, "town", "town.glb")->interior_light, Vec3f{});
}

TEST(BakedLight, AScanHasTheLightOfRoomsAndASkyInName) {
  const auto scan = AssembleScene(ScannedRoom(), {}, "my_house", "my_house.glb");
  EXPECT_NE(scan->sky_entity, kNoEntity);
  // 300 lx by Lambert's law.
  EXPECT_NEAR(Luminance(scan->interior_light) * 3.14159265 / kNit, 300, 0.1);
  EXPECT_EQ(AssembleScene(ScannedRoom(), {}, "my_house", "my_house.glb", false)->interior_light, Vec3f{});
  EXPECT_EQ(AssembleScene(ScannedRoom(false), {}, "a", "a.glb")->interior_light, Vec3f{});
  EXPECT_NE(AssembleScene(ScannedRoom(false), {}, "a", "a.glb", true)->interior_light, Vec3f{});
}

}  // namespace
}  // namespace airsim360::internal
