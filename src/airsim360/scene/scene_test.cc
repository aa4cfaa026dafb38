#include "airsim360/scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

Mesh UnitTriangle() { return {"triangle", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}, {}}; }

TEST(Semantics, IdsAreUniqueBelowTheCustomRangeAndParentsComeByPath) {
  const SemanticTree tree;
  std::set<std::string> paths;
  for (const auto& [id, category] : tree.categories()) {
    EXPECT_LT(id, kFirstCustomId);
    EXPECT_TRUE(paths.insert(category.path).second);
    if (category.parent == kVoid) continue;
    EXPECT_TRUE(category.path.starts_with(tree[category.parent].path + "/"));
  }
  EXPECT_EQ(tree[tree.At("construction/building")].cityscapes, 11);
  EXPECT_EQ(tree[tree.At("sky")].coco, 187);
}

// Datasets of different versions can be mixed: what was added later stands behind.
TEST(Semantics, TheIdsOfTheFirst208CategoriesNeverChange) {
  const SemanticTree tree;
  std::string paths;
  for (CategoryId id = 1; id <= 208; ++id) paths += tree[id].path + "\n";
  EXPECT_EQ(HashName(paths), 0xd46d9e45e57e0242u);
}

// As many names as a large import has: two of 2000 have the same hash nearly always.
TEST(Semantics, ThousandsOfCustomCategoriesHaveIdsOfTheirOwn) {
  SemanticTree tree;
  std::set<CategoryId> ids;
  for (int i = 0; i < 5000; ++i) ids.insert(tree.Add("thing/name_" + std::to_string(i)));
  EXPECT_EQ(ids.size(), 5000u);
  EXPECT_GE(*ids.begin(), kFirstCustomId);
}

// Before, of two paths with one hash the first to be added had it: the same world in another order, other
// ids.
TEST(Semantics, IdsOfABuiltSceneFollowFromItsSetOfPathsAlone) {
  std::vector<std::string> paths;
  RngStream random(11, "paths");
  for (int i = 0; i < 5000; ++i) {
    std::string path = "f" + std::to_string(random.Index(40));
    for (int part = 0; part < 2; ++part) path += "/k" + std::to_string(random.Index(3000));
    paths.push_back(path);
  }
  const auto build = [&] {
    SceneBuilder builder("custom");
    for (const std::string& path : paths) builder.AddEntity(path, builder.tree().Add(path));
    return builder.Build();
  };
  const auto scene = build();
  std::reverse(paths.begin(), paths.end());
  const auto reversed = build();
  for (size_t i = paths.size(); i > 1; --i) std::swap(paths[i - 1], paths[random.Index(static_cast<uint32_t>(i))]);
  const auto shuffled = build();

  ASSERT_GT(scene->tree.categories().size(), 9000u);  // with their ancestors
  size_t own = 0, custom = 0;
  std::set<std::string> seen;
  for (const auto& [id, category] : scene->tree.categories()) {
    EXPECT_EQ(category.id, id);
    EXPECT_TRUE(seen.insert(category.path).second);
    EXPECT_EQ(scene->tree.At(category.path), id);
    for (const auto& other : {reversed, shuffled}) {
      ASSERT_EQ(other->tree.At(category.path), id) << category.path;
      EXPECT_EQ(other->tree[id].parent, category.parent) << category.path;
    }
    const size_t slash = category.path.rfind('/');
    if (slash != std::string::npos) {
      EXPECT_EQ(scene->tree[category.parent].path, category.path.substr(0, slash));
    }
    if (id < kFirstCustomId) continue;
    ++custom;
    own += id == kFirstCustomId + HashName(category.path) % (65536 - kFirstCustomId);
  }
  // Most keep the id that they have alone.
  EXPECT_LT(own, custom);
  EXPECT_GT(static_cast<double>(own), 0.85 * static_cast<double>(custom));
  // Entities went along. Repeated names got a number behind.
  for (const auto& built : {scene, reversed, shuffled})
    for (const Entity& entity : built->entities) EXPECT_TRUE(entity.name.starts_with(built->tree[entity.category].path));
}

TEST(Semantics, WhenIdsRunOutItIsSaid) {
  SemanticTree tree;
  EXPECT_THROW(
      {
        for (int i = 0; i < 70000; ++i) tree.Add("n" + std::to_string(i));
      },
      InputError);
}

TEST(Semantics, ACustomPathHasTheSameIdInEveryTreeAndInheritsFromItsAncestor) {
  SemanticTree a, b;
  b.Add("vehicle/car/police");
  a.Add("robot/arm/gripper");
  EXPECT_EQ(a.Add("vehicle/car/police"), b.At("vehicle/car/police"));
  EXPECT_EQ(a[a.At("vehicle/car/police")].cityscapes, 26);
  EXPECT_THROW(a.Add("Vehicle//x"), InputError);
}

TEST(Semantics, AnUnknownPathNamesTheNearest) {
  try {
    SemanticTree().At("vegetation/tree/conifer/pin");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("vegetation/tree/conifer/pine"), std::string::npos);
  }
}

TEST(SceneBuilder, EntityNamesBecomeUnique) {
  SceneBuilder builder("test");
  const CategoryId car = builder.tree().At("vehicle/car");
  builder.AddEntity("car", car);
  builder.AddEntity("car 2", car);
  builder.AddEntity("car", car);
  builder.AddEntity("car", car);
  const auto scene = builder.Build();
  std::set<std::string> names;
  for (const Entity& entity : scene->entities) EXPECT_TRUE(names.insert(entity.name).second) << entity.name;
}

TEST(SceneBuilder, BoundsFollowTheInstanceTransform) {
  SceneBuilder builder("test");
  const MeshId mesh = builder.AddMesh(UnitTriangle());
  const EntityId id = builder.AddEntity("thing", builder.tree().At("object"));
  builder.AddInstance({mesh, PlaceUpright({10, 20, 30}, 0, 2), id, {1, 1, 1}});
  const auto scene = builder.Build();
  EXPECT_EQ(scene->entity(id).bounds.min, (Vec3f{10, 20, 30}));
  EXPECT_EQ(scene->entity(id).bounds.max, (Vec3f{12, 22, 30}));
}

// A lamp with an arm: a crowd of vertices round the mast, one far out at its end.
TEST(SceneBuilder, BoxesOfOftenInstancedMeshesHoldEveryVertexAndNoMore) {
  SceneBuilder builder("test");
  Mesh lamp;
  for (int i = 0; i < 3000; ++i) {
    const float t = static_cast<float>(i) * 0.37f, arm = i % 3 == 0 ? static_cast<float>(i) / 3000 : 0;
    lamp.positions.push_back({0.1f * std::cos(t), 0.1f * std::sin(t) - 6 * arm, 0.002f * static_cast<float>(i) + 0.3f * arm});
  }
  for (uint32_t i = 0; i + 2 < 3000; i += 3) lamp.triangles.push_back({i, i + 1, i + 2});
  lamp.normals.assign(lamp.positions.size(), {0, 0, 1});
  lamp.parts = {{0, static_cast<uint32_t>(lamp.triangles.size()), 0, kNoEntity}};
  const MeshId mesh = builder.AddMesh(lamp);
  builder.AddMaterial({});
  std::vector<std::pair<EntityId, AffineTransform>> placed;
  for (int i = 0; i < 20; ++i) {
    const EntityId id = builder.AddEntity("lamp", builder.tree().At("furniture/lighting/street_light"));
    placed.emplace_back(id, PlaceUpright({10.0f * static_cast<float>(i), 3, 1}, 0.7f * static_cast<float>(i), 1.1f));
    builder.AddInstance({mesh, placed.back().second, id, {1, 1, 1}});
  }
  const auto scene = builder.Build();
  for (const auto& [id, X] : placed) {
    Box3f exact;
    for (Vec3f p : lamp.positions) exact.Add(X * p);
    const Box3f& box = scene->entity(id).bounds;
    EXPECT_LT(Norm(box.min - exact.min), 1e-4f);
    EXPECT_LT(Norm(box.max - exact.max), 1e-4f);
  }
}

TEST(SceneBuilder, RefusesWhatWouldBreakARenderer) {
  const auto build = [](auto damage) {
    SceneBuilder builder("test");
    builder.AddMaterial({});
    Mesh mesh = UnitTriangle();
    Instance instance{0, {}, builder.AddEntity("thing", builder.tree().At("object")), {1, 1, 1}};
    damage(mesh, instance);
    builder.AddMesh(mesh);
    builder.AddInstance(instance);
    return builder.Build();
  };
  EXPECT_NO_THROW(build([](Mesh&, Instance&) {}));
  EXPECT_THROW(build([](Mesh& m, Instance&) { m.triangles[0].y = 3; }), InputError);
  EXPECT_THROW(build([](Mesh& m, Instance&) { m.positions[0].x = NAN; }), InputError);
  EXPECT_THROW(build([](Mesh& m, Instance&) { m.parts = {{0, 2, 0, kNoEntity}}; }), InputError);
  EXPECT_THROW(build([](Mesh& m, Instance&) { m.parts = {{0, 1, 7, kNoEntity}}; }), InputError);
  EXPECT_THROW(build([](Mesh&, Instance& i) { i.entity = kNoEntity; }), InputError);
  EXPECT_THROW(build([](Mesh&, Instance& i) { i.mesh = 9; }), InputError);
}

TEST(Texture, MipsAverageInLinearLight) {
  Image<Rgba8> checker(2, 2);
  checker(0, 0) = checker(1, 1) = {255, 255, 255, 255};
  checker(1, 0) = checker(0, 1) = {0, 0, 0, 255};
  const Texture texture = Texture::FromImage("checker", checker, true);
  ASSERT_EQ(texture.levels.size(), 2u);
  EXPECT_EQ(texture.levels[1](0, 0).r, 188);  // sRGB of linear 0.5
}

}  // namespace
}  // namespace airsim360
