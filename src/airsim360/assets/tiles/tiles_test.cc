#include "airsim360/assets/tiles/tiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "airsim360/assets/gltf/gltf_test_internal.h"
#include "airsim360/assets/test_text.h"
#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/geodesy.h"

namespace airsim360::internal {
namespace {

using Json = nlohmann::json;

std::string U32(uint64_t value) {
  std::string out;
  for (int k = 0; k < 4; ++k) out += static_cast<char>(value >> (8 * k));
  return out;
}

/// A batched tile around a .glb.
std::string Batched(const std::string& glb, std::string features = R"({"BATCH_LENGTH":0})", const std::string& binary = "") {
  features.resize((features.size() + 7) / 8 * 8, ' ');
  return "b3dm" + U32(1) + U32(28 + features.size() + binary.size() + glb.size()) + U32(features.size()) + U32(binary.size()) + U32(0) +
         U32(0) + features + binary + glb;
}

/// The test triangle (0, 0, 0), (1, 0, 0), (0, 0, 1) of W, its node named.
std::string Glb(const std::string& name) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["nodes"][0]["name"] = name;
  return doc.Glb();
}

/// Files beside a tileset.
class TilesTest : public testing::Test {
 protected:
  ImportedFile Read(const Json& tileset, size_t most = kMostTiles) {
    return ReadTileset("city/tileset.json", tileset.dump(), loader(), {}, most);
  }
  ResourceLoader loader() {
    return [this](const std::string& name) -> std::optional<Bytes> {
      asked_.push_back(name);
      const auto it = files_.find(name);
      if (it == files_.end()) return std::nullopt;
      const auto bytes = AsBytes(it->second);
      return Bytes(bytes.begin(), bytes.end());
    };
  }
  std::string ErrorOf(const Json& tileset) {
    try {
      Read(tileset);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  static Json Tile(double error, const char* refine, const std::string& uri, const Json& children = Json::array()) {
    Json tile{{"boundingVolume", {{"sphere", {0, 0, 0, 10}}}}, {"geometricError", error}, {"refine", refine}};
    if (!uri.empty()) tile["content"]["uri"] = uri;
    if (!children.empty()) tile["children"] = children;
    return tile;
  }
  static Json Tileset(const Json& root) { return {{"asset", {{"version", "1.0"}}}, {"geometricError", 100}, {"root", root}}; }
  static std::vector<std::string> Names(const ImportedFile& file) {
    std::vector<std::string> names;
    for (const ImportedNode& node : file.nodes) names.push_back(node.name);
    std::sort(names.begin(), names.end());
    return names;
  }

  std::map<std::string, std::string> files_;
  std::vector<std::string> asked_;
};

using Names_ = std::vector<std::string>;

TEST_F(TilesTest, TheFinestTilesReplaceTheirParentsOrAddToThem) {
  for (const char* name : {"a", "b", "c", "d", "e"}) files_[std::string(name) + ".b3dm"] = Batched(Glb(name));
  const Json fine = Json::array({Tile(0, "REPLACE", "b.b3dm"),
                                 Tile(5, "REPLACE", "c.b3dm", Json::array({Tile(0, "REPLACE", "d.b3dm"), Tile(0, "REPLACE", "e.b3dm")}))});
  EXPECT_EQ(Names(Read(Tileset(Tile(20, "REPLACE", "a.b3dm", fine)))), (Names_{"b", "d", "e"}));
  EXPECT_EQ(Names(Read(Tileset(Tile(20, "ADD", "a.b3dm", fine)))), (Names_{"a", "b", "d", "e"}));
  // Children that say nothing refine as their parents do.
  Json inherited = Tileset(Tile(20, "ADD", "a.b3dm", fine));
  inherited["root"]["children"][1].erase("refine");
  EXPECT_EQ(Names(Read(inherited)), (Names_{"a", "b", "c", "d", "e"}));
}

TEST_F(TilesTest, WhereThereAreTooManyTheCoarsestAreRefinedFirst) {
  for (const char* name : {"a", "b", "c", "d", "e"}) files_[std::string(name) + ".glb"] = Glb(name);
  const Json fine = Json::array(
      {Tile(0, "REPLACE", "b.glb"), Tile(5, "REPLACE", "c.glb", Json::array({Tile(0, "REPLACE", "d.glb"), Tile(0, "REPLACE", "e.glb")}))});
  const ImportedFile file = Read(Tileset(Tile(20, "REPLACE", "a.glb", fine)), 2);
  EXPECT_EQ(Names(file), (Names_{"b", "c"}));
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(Contains(file.warnings[0], {"more than 2 tiles", "geometric error of 5"}));
  EXPECT_EQ(Names(Read(Tileset(Tile(20, "REPLACE", "a.glb", fine)), 1)), (Names_{"a"}));
}

TEST_F(TilesTest, TransformsMultiplyAndRelativeToCentreMoves) {
  files_["a.b3dm"] = Batched(Glb("a"), R"({"BATCH_LENGTH":0,"RTC_CENTER":[100,200,300]})");
  Json root = Tile(10, "ADD", "", Json::array({Tile(0, "ADD", "a.b3dm")}));
  root["transform"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1};                // a quarter turn about z, then +7 x
  root["children"][0]["transform"] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 5, 1};  // twice as large, then +5 z
  const ImportedFile file = Read(Tileset(root));
  ASSERT_EQ(file.nodes.size(), 1u);
  const auto at = [&](Vec3f p) { return file.nodes[0].X_WM * p; };
  // (1, 0, 0) → + (100, 200, 300) → doubled, +5 z: (202, 400, 605) → turned: (-400, 202, 605) → (-393, 202, 605).
  EXPECT_EQ(at({1, 0, 0}), (Vec3f{-393, 202, 605}));
  EXPECT_EQ(at({0, 0, 1}), (Vec3f{-393, 200, 607}));
}

TEST_F(TilesTest, ATilesetOnTheEarthStandsUprightEastAndNorth) {
  // A tower of glTF, 1 m east and 1 m up, at a place; its transform is Earth-centred.
  const GeoPoint place{48.2, 16.37, 171};
  const Vec3d o = EcefFromGeodetic(place);
  const GeoFrame frame(place);
  const auto axis = [&](Vec3d v) { return (EcefFromGeodetic(frame.ToGeodetic(v * 10)) - o) / 10.0; };
  const Vec3d e = axis({1, 0, 0}), n = axis({0, 1, 0}), u = axis({0, 0, 1});
  files_["a.glb"] = Glb("a");
  Json root = Tile(0, "ADD", "a.glb");
  root["transform"] = {e.x, e.y, e.z, 0, n.x, n.y, n.z, 0, u.x, u.y, u.z, 0, o.x, o.y, o.z, 1};
  const ImportedFile placed = Read(Tileset(root));
  const auto at = [&](const ImportedFile& file, Vec3f p) { return file.nodes[0].X_WM * p; };
  const Vec3f corner = at(placed, {0, 0, 0});
  const auto near = [](Vec3f a, Vec3f b) { return Norm(a - b) < 1e-3f; };
  EXPECT_TRUE(near(at(placed, {1, 0, 0}) - corner, {1, 0, 0}));
  EXPECT_TRUE(near(at(placed, {0, 0, 1}) - corner, {0, 0, 1}));
  EXPECT_TRUE(near(corner, {-0.5f, 0, 0}));  // the middle of all lies at x = y = 0, the lowest point at z = 0

  // The same with the place in the glTF's own node (its +Y is up), and a region instead of a sphere.
  GltfDocument doc = GltfDocument::Triangle();
  const auto to_gltf = [](Vec3d v) { return Vec3d{v.x, v.z, -v.y}; };
  const Vec3d ge = to_gltf(e), gu = to_gltf(u), gs = to_gltf(-n), go = to_gltf(o);
  doc.json["nodes"][0]["matrix"] = {ge.x, ge.y, ge.z, 0, gu.x, gu.y, gu.z, 0, gs.x, gs.y, gs.z, 0, go.x, go.y, go.z, 1};
  files_["a.glb"] = doc.Glb();
  Json region = Tile(0, "ADD", "a.glb");
  region["boundingVolume"] = {{"region", {16.37 * kDegree, 48.2 * kDegree, 16.37 * kDegree, 48.2 * kDegree, 170, 172}}};
  const ImportedFile own = Read(Tileset(region));
  const Vec3f base = at(own, {0, 0, 0});
  EXPECT_TRUE(near(at(own, {1, 0, 0}) - base, {1, 0, 0}));
  EXPECT_TRUE(near(at(own, {0, 0, 1}) - base, {0, 0, 1}));
  EXPECT_TRUE(near(base, {-0.5f, 0, 0}));
}

TEST_F(TilesTest, TilesetsWithinStartInTheirOwnFolder) {
  files_["parts/inner.json"] = Tileset(Tile(0, "REPLACE", "x/a.glb?v=1.2.3")).dump();
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["nodes"][0]["name"] = "inner";
  doc.json["buffers"][0] = {{"uri", "data%20.bin"}, {"byteLength", doc.bytes().size()}};
  files_["parts/x/a.glb"] = doc.json.dump();
  files_["parts/x/data .bin"] = std::string(AsText(doc.bytes()));
  files_["coarse.glb"] = Glb("coarse");
  Json root = Tile(10, "REPLACE", "coarse.glb", Json::array({Tile(5, "REPLACE", "./parts/inner.json")}));
  EXPECT_EQ(Names(Read(Tileset(root))), (Names_{"inner"}));
}

TEST_F(TilesTest, CompositeTilesHoldSeveralAndSayWhatTheyLeaveOut) {
  std::string a = Batched(Glb("a")), b = Batched(Glb("b")), points = "pnts" + U32(1) + U32(12);
  files_["c.cmpt"] = "cmpt" + U32(1) + U32(16 + a.size() + b.size() + points.size()) + U32(3) + a + points + b;
  const ImportedFile file = Read(Tileset(Tile(0, "ADD", "c.cmpt")));
  EXPECT_EQ(Names(file), (Names_{"a", "b"}));
  EXPECT_TRUE(file.unlit.empty());
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(Contains(file.warnings[0], {"c.cmpt", "point cloud is left out"}));
}

TEST_F(TilesTest, UnlitMaterialsStayUnlit) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["materials"] = {{{"name", "scan"}, {"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
  doc.json["meshes"][0]["primitives"][0]["material"] = 0;
  const std::string a = Batched(Glb("a")), b = Batched(doc.Glb());
  files_["c.cmpt"] = "cmpt" + U32(1) + U32(16 + a.size() + b.size()) + U32(2) + a + b;
  const ImportedFile file = Read(Tileset(Tile(0, "ADD", "c.cmpt")));
  ASSERT_EQ(file.unlit.size(), 1u);
  ASSERT_LT(file.unlit[0], file.materials.size());
  EXPECT_EQ(file.materials[file.unlit[0]].name, "scan");
}

TEST_F(TilesTest, DamageNamesThePlace) {
  files_["a.glb"] = Glb("a");
  Json tileset = Tileset(Tile(0, "ADD", "a.glb"));
  const auto changed = [&](const Json::json_pointer& at, const Json& value) {
    Json copy = tileset;
    copy[at] = value;
    return ErrorOf(copy);
  };
  EXPECT_EQ(ErrorOf(tileset), "no error");
  EXPECT_TRUE(Contains(changed("/asset/version"_json_pointer, "2.0"), {"tileset.json", "/asset/version", "only 3D Tiles 1"}));
  EXPECT_TRUE(Contains(changed("/root/transform"_json_pointer, {1, 2, 3}), {"/root/transform"}));
  EXPECT_TRUE(Contains(changed("/root/boundingVolume"_json_pointer, Json::object()), {"/root/boundingVolume", "a region"}));
  EXPECT_TRUE(Contains(changed("/root/content/uri"_json_pointer, "b.glb"), {"'b.glb'", "missing"}));
  EXPECT_TRUE(Contains(changed("/root/content/uri"_json_pointer, "http://x/b.glb"), {"/root/content/uri", "no addresses"}));
  EXPECT_TRUE(Contains(changed("/root/content"_json_pointer, Json::object()), {"/root/content", "without a uri"}));
  // A tileset that holds itself ends.
  files_["loop.json"] = Tileset(Tile(1, "ADD", "loop.json")).dump();
  EXPECT_TRUE(Contains(ErrorOf(Tileset(Tile(1, "ADD", "loop.json"))), {"nested deeper"}));
  // Every cut of a batched tile is an error.
  const std::string whole = Batched(Glb("a"), R"({"RTC_CENTER":{"byteOffset":0}})", std::string(12, '\0'));
  for (size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(ReadTile("a.b3dm", AsBytes(whole.substr(0, size)), loader()), InputError) << size;
  EXPECT_NO_THROW(ReadTile("a.b3dm", AsBytes(whole), loader()));
}

TEST(Tileset, IsToldFromCityJson) {
  EXPECT_TRUE(LooksLikeTileset(R"({"asset": {"version": "1.0"}, "geometricError": 5, "root": {}})"));
  EXPECT_FALSE(LooksLikeTileset(R"({"type": "CityJSON", "version": "2.0"})"));
}

}  // namespace
}  // namespace airsim360::internal
