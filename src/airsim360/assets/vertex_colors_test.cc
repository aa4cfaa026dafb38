// Colours of vertices in glTF and OBJ: what each kind of number means, and that every step of an import keeps them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <tuple>

#include "airsim360/assets/export/export.h"
#include "airsim360/assets/gltf/gltf_test_internal.h"
#include "airsim360/assets/importing/import.h"
#include "airsim360/assets/merge.h"
#include "airsim360/assets/obj/obj.h"
#include "airsim360/assets/test_text.h"
#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/image/color.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using internal::Contains;
using internal::GltfDocument;
using internal::ImportedFile;
using nlohmann::json;

constexpr int kU8 = 5121, kU16 = 5123, kF32 = 5126;

// The test triangle with an accessor of colours.
template <class T>
GltfDocument Colored(const std::vector<T>& values, int component_type, const std::string& type) {
  GltfDocument doc = GltfDocument::Triangle();
  const size_t colors = doc.AddAccessor<T>(values, component_type, type);
  if (component_type != kF32) doc.json["accessors"][colors]["normalized"] = true;
  doc.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colors;
  return doc;
}

std::string ErrorOf(const GltfDocument& doc) {
  try {
    internal::ReadText(doc.Text());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

ImportedFile ReadObjText(const std::string& text, const std::string& mtl = {}) {
  return internal::ReadObj("test.obj", text, [&](const std::string&) -> std::optional<Bytes> {
    if (mtl.empty()) return std::nullopt;
    const auto bytes = AsBytes(mtl);
    return Bytes(bytes.begin(), bytes.end());
  });
}

std::string ObjErrorOf(const std::string& text) {
  try {
    ReadObjText(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(VertexColor, KeepsEveryValueOfEightAndSixteenBits) {
  for (int i = 0; i <= 65535; ++i) {
    const float x = static_cast<float>(i) / 65535.0f;
    const VertexColor c = MakeVertexColor({x, x, x}, x);
    ASSERT_TRUE(c.r == i && c.a == i) << i;
    ASSERT_NEAR(LinearColor(c).x, x, 6e-8) << i;
  }
  for (int i = 0; i <= 255; ++i) {
    const float x = static_cast<float>(i) / 255.0f;
    EXPECT_EQ(MakeVertexColor({x, 0, 0}).r, 257 * i);
    // What sRGB has in eight bits comes back from linear light in sixteen.
    EXPECT_EQ(LinearToSrgb8(LinearColor(MakeVertexColor({SrgbToLinear(static_cast<uint8_t>(i)), 0, 0})).x), i);
  }
  EXPECT_EQ(LinearColor(VertexColor{}), (Vec3f{1, 1, 1}));
  EXPECT_EQ(MakeVertexColor({-0.5f, NAN, 7}, INFINITY), (VertexColor{0, 0, 65535, 65535}));
}

TEST(GltfVertexColors, AreLinearInEveryTypeAndMakeNoParts) {
  const std::vector<VertexColor> opaque = {{257, 514, 771}, {65535, 0, 0}, {0, 0, 65535}};
  const std::vector<VertexColor> covering = {{257, 514, 771, 1028}, {65535, 0, 0, 0}, {0, 0, 65535, 65535}};
  const std::vector<float> rgb = {1 / 255.f, 2 / 255.f, 3 / 255.f, 1, 0, 0, 0, 0, 1};
  const std::vector<float> rgba = {1 / 255.f, 2 / 255.f, 3 / 255.f, 4 / 255.f, 1, 0, 0, 0, 0, 0, 1, 1};
  const auto read = [](const GltfDocument& doc) {
    const ImportedFile file = internal::ReadText(doc.Text());
    EXPECT_EQ(file.meshes[0].parts.size(), 1u);
    // White where there is no material, so that the vertices alone tell the colour.
    EXPECT_EQ(file.materials[file.meshes[0].parts[0].material].base_color, (Vec3f{1, 1, 1}));
    return file.meshes[0].colors;
  };
  EXPECT_EQ(read(Colored<float>(rgb, kF32, "VEC3")), opaque);
  EXPECT_EQ(read(Colored<float>(rgba, kF32, "VEC4")), covering);
  EXPECT_EQ(read(Colored<uint8_t>({1, 2, 3, 4, 255, 0, 0, 0, 0, 0, 255, 255}, kU8, "VEC4")), covering);
  EXPECT_EQ(read(Colored<uint16_t>({257, 514, 771, 1028, 65535, 0, 0, 0, 0, 0, 65535, 65535}, kU16, "VEC4")), covering);
  EXPECT_EQ(read(Colored<uint8_t>({1, 2, 3, 255, 0, 0, 0, 0, 255}, kU8, "VEC3")), opaque);
  EXPECT_EQ(read(Colored<uint16_t>({257, 514, 771, 65535, 0, 0, 0, 0, 65535}, kU16, "VEC3")), opaque);
}

TEST(GltfVertexColors, OfOnePrimitiveLeaveTheOthersOfItsMeshWhite) {
  for (const bool first : {true, false}) {
    GltfDocument doc = Colored<float>({1, 0, 0, 0, 1, 0, 0, 0, 1}, kF32, "VEC3");
    json& primitives = doc.json["meshes"][0]["primitives"];
    json plain = primitives[0];
    plain["attributes"].erase("COLOR_0");
    primitives.insert(first ? primitives.end() : primitives.begin(), plain);
    const Mesh mesh = internal::ReadText(doc.Text()).meshes[0];
    ASSERT_EQ(mesh.colors.size(), 6u);
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(mesh.colors[(first ? 3 : 0) + i], VertexColor{});
      EXPECT_EQ(LinearColor(mesh.colors[(first ? 0 : 3) + i])[static_cast<int>(i)], 1);
    }
  }
  EXPECT_TRUE(internal::ReadText(GltfDocument::Triangle().Text()).meshes[0].colors.empty());
}

TEST(GltfVertexColors, NumbersBeyondTheirRangeAreClampedAndDamageNamesItsPlace) {
  const auto colors =
      internal::ReadText(Colored<float>({2, -1, NAN, INFINITY, -INFINITY, 0.5f, 0, 1, 1e-9f}, kF32, "VEC3").Text()).meshes[0].colors;
  EXPECT_EQ(colors[0], (VertexColor{65535, 0, 0}));
  EXPECT_EQ(colors[1], (VertexColor{65535, 0, 32768}));
  EXPECT_EQ(colors[2], (VertexColor{0, 65535, 0}));
  EXPECT_TRUE(Contains(ErrorOf(Colored<float>({1, 1, 1}, kF32, "VEC3")), {"COLOR_0", "1 elements for 3 vertices"}));
  EXPECT_TRUE(Contains(ErrorOf(Colored<float>(std::vector<float>(16), kF32, "VEC4")), {"4 elements for 3 vertices"}));
  EXPECT_TRUE(Contains(ErrorOf(Colored<float>({1, 1, 1}, kF32, "SCALAR")), {"VEC3 expected"}));
  GltfDocument absent = Colored<float>({1, 1, 1, 1, 1, 1, 1, 1, 1}, kF32, "VEC3");
  absent.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 99;
  EXPECT_TRUE(Contains(ErrorOf(absent), {"COLOR_0", "99"}));
  GltfDocument cut = Colored<float>({1, 1, 1, 1, 1, 1, 1, 1, 1}, kF32, "VEC3");
  cut.json["accessors"].back()["byteOffset"] = 8;
  EXPECT_TRUE(Contains(ErrorOf(cut), {"3 elements need 36 bytes at offset 8"}));
}

// Alpha is coverage: cut where it is tested, a pane where it is see-through everywhere, nothing where it is not asked.
TEST(GltfVertexColors, CoverageFollowsTheAlphaMode) {
  const auto read = [](const char* mode, std::vector<uint8_t> alpha, double base_alpha = 1) {
    GltfDocument doc = Colored<uint8_t>({255, 0, 0, alpha[0], 255, 0, 0, alpha[1], 255, 0, 0, alpha[2]}, kU8, "VEC4");
    doc.json["materials"] = json::array({{{"alphaMode", mode}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, base_alpha}}}}}});
    doc.json["meshes"][0]["primitives"][0]["material"] = 0;
    const ImportedFile file = internal::ReadText(doc.Text());
    return file.materials[file.meshes[0].parts[0].material];
  };
  EXPECT_EQ(read("OPAQUE", {0, 100, 255}).alpha_mode, AlphaMode::kOpaque);
  EXPECT_EQ(read("MASK", {0, 100, 255}).alpha_mode, AlphaMode::kMask);
  const Material cut = read("BLEND", {0, 100, 255});
  EXPECT_EQ(cut.alpha_mode, AlphaMode::kMask);
  EXPECT_EQ(cut.alpha_cutoff, 0.5f);
  EXPECT_EQ(cut.kind, SurfaceKind::kStandard);
  const Material solid = read("BLEND", {255, 255, 255});
  EXPECT_EQ(solid.alpha_mode, AlphaMode::kOpaque);
  EXPECT_EQ(solid.kind, SurfaceKind::kStandard);
  const Material pane = read("BLEND", {51, 51, 51});
  EXPECT_EQ(pane.kind, SurfaceKind::kGlass);
  // As if the material itself covered that much.
  const Material same = read("BLEND", {255, 255, 255}, 0.2);
  EXPECT_NEAR(pane.transmission, same.transmission, 1e-6);
  EXPECT_NEAR(pane.base_color.x, same.base_color.x, 1e-6);
}

TEST(ObjVertexColors, AreSrgbAndStayWithTheirVertices) {
  const ImportedFile file = ReadObjText("v 0 0 0 1 0 0\nv 1 0 0 0 0.50196 0\nv 1 1 0 0 0 1 # blue\nv 0 1 0\nv 9 9 9 0.5\nf 1 2 3 4\n");
  const Mesh& mesh = file.meshes.at(0);
  ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
  std::map<std::pair<float, float>, VertexColor> at;
  for (size_t i = 0; i < mesh.colors.size(); ++i) at[{mesh.positions[i].x, mesh.positions[i].z}] = mesh.colors[i];
  EXPECT_EQ(at.size(), 4u);
  EXPECT_EQ((at[{0, 0}]), (VertexColor{65535, 0, 0}));
  EXPECT_EQ((at[{1, 1}]), (VertexColor{0, 0, 65535}));
  EXPECT_EQ((at[{0, 1}]), VertexColor{});
  EXPECT_EQ(LinearToSrgb8(LinearColor(at[{1, 0}]).y), 128);
  EXPECT_NEAR(LinearColor(at[{1, 0}]).y, 0.2158, 2e-4);
  EXPECT_EQ(file.materials.at(0).base_color, (Vec3f{1, 1, 1}));
  EXPECT_TRUE(file.warnings.empty());
}

TEST(ObjVertexColors, MultiplyTheMaterialAndAreAbsentWhereNoneAreWritten) {
  const std::string square = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\n";
  const ImportedFile file = ReadObjText("mtllib m.mtl\n" + square + "usemtl a\nf 1 2 3\n", "newmtl a\nKd 0.5 0.25 1\n");
  EXPECT_EQ(file.materials.at(0).base_color, (Vec3f{0.5f, 0.25f, 1}));
  EXPECT_EQ(file.meshes.at(0).colors.size(), 3u);
  // Weights of curves, and words that are no numbers, are no colours.
  const ImportedFile plain = ReadObjText("v 0 0 0 1\nv 1 0 0 1 1\nv 1 1 0 # 1 0 0\nf 1 2 3\n");
  EXPECT_TRUE(plain.meshes.at(0).colors.empty());
  EXPECT_EQ(plain.materials.at(0).base_color, (Vec3f{0.8f, 0.8f, 0.8f}));
}

TEST(ObjVertexColors, BeyondTheirRangeAreClampedWithAWarningAndDamageNamesItsLine) {
  const ImportedFile file = ReadObjText("v 0 0 0 1 1 1\nv 1 0 0 255 128 0\nv 1 1 0 -1 0 2\nf 1 2 3\n");
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(Contains(file.warnings[0], {"test.obj:2", "vertex colours"}));
  EXPECT_EQ(std::count(file.meshes[0].colors.begin(), file.meshes[0].colors.end(), (VertexColor{0, 0, 65535})), 1);
  EXPECT_EQ(std::count(file.meshes[0].colors.begin(), file.meshes[0].colors.end(), (VertexColor{65535, 65535, 0})), 1);
  EXPECT_TRUE(Contains(ObjErrorOf("v 0 0 0\nv 0 0 0 1 nan 1\n"), {"test.obj:2", "'nan' is not a finite number"}));
  EXPECT_TRUE(Contains(ObjErrorOf("v 0 0 0 red green blue\n"), {"test.obj:1", "'red' is not a number"}));
}

// A cube of eight corners has 24 once every face has its own normals.
TEST(VertexColors, SurviveGeneratedNormalsMergingAndSplitting) {
  std::string text;
  RngStream rng(4, "colours");
  for (int i = 0; i < 8; ++i) {
    text += "v " + std::to_string(i & 1) + " " + std::to_string(i >> 1 & 1) + " " + std::to_string(i >> 2);
    for (int k = 0; k < 3; ++k) text += " " + std::to_string(rng.Uniform(0, 1));
    text += "\n";
  }
  text += "o one\nusemtl grass\nf 1 3 4 2\nf 5 6 8 7\nusemtl tree leaf\nf 1 2 6 5\nf 3 7 8 4\no two\nf 1 5 7 3\nf 2 4 8 6\n";
  const ImportedFile file = ReadObjText(text);
  std::map<std::tuple<float, float, float>, VertexColor> truth;
  const auto expect_truth = [&](const Mesh& mesh) {
    ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      const Vec3f p = mesh.positions[i];
      const auto [it, is_new] = truth.try_emplace({p.x, p.y, p.z}, mesh.colors[i]);
      EXPECT_EQ(it->second, mesh.colors[i]);
    }
  };
  for (const Mesh& mesh : file.meshes) expect_truth(mesh);
  EXPECT_EQ(truth.size(), 8u);

  ImportedFile mixed = file;
  mixed.meshes[1].colors.clear();
  const Mesh half = internal::MergeNodes(mixed, "half", 1000).mesh;
  EXPECT_EQ(half.colors.size(), half.positions.size());
  EXPECT_EQ(std::count(half.colors.begin(), half.colors.end(), VertexColor{}), static_cast<int64_t>(file.meshes[1].positions.size()));
  expect_truth(internal::MergeNodes(file, "whole", 1000).mesh);

  const fs::path path = fs::temp_directory_path() / "airsim360_vertex_colors.obj";
  WriteFileAtomically(path, text);
  const auto scene = ImportScene(path);  // splits "one" by the grounds and plants that its materials name
  fs::remove(path);
  EXPECT_GT(scene->meshes.size(), 2u);
  for (const Mesh& mesh : scene->meshes) expect_truth(mesh);
}

// Corners of all triangles in W with their colours, in any order.
std::vector<std::tuple<float, float, float, uint16_t, uint16_t, uint16_t, uint16_t>> ColoredCorners(const Scene& scene) {
  std::vector<std::tuple<float, float, float, uint16_t, uint16_t, uint16_t, uint16_t>> out;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const Vec3u& t : mesh.triangles) {
      for (uint32_t v : {t.x, t.y, t.z}) {
        const Vec3f p = instance.X_WM * mesh.positions[v];
        const VertexColor c = mesh.colors.empty() ? VertexColor{} : mesh.colors[v];
        out.emplace_back(p.x, p.y, p.z, c.r, c.g, c.b, c.a);
      }
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(VertexColors, ComeBackFromAnExportToTheBit) {
  SceneBuilder builder("colours");
  builder.AddSky();
  const EntityId entity = builder.AddEntity("thing", builder.tree().At("furniture"));
  const MaterialId cut = builder.AddMaterial({.name = "cut", .alpha_mode = AlphaMode::kMask, .alpha_cutoff = 0.25f}),
                   plain = builder.AddMaterial({.name = "plain"});
  RngStream rng(7, "export");
  Mesh mesh{"mesh", {}, {}, {}, {}, {}};
  for (uint32_t i = 0; i < 60; ++i) {
    const auto any = [&] { return static_cast<float>(rng.Uniform(-1, 1)); };
    mesh.positions.push_back({any(), any(), any()});
    mesh.normals.push_back({0, 0, 1});
    const auto channel = [&] { return static_cast<uint16_t>(rng.Index(65536)); };
    mesh.colors.push_back({channel(), channel(), channel(), channel()});
    if (i % 3 == 2) mesh.triangles.push_back({i - 2, i - 1, i});
  }
  mesh.parts = {{0, 12, cut, kNoEntity}, {12, 8, plain, kNoEntity}};
  Mesh bare = mesh;
  bare.colors.clear();
  builder.AddInstance({builder.AddMesh(mesh), PlaceUpright({1, 2, 3}, 0.5f), entity});
  builder.AddInstance({builder.AddMesh(bare), {}, entity});
  const auto scene = builder.Build();
  const fs::path path = fs::temp_directory_path() / "airsim360_vertex_colors.glb";
  WriteFileAtomically(path, EncodeGlb(*scene));
  const auto back = ImportScene(path);
  fs::remove(path);
  EXPECT_EQ(ColoredCorners(*back), ColoredCorners(*scene));
  const auto none = [](const Scene& s) {
    return std::count_if(s.meshes.begin(), s.meshes.end(), [](const Mesh& m) { return m.colors.empty(); });
  };
  EXPECT_EQ(none(*back), 1);
}

TEST(VertexColors, AsManyAsVerticesOrTheSceneIsRefused) {
  SceneBuilder builder("bad");
  builder.AddMaterial({});
  Mesh mesh{"mesh", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}, {{0, 1, 0, kNoEntity}}};
  mesh.colors.resize(2);
  builder.AddInstance({builder.AddMesh(mesh), {}, builder.AddEntity("x", builder.tree().At("furniture"))});
  EXPECT_THROW(builder.Build(), InputError);
}

}  // namespace
}  // namespace airsim360
