// CityJSON: a hand-made house, road and tree (data/cityjson) against closed forms; damage; streams.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "airsim360/assets/cityjson.h"
#include "airsim360/assets/import.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360::internal {
namespace {

const char* const kHouse = "data/cityjson/house.city.json";

double AreaOf(const Mesh& mesh, bool only_level) {
  double sum = 0;
  for (Vec3u t : mesh.triangles) {
    const Vec3f n = Cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    if (!only_level || (std::abs(n.x) + std::abs(n.y) < 1e-3f * std::abs(n.z))) sum += static_cast<double>(Norm(n)) / 2;
  }
  return sum;
}

std::string ErrorOf(const std::string& text) {
  try {
    ReadCityJson("bad.city.json", text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string Replaced(std::string text, const std::string& what, const std::string& by) {
  const size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(CityJson, SurfacesBecomeNodesByTheirMeaning) {
  const ImportedFile file = ReadCityJson(kHouse, ReadTextFile(kHouse));
  std::map<std::string, const ImportedNode*> nodes;
  for (const ImportedNode& node : file.nodes) nodes[node.name] = &node;
  ASSERT_EQ(nodes.size(), 4u);
  EXPECT_EQ(nodes.at("house-1")->category, "construction/building");
  EXPECT_EQ(nodes.at("house-1/roof")->category, "construction/building/roof");
  EXPECT_EQ(nodes.at("road-1")->category, "ground/road");
  EXPECT_EQ(nodes.at("tree-1")->category, "vegetation/tree/broadleaf/generic");
}

TEST(CityJson, AreasAndHeightsAreThoseOfTheSolid) {
  const ImportedFile file = ReadCityJson(kHouse, ReadTextFile(kHouse));
  std::map<std::string, const Mesh*> meshes;
  for (const ImportedNode& node : file.nodes) meshes[node.name] = &file.meshes[static_cast<size_t>(node.mesh)];
  // Two slopes over half of 6 m, rising 3 m; the floor with its hole; long walls, gables.
  EXPECT_NEAR(AreaOf(*meshes.at("house-1/roof"), false), 2 * 10 * std::hypot(3, 3), 1e-3);
  EXPECT_NEAR(AreaOf(*meshes.at("house-1"), true), 60 - 4, 1e-3);
  EXPECT_NEAR(AreaOf(*meshes.at("house-1"), false), 56 + 2 * 50 + 2 * (30 + 9), 1e-3);
  EXPECT_NEAR(static_cast<double>(meshes.at("house-1/roof")->Bounds().max.z), 8, 1e-4);
  // The template at twice its size, at its anchor, 4 m east of the house.
  const Box3f tree = meshes.at("tree-1")->Bounds(), house = meshes.at("house-1")->Bounds();
  EXPECT_NEAR(static_cast<double>(tree.max.z), 6, 1e-4);
  EXPECT_NEAR(static_cast<double>(tree.center().x - house.max.x), 4, 1e-3);
  // The middle of everything is x = y = 0.
  Box3f all;
  for (const Mesh& mesh : file.meshes) all.Add(mesh.Bounds());
  EXPECT_NEAR(static_cast<double>(all.center().x), 0, 1e-3);
  EXPECT_NEAR(static_cast<double>(all.min.z), 0, 1e-6);
}

TEST(CityJson, TheWholeFileIsAWorld) {
  const auto scene = ImportScene(kHouse);
  int roofs = 0;
  for (const Entity& entity : scene->entities) roofs += scene->tree[entity.category].path == "construction/building/roof";
  EXPECT_EQ(roofs, 1);
  EXPECT_EQ(scene->entities.size(), 5u);  // and the sky
}

TEST(CityJson, AStreamOfFeaturesIsTheSame) {
  const std::string head = R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"CityObjects":{},"vertices":[]})";
  const std::string feature = R"({"type":"CityJSONFeature","id":"a","CityObjects":{"a":{"type":"LandUse","geometry":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}]}},"vertices":[[0,0,0],[2,0,0],[0,2,0]]})";
  const ImportedFile file = ReadCityJson("s.city.jsonl", head + "\n" + feature + "\n");
  ASSERT_EQ(file.nodes.size(), 1u);
  EXPECT_NEAR(AreaOf(file.meshes[0], false), 2, 1e-6);
}

TEST(CityJson, DamageNamesThePlace) {
  const std::string good = ReadTextFile(kHouse);
  EXPECT_NE(ErrorOf(Replaced(good, "[0, 1, 5, 4]", "[0, 1, 99, 4]")).find("/CityObjects/house-1/geometry/1/boundaries/0/1/0/2"), std::string::npos);
  EXPECT_NE(ErrorOf(Replaced(good, "\"2.0\"", "\"9.0\"")).find("/version"), std::string::npos);
  EXPECT_NE(ErrorOf(Replaced(good, "[[0, 1, 1, 1, 1, 2, 2]]", "[[0, 1, 1, 1, 7, 2, 2]]")).find("semantic"), std::string::npos);
  EXPECT_NE(ErrorOf(Replaced(good, "\"template\": 0", "\"template\": 3")).find("/template"), std::string::npos);
  EXPECT_NE(ErrorOf(good.substr(0, 700)).find("bad.city.json:"), std::string::npos);
  EXPECT_NE(ErrorOf("{}").find("not CityJSON"), std::string::npos);
  EXPECT_NE(ErrorOf(Replaced(good, "[0.001, 0.001, 0.001]", "[1e300, 1, 1]")).find("out of range"), std::string::npos);
}

}  // namespace
}  // namespace airsim360::internal
