#include "airsim360/opening/world_city.h"

#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/worlds/props/placed_models.h"

namespace airsim360 {
namespace {

WorldAdditions Read(std::string_view text) {
  WorldAdditions additions;
  ReadYaml(text, "town.yaml", [&](ConfigVisitor& v) { additions.Visit(v); });
  return additions;
}

std::string CityError(std::string_view text) {
  try {
    WorldAdditions additions = Read(text);
    additions.Resolve("town.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(WorldAdditions, AreReadFromAWorldFile) {
  const WorldAdditions read = Read(
      "city: {style: 1950s, height: 0.7, traffic: 0.2, styles: [deco, brownstone]}\nprops:\n  - {model: a.glb, label: "
      "vehicle/car, x: 3, yaw_deg: 90}\n");
  EXPECT_EQ(read.city.style, CityStyle::k1950s);
  EXPECT_EQ(read.city.height, 0.7);
  EXPECT_EQ(read.city.styles.size(), 2u);
  ASSERT_EQ(read.props.size(), 1u);
  EXPECT_EQ(read.props[0].label, "vehicle/car");
  EXPECT_EQ(read.props[0].x, 3);
  EXPECT_FALSE(read.no_city());
  EXPECT_TRUE(read.no_town());
  EXPECT_TRUE(WorldAdditions().no_city() && WorldAdditions().no_town());
}

TEST(WorldAdditions, MistakesAreNamedWithLineAndNearestKey) {
  const std::string unknown = CityError("city:\n  trafic: 1\n");
  EXPECT_NE(unknown.find("town.yaml:2"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("traffic"), std::string::npos) << unknown;
  EXPECT_NE(CityError("city: {height: 9}").find("town.yaml:1"), std::string::npos);
  EXPECT_NE(CityError("city: {styles: [decco]}").find("deco"), std::string::npos);
  const std::string time = CityError("city: {style: 1950}");
  EXPECT_NE(time.find("1950s"), std::string::npos) << time;
  EXPECT_NE(CityError("props: [{label: vehicle/car}]").find("model"), std::string::npos);
  EXPECT_NE(CityError("props: [{model: nowhere.glb}]").find("nowhere.glb"), std::string::npos);
}

TEST(PlacedModels, BecomeEntitiesOfTheirCategory) {
  SceneBuilder builder("test");
  builder.AddSky();
  PropShelf shelf(builder, nullptr, 0);
  Model model;
  model.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}};
  model.mesh.triangles = {{0, 1, 2}};
  internal::AddPlacedModels(builder, shelf, {{"kiosk", "furniture/vending/kiosk", model, {5, 6, 0}, 0, 2}});
  const auto scene = builder.Build();
  const Entity& kiosk = scene->entities.back();
  EXPECT_EQ(kiosk.name, "kiosk");
  EXPECT_EQ(scene->tree[kiosk.category].path, "furniture/vending/kiosk");
  EXPECT_EQ(kiosk.bounds.min, (Vec3f{5, 6, 0}));
  EXPECT_EQ(kiosk.bounds.max, (Vec3f{7, 8, 2}));
}

}  // namespace
}  // namespace airsim360
