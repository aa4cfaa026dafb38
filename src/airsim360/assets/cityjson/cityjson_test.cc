// CityJSON: a hand-made house, road and tree (data/cityjson) against closed forms; damage; streams.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "airsim360/assets/cityjson/cityjson.h"
#include "airsim360/assets/importing/import.h"
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

std::string CityJsonError(const std::string& text) {
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

// The box of a node's mesh in W.
Box3f BoxOf(const ImportedFile& file, const ImportedNode& node) {
  Box3f box;
  for (Vec3f p : file.meshes[static_cast<size_t>(node.mesh)].positions) box.Add(node.X_WM * p);
  return box;
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
  std::map<std::string, Box3f> boxes;
  Box3f all;
  for (const ImportedNode& node : file.nodes) {
    meshes[node.name] = &file.meshes[static_cast<size_t>(node.mesh)];
    boxes[node.name] = BoxOf(file, node);
    all.Add(boxes[node.name]);
    // Its place is the middle of its foot.
    EXPECT_LT(Norm(node.X_WM.p - Vec3f{boxes[node.name].center().x, boxes[node.name].center().y, boxes[node.name].min.z}), 1e-4f)
        << node.name;
  }
  // Two slopes over half of 6 m, rising 3 m; the floor with its hole; long walls, gables.
  EXPECT_NEAR(AreaOf(*meshes.at("house-1/roof"), false), 2 * 10 * std::hypot(3, 3), 1e-3);
  EXPECT_NEAR(AreaOf(*meshes.at("house-1"), true), 60 - 4, 1e-3);
  EXPECT_NEAR(AreaOf(*meshes.at("house-1"), false), 56 + 2 * 50 + 2 * (30 + 9), 1e-3);
  EXPECT_NEAR(static_cast<double>(boxes.at("house-1/roof").max.z), 8, 1e-4);
  // The template at twice its size, at its anchor, 4 m east of the house.
  const Box3f tree = boxes.at("tree-1"), house = boxes.at("house-1");
  EXPECT_NEAR(static_cast<double>(tree.max.z), 6, 1e-4);
  EXPECT_NEAR(static_cast<double>(tree.center().x - house.max.x), 4, 1e-3);
  // The middle of everything is x = y = 0.
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
  const std::string head =
      R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"CityObjects":{},"vertices":[]})";
  const std::string feature =
      R"({"type":"CityJSONFeature","id":"a","CityObjects":{"a":{"type":"LandUse","geometry":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}]}},"vertices":[[0,0,0],[2,0,0],[0,2,0]]})";
  const ImportedFile file = ReadCityJson("s.city.jsonl", head + "\n" + feature + "\n");
  ASSERT_EQ(file.nodes.size(), 1u);
  EXPECT_NEAR(AreaOf(file.meshes[0], false), 2, 1e-6);
}

// Squares of 1 m at z = 0, side by side, as the surfaces of a geometry with further members.
std::string Squares(int count, const std::string& members, const std::string& kind = "MultiSurface") {
  std::string boundaries;
  for (int i = 0; i < count; ++i) {
    const int n = 4 * i;
    boundaries += (i ? "," : "") + std::string("[[") + std::to_string(n) + "," + std::to_string(n + 1) + "," + std::to_string(n + 2) + "," +
                  std::to_string(n + 3) + "]]";
  }
  if (kind == "Solid") boundaries = "[" + boundaries + "]";
  return R"({"type":")" + kind + R"(","boundaries":[)" + boundaries + "]," + members + "}";
}
std::string City(const std::string& objects, const std::string& more = "") {
  std::string vertices;
  for (int i = 0; i < 6; ++i)
    for (const char* corner : {"0,0", "1,0", "1,1", "0,1"}) {
      const std::string x = std::to_string(i * 2 + (corner[0] - '0'));
      vertices += (vertices.empty() ? "[" : ",[") + x + std::string(corner + 1) + ",0]";
    }
  return R"({"type":"CityJSON","version":"1.1",)" + more + R"("CityObjects":{)" + objects + R"(},"vertices":[)" + vertices + "]}";
}
std::map<std::string, double> AreasByName(const ImportedFile& file) {
  std::map<std::string, double> areas;
  for (const ImportedNode& node : file.nodes) areas[node.name] = AreaOf(file.meshes[static_cast<size_t>(node.mesh)], false);
  return areas;
}

TEST(CityJson, PartsAreOfOneEntityWithTheirBuilding) {
  const std::string part = R"({"type":"BuildingPart","parents":["b"],"geometry":[)" + Squares(1, R"("lod":"2")") + "]}";
  const ImportedFile file =
      ReadCityJson("p.city.json", City(R"("b":{"type":"Building","children":["p","q"],"geometry":[]},"p":)" + part + R"(,"q":)" + part));
  EXPECT_EQ(AreasByName(file), (std::map<std::string, double>{{"b", 2}}));
  EXPECT_NE(CityJsonError(City(R"("p":)" + part)).find("/CityObjects/p/parents/0: there is no such object"), std::string::npos);
}

TEST(CityJson, TheHighestLevelOfDetailCountsTemplatesIncluded) {
  const std::string instance =
      R"({"type":"GeometryInstance","template":0,"boundaries":[0],"transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})";
  const auto templates = [](const std::string& lod) {
    return R"("geometry-templates":{"templates":[{"type":"MultiSurface","lod":)" + lod +
           R"(,"boundaries":[[[0,1,2]]]}],"vertices-templates":[[0,0,0],[1,0,0],[0,1,0]]},)";
  };
  const std::string object = R"("t":{"type":"CityFurniture","geometry":[)" + Squares(1, R"("lod":"1")") + "," +
                             Squares(3, R"("lod":"2.2")") + "," + Squares(2, R"("lod":2)") + "," + instance + "]}";
  EXPECT_NEAR(AreasByName(ReadCityJson("l.city.json", City(object, templates("1")))).at("t"), 3, 1e-6);
  EXPECT_NEAR(AreasByName(ReadCityJson("l.city.json", City(object, templates("\"3\"")))).at("t"), 0.5, 1e-6);
  for (const char* lod : {"\"high\"", "\"2,2\"", "\"2.2 \"", "\"\"", "\"1e999\"", "-1", "\"10\"", "null", "[2]"})
    EXPECT_NE(CityJsonError(City(R"("t":{"type":"Road","geometry":[)" + Squares(1, R"("lod":)" + std::string(lod)) + "]}"))
                  .find("/CityObjects/t/geometry/0/lod: "),
              std::string::npos)
        << lod;
}

TEST(CityJson, MaterialsOfTheFileColourItsSurfaces) {
  const std::string appearance =
      R"("appearance":{"default-theme-material":"second","materials":[{"name":"red","diffuseColor":[1,0,0]},{"name":"blue","diffuseColor":[0,0,1]}]},)";
  const auto object = [](const std::string& material) {
    return R"("h":{"type":"Building","geometry":[)" +
           Squares(
               3,
               R"("lod":"2","semantics":{"surfaces":[{"type":"WallSurface"},{"type":"Window"}],"values":[[0,0,1]]},"material":)" + material,
               "Solid") +
           "]}";
  };
  const ImportedFile file =
      ReadCityJson("m.city.json", City(object(R"({"first":{"value":0},"second":{"values":[[0,1,null]]}})"), appearance));
  std::map<std::string, double> areas;
  for (const Mesh& mesh : file.meshes)
    for (const MeshPart& part : mesh.parts) areas[file.materials[part.material].name] += part.triangle_count / 2.0;
  EXPECT_EQ(areas, (std::map<std::string, double>{{"Building red 0", 1}, {"Building blue 1", 1}, {"Window", 1}}));
  for (const Material& material : file.materials) {
    if (material.name == "Building red 0") {
      EXPECT_EQ(material.base_color, (Vec3f{1, 0, 0}));
    }
    if (material.name == "Window") {
      EXPECT_EQ(material.kind, SurfaceKind::kGlass);
    }
  }
  EXPECT_NE(CityJsonError(City(object(R"({"second":{"values":[[0,7,null]]}})"), appearance)).find("there are 2 materials (7)"),
            std::string::npos);
}

TEST(CityJson, DamageNamesThePlace) {
  const std::string good = ReadTextFile(kHouse);
  EXPECT_NE(CityJsonError(Replaced(good, "[0, 1, 5, 4]", "[0, 1, 99, 4]")).find("/CityObjects/house-1/geometry/1/boundaries/0/1/0/2"),
            std::string::npos);
  EXPECT_NE(CityJsonError(Replaced(good, "\"2.0\"", "\"9.0\"")).find("/version"), std::string::npos);
  EXPECT_NE(CityJsonError(Replaced(good, "[[0, 1, 1, 1, 1, 2, 2]]", "[[0, 1, 1, 1, 7, 2, 2]]")).find("semantic"), std::string::npos);
  EXPECT_NE(CityJsonError(Replaced(good, "\"template\": 0", "\"template\": 3")).find("/template"), std::string::npos);
  EXPECT_NE(CityJsonError(good.substr(0, 700)).find("bad.city.json:"), std::string::npos);
  EXPECT_NE(CityJsonError(Replaced(good, "[0.001, 0.001, 0.001]", "[0, 1, 1]")).find("/transform/scale: no scale may be 0"),
            std::string::npos);
  EXPECT_NE(CityJsonError("{}").find("not CityJSON"), std::string::npos);
  EXPECT_NE(CityJsonError(Replaced(good, "[0.001, 0.001, 0.001]", "[1e300, 1, 1]")).find("out of range"), std::string::npos);
}

std::string KindError(const std::string& text) {
  try {
    CheckIsCityJson("x.json", text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Keys of JSON have no order: "type" may stand anywhere, also behind a megabyte of others.
TEST(CityJson, IsKnownWhereverItsTypeStands) {
  std::string text = ReadTextFile(kHouse);
  const std::string type = "\"type\": \"CityJSON\",";
  text = Replaced(text, type, "\"+note\": {\"type\": \"Feature\", \"of\": [\"" + std::string(1'200'000, 'x') + "\"]},");
  text.insert(text.rfind('}'), ", \"type\": \"CityJSON\"");
  const std::filesystem::path path = std::filesystem::temp_directory_path() / ("airsim360_" + std::to_string(getpid()) + ".city.json");
  WriteFileAtomically(path, std::string_view(text));
  const auto scene = ImportScene(path);
  std::filesystem::remove(path);
  EXPECT_EQ(scene->Count().unique_triangles, ImportScene(kHouse)->Count().unique_triangles);
}

TEST(CityJson, OtherJsonIsNamed) {
  EXPECT_EQ(KindError(ReadTextFile(kHouse)), "");
  EXPECT_EQ(KindError("{\"type\": \"CityJSON\"}\n{\"type\": \"CityJSONFeature\"}"), "");
  EXPECT_NE(KindError("{\"type\": \"CityJSONFeature\"}").find("before them"), std::string::npos);
  EXPECT_NE(KindError("{\"features\": [], \"conformsTo\": [], \"type\": \"FeatureCollection\"}").find("JSON-FG"), std::string::npos);
  EXPECT_NE(KindError("{\"type\": \"FeatureCollection\", \"features\": [{\"type\": \"CityJSON\"}]}").find("GeoJSON"), std::string::npos);
  EXPECT_NE(KindError("{\"a\": {\"type\": \"CityJSON\"}}").find("no \"type\""), std::string::npos);
  EXPECT_NE(KindError("[{\"type\": \"CityJSON\"}]").find("not CityJSON"), std::string::npos);
  EXPECT_EQ(KindError("{\"type\" 5"), "");  // damage: ReadCityJson tells its place
}

}  // namespace
}  // namespace airsim360::internal
