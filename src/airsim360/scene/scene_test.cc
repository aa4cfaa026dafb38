#include "airsim360/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "airsim360/base/error.h"

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
