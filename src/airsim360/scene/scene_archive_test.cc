#include "airsim360/scene/scene_archive.h"

#include <gtest/gtest.h>

#include <memory>

#include "airsim360/scene/road_network.h"

namespace airsim360 {
namespace {

// Every field other than its default.
Material OddMaterial() {
  return {"leaf",
          SurfaceKind::kFoliage,
          AlphaMode::kMask,
          0.25f,
          {0.1f, 0.2f, 0.3f},
          0.9f,
          0.4f,
          0.6f,
          {1, 2, 3},
          0.7f,
          0.35f,
          0.8f,
          0.05f,
          true,
          true,
          -3.5f,
          0.15f,
          0,
          1,
          0,
          1,
          {2, 3},
          {0.5f, 0.25f},
          1.5f,
          GroundWear::kGravel,
          true,
          {4, 5}};
}

std::shared_ptr<const Scene> OddScene() {
  SceneBuilder builder("odd");
  // A stuff ancestor of a thing.
  builder.tree().Add("robot", false);
  const CategoryId arm = builder.tree().Add("robot/arm/gripper");
  Image<Rgba8> picture(5, 3, {1, 2, 3, 4});
  picture(4, 2) = {9, 8, 7, 6};
  builder.AddTexture(Texture::FromImage("a", picture, true));
  Texture second = Texture::FromImage("b", Image<Rgba8>(1, 1), false);
  second.wrap_u = Wrap::kClamp, second.wrap_v = Wrap::kMirror;
  builder.AddTexture(second);
  builder.AddMaterial({});
  builder.AddMaterial(OddMaterial());
  const EntityId entity = builder.AddEntity("arm", arm);
  const MeshId mesh = builder.AddMesh({"triangle",
                                       {{0, 0, 0}, {1, 0, 0}, {0, 1, -0.0f}},
                                       {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
                                       {{0, 0}, {1, 0}, {0, 1}},
                                       {{0, 1, 2}},
                                       {{0, 1, 1, entity}},
                                       {{1, 2, 3, 4}, {}, {65535, 0, 40000, 7}}});
  builder.AddInstance({mesh, PlaceUpright({1, 2, 3}, 0.5f, 2), entity, {0.5f, 0.6f, 0.7f}});
  builder.AddSky();
  builder.SetInteriorLight({0.1f, 0, 0.2f});
  builder.SetSpawn({4, 5, 6}, 70);
  builder.AddAttribution("triangle, me, CC0");
  RoadNetwork roads;
  roads.lanes = {{.points = {{0, 0, 0}, {9, 0, 1}}, .width = 3, .speed = 8, .next = {1}, .left = 1, .right = 1, .priority = 2, .bus = true},
                 {.points = {{9, 0, 1}, {0, 5, 0}, {0, 0, 0}}, .next = {0}, .junction = 0, .signal = 3}};
  roads.junctions = {{{1, 2, 3}, 7, {{8, 10, 2, 1}}, 5}};
  builder.SetRoads(std::make_shared<const RoadNetwork>(roads));
  Environment& environment = builder.environment();
  for (const EnvironmentField& field : EnvironmentFields()) environment.*field.value += 0.125;
  environment.lamps = Lamps::kOn, environment.cloud_type = CloudType::kStratus;
  environment.hdri = std::make_shared<SkyPicture>(SkyPicture{"sky", {2, 1, {1, 2, 3}}});
  return builder.Build();
}

TEST(SceneArchive, GivesBackTheSameBytes) {
  const Bytes bytes = ArchiveScene(*OddScene());
  const std::optional<Scene> scene = SceneFromArchive(bytes);
  ASSERT_TRUE(scene);
  EXPECT_EQ(ArchiveScene(*scene), bytes);
}

// By fields, as a field that both ways leave out would not be missed in the bytes.
TEST(SceneArchive, GivesBackEveryPart) {
  const auto scene = OddScene();
  const std::optional<Scene> read = SceneFromArchive(ArchiveScene(*scene));
  ASSERT_TRUE(read);
  ASSERT_EQ(read->textures.size(), 2u);
  EXPECT_EQ(read->textures[0].name, "a");
  EXPECT_TRUE(read->textures[0].srgb);
  EXPECT_EQ(read->textures[0].levels, scene->textures[0].levels);
  EXPECT_EQ(read->textures[1].wrap_u, Wrap::kClamp);
  EXPECT_EQ(read->textures[1].wrap_v, Wrap::kMirror);
  const Material &a = read->materials[1], b = OddMaterial();
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.alpha_cutoff, b.alpha_cutoff);
  EXPECT_EQ(a.clear_coat_roughness, b.clear_coat_roughness);
  EXPECT_EQ(a.emission_texture, b.emission_texture);
  EXPECT_EQ(a.ground, b.ground);
  EXPECT_EQ(a.units, b.units);
  EXPECT_EQ(read->meshes[0].positions, scene->meshes[0].positions);
  EXPECT_EQ(read->meshes[0].uvs, scene->meshes[0].uvs);
  EXPECT_EQ(read->meshes[0].parts[0].entity, 1u);
  EXPECT_EQ(read->meshes[0].colors, scene->meshes[0].colors);
  EXPECT_EQ(read->instances[0].X_WM, scene->instances[0].X_WM);
  EXPECT_EQ(read->instances[0].tint, scene->instances[0].tint);
  EXPECT_EQ(read->entities[0].bounds.max, scene->entities[0].bounds.max);
  EXPECT_TRUE(read->entities[1].bounds.empty());
  EXPECT_EQ(read->sky_entity, 2u);
  EXPECT_EQ(read->interior_light, scene->interior_light);
  EXPECT_EQ(read->bounds.min, scene->bounds.min);
  EXPECT_EQ(read->spawn, scene->spawn);
  EXPECT_EQ(read->spawn_yaw_deg, 70);
  EXPECT_EQ(read->attributions, scene->attributions);
  EXPECT_EQ(DescribeEnvironment(read->environment), DescribeEnvironment(scene->environment));
  EXPECT_EQ(read->environment.hdri->pixels, scene->environment.hdri->pixels);
}

// Room for what ray tracers read behind the last position, else they copy all; nothing else is held that is not used.
TEST(SceneArchive, MeshesTakeNoMoreMemoryThanTheyNeed) {
  SceneBuilder builder("fan");
  builder.AddMaterial({});
  Mesh fan;
  fan.positions = {{0, 0, 0}};
  for (uint32_t i = 1; i < 100; ++i) {
    fan.positions.push_back({1, static_cast<float>(i), 0});
    if (i > 1) fan.triangles.push_back({0, i - 1, i});
  }
  builder.AddInstance({builder.AddMesh(fan), {}, builder.AddEntity("fan", builder.tree().At("ground/road"))});
  const auto built = builder.Build();
  EXPECT_EQ(built->meshes[0].positions, fan.positions);
  EXPECT_EQ(built->meshes[0].triangles, fan.triangles);
  const std::optional<Scene> read = SceneFromArchive(ArchiveScene(*built));
  ASSERT_TRUE(read);
  for (const Mesh* mesh : {&built->meshes[0], &read->meshes[0]}) {
    EXPECT_EQ(mesh->positions.capacity(), mesh->positions.size() + 1);
    EXPECT_EQ(mesh->triangles.capacity(), mesh->triangles.size());
  }
}

TEST(SceneArchive, CustomCategoriesKeepIdAndKind) {
  const auto scene = OddScene();
  const std::optional<Scene> read = SceneFromArchive(ArchiveScene(*scene));
  ASSERT_TRUE(read);
  for (const char* path : {"robot", "robot/arm", "robot/arm/gripper"}) {
    const CategoryId id = scene->tree.At(path);
    EXPECT_EQ(read->tree.At(path), id);
    EXPECT_EQ(read->tree[id].thing, scene->tree[id].thing) << path;
    EXPECT_EQ(read->tree[id].parent, scene->tree[id].parent) << path;
  }
  EXPECT_EQ(read->tree.categories().size(), scene->tree.categories().size());
}

TEST(SceneArchive, CategoriesThatWantOneIdKeepTheirs) {
  SceneBuilder builder("many");
  builder.AddMaterial({});
  bool moved = false;
  for (int i = 1500; i > 0; --i) {
    const std::string path = "thing/name_" + std::to_string(i);
    moved |= builder.tree().Add(path) != SemanticTree().Add(path);
  }
  ASSERT_TRUE(moved);  // else this tests nothing
  builder.AddSky();
  const auto scene = builder.Build();
  const std::optional<Scene> read = SceneFromArchive(ArchiveScene(*scene));
  ASSERT_TRUE(read);
  ASSERT_EQ(read->tree.categories().size(), scene->tree.categories().size());
  for (const auto& [id, category] : scene->tree.categories()) EXPECT_EQ(read->tree[id].path, category.path);
}

TEST(SceneArchive, CutOffAndLongerBytesAreRejected) {
  Bytes bytes = ArchiveScene(*OddScene());
  for (size_t size = 0; size < bytes.size(); ++size) ASSERT_FALSE(SceneFromArchive(std::span(bytes).first(size))) << size;
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(SceneFromArchive(bytes));
}

// Lengths beyond what is there must not be believed.
TEST(SceneArchive, ChangedBytesNeverCrash) {
  const Bytes good = ArchiveScene(*OddScene());
  for (size_t i = 0; i < good.size(); ++i) {
    Bytes bad = good;
    bad[i] ^= std::byte{0xff};
    SceneFromArchive(bad);
  }
}

}  // namespace
}  // namespace airsim360
