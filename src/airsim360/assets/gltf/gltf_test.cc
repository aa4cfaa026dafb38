#include "airsim360/assets/gltf/gltf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/assets/gltf/gltf_test_internal.h"
#include "airsim360/assets/test_text.h"
#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"

namespace airsim360::internal {
namespace {

using nlohmann::json;

void ExpectNear(Vec3f a, Vec3f b, float tolerance = 1e-6f) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Gltf, YUpBecomesZUp) {
  const ImportedFile file = ReadText(GltfDocument::Triangle().Text());
  ASSERT_EQ(file.meshes.size(), 1u);
  const Mesh& mesh = file.meshes[0];
  ASSERT_EQ(mesh.triangles.size(), 1u);
  ExpectNear(mesh.positions[1], {1, 0, 0});
  ExpectNear(mesh.positions[2], {0, 0, 1});
  ExpectNear(mesh.normals[0], {0, -1, 0});  // generated: the front of G faces -Y
  EXPECT_TRUE(mesh.uvs.empty());
  EXPECT_EQ(file.nodes[0].name, "node");
}

TEST(Gltf, GlbAndEmbeddedBuffersGiveTheSameMesh) {
  const GltfDocument doc = GltfDocument::Triangle();
  const ImportedFile a = ReadText(doc.Text());
  const std::string glb = doc.Glb();
  const ImportedFile b = ReadGltf("test.glb", AsBytes(glb), kNoFiles);
  EXPECT_EQ(a.meshes[0].positions, b.meshes[0].positions);
  EXPECT_EQ(a.meshes[0].triangles, b.meshes[0].triangles);
}

TEST(Gltf, ExternalBuffersAreAskedForByTheirDecodedName) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["buffers"][0] = {{"uri", "my%20data.bin"}, {"byteLength", doc.bytes().size()}};
  std::string asked;
  const std::string text = doc.json.dump();
  const ImportedFile file = ReadGltf("test.gltf", AsBytes(text), [&](const std::string& name) {
    asked = name;
    return std::optional(doc.bytes());
  });
  EXPECT_EQ(asked, "my data.bin");
  EXPECT_EQ(file.meshes[0].triangles.size(), 1u);
}

TEST(Gltf, TransformsComposeDownTheHierarchy) {
  GltfDocument doc = GltfDocument::Triangle();
  const double s = std::sqrt(0.5);
  // Parent: a quarter turn about G's y and a step along x; child: twice the size.
  doc.json["nodes"] =
      json::array({{{"children", {1}}, {"translation", {10, 0, 0}}, {"rotation", {0, s, 0, s}}}, {{"mesh", 0}, {"scale", {2, 2, 2}}}});
  const ImportedFile file = ReadText(doc.Text());
  ASSERT_EQ(file.nodes.size(), 2u);
  EXPECT_EQ(file.nodes[1].parent, 0);
  // Vertex (1, 0, 0) of G: scaled (2, 0, 0), turned to (0, 0, -2), moved to (10, 0, -2); in W (10, 2, 0).
  ExpectNear(file.nodes[1].X_WM * file.meshes[0].positions[1], {10, 2, 0}, 1e-5f);
  ExpectNear(file.nodes[1].X_WM * file.meshes[0].positions[2], {10, 0, 2}, 1e-5f);
}

TEST(Gltf, MatrixAndTrsNodesAgree) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["nodes"] = json::array({{{"mesh", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, 0, 1, 0}}, {"scale", {2, 3, 4}}},
                                   {{"mesh", 0}, {"matrix", {-2, 0, 0, 0, 0, -3, 0, 0, 0, 0, 4, 0, 1, 2, 3, 1}}}});
  const ImportedFile file = ReadText(doc.Text());
  for (int i = 0; i < 3; ++i) {
    ExpectNear(file.nodes[0].X_WM.A.row(i), file.nodes[1].X_WM.A.row(i));
  }
  ExpectNear(file.nodes[0].X_WM.p, file.nodes[1].X_WM.p);
}

TEST(Gltf, ManyNodesShareOneMesh) {
  GltfDocument doc = GltfDocument::Triangle();
  for (int i = 0; i < 5; ++i) doc.json["nodes"].push_back({{"mesh", 0}});
  const ImportedFile file = ReadText(doc.Text());
  EXPECT_EQ(file.meshes.size(), 1u);
  EXPECT_EQ(file.nodes.size(), 6u);
}

TEST(Gltf, GpuInstancingGivesANodeForEachInstance) {
  GltfDocument doc = GltfDocument::Triangle();
  const size_t t = doc.AddAccessor<float>({0, 0, 0, 5, 0, 0, 0, 0, 7}, 5126, "VEC3");
  const size_t s = doc.AddAccessor<float>({1, 1, 1, 2, 2, 2, 3, 3, 3}, 5126, "VEC3");
  doc.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  doc.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", t}, {"SCALE", s}};
  const ImportedFile file = ReadText(doc.Text());
  ASSERT_EQ(file.nodes.size(), 4u);
  EXPECT_EQ(file.nodes[0].mesh, -1);
  ExpectNear(file.nodes[2].X_WM * Vec3f{1, 0, 0}, {7, 0, 0});
  ExpectNear(file.nodes[3].X_WM.p, {0, -7, 0});
}

TEST(Gltf, StripsAndFansKeepTheirTurningSense) {
  for (int mode : {5, 6}) {
    GltfDocument doc;
    // A unit square facing +Z; strip order 0 1 3 2, fan order 0 1 2 3.
    const std::vector<float> strip = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const std::vector<float> fan = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    const size_t positions = doc.AddAccessor(mode == 5 ? strip : fan, 5126, "VEC3");
    doc.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"mode", mode}}}}});
    doc.json["nodes"].push_back({{"mesh", 0}});
    const ImportedFile file = ReadText(doc.Text());
    ASSERT_EQ(file.meshes[0].triangles.size(), 2u) << mode;
    for (const Vec3f& n : file.meshes[0].normals) ExpectNear(n, {0, -1, 0});
  }
}

TEST(Gltf, PointsAndLinesAreLeftOutWithAWarning) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["meshes"][0]["primitives"][0]["mode"] = 1;
  const ImportedFile file = ReadText(doc.Text());
  EXPECT_TRUE(file.meshes.empty());
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(Contains(file.warnings[0], {"lines"}));
}

TEST(Gltf, SparseAccessorsReplaceElements) {
  GltfDocument doc = GltfDocument::Triangle();
  const size_t index = doc.AddView<uint8_t>({1});
  const size_t value = doc.AddView<float>({4, 0, 0});
  doc.json["accessors"][0]["sparse"] = {
      {"count", 1}, {"indices", {{"bufferView", index}, {"componentType", 5121}}}, {"values", {{"bufferView", value}}}};
  const ImportedFile file = ReadText(doc.Text());
  ExpectNear(file.meshes[0].positions[1], {4, 0, 0});
  ExpectNear(file.meshes[0].positions[2], {0, 0, 1});
}

TEST(Gltf, QuantizedPositionsAndNormalisedIntegersAreExact) {
  GltfDocument doc;
  doc.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const size_t positions = doc.AddAccessor<int16_t>({0, 0, 0, 32767, 0, 0, 0, -32768, 0}, 5122, "VEC3");
  const size_t uvs = doc.AddAccessor<uint8_t>({0, 0, 255, 0, 51, 255}, 5121, "VEC2");
  doc.json["accessors"][positions]["normalized"] = true;
  doc.json["accessors"][uvs]["normalized"] = true;
  doc.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}}}}});
  doc.json["nodes"].push_back({{"mesh", 0}});
  const Mesh mesh = ReadText(doc.Text()).meshes[0];
  ExpectNear(mesh.positions[1], {1, 0, 0}, 0);
  ExpectNear(mesh.positions[2], {0, 0, -1}, 0);
  EXPECT_FLOAT_EQ(mesh.uvs[2].x, 0.2f);
  EXPECT_EQ(mesh.uvs[2].y, 1);
}

TEST(Gltf, InterleavedAttributesAreReadByStride) {
  GltfDocument doc;
  // Position (3 floats) and uv (2 floats) in turn.
  const size_t view = doc.AddView<float>({0, 0, 0, 0.1f, 0.2f, 1, 0, 0, 0.3f, 0.4f, 0, 1, 0, 0.5f, 0.6f});
  doc.json["bufferViews"][view]["byteStride"] = 20;
  doc.json["accessors"] =
      json::array({{{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
                   {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}}});
  doc.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}}}}});
  doc.json["nodes"].push_back({{"mesh", 0}});
  const Mesh mesh = ReadText(doc.Text()).meshes[0];
  ExpectNear(mesh.positions[2], {0, 0, 1});
  EXPECT_EQ(mesh.uvs[1], (Vec2f{0.3f, 0.4f}));
}

// A textured triangle whose uvs are (0,0), (1,0), (0,1).
GltfDocument Textured(const json& texture_info, const json& material = json::object()) {
  GltfDocument doc = GltfDocument::Triangle();
  Image<Rgb8> picture(2, 2, {255, 0, 0});
  const size_t uvs = doc.AddAccessor<float>({0, 0, 1, 0, 0, 1}, 5126, "VEC2");
  const Bytes png = EncodePng(picture);
  const size_t view = doc.AddView<std::byte>(png);
  doc.json["images"] = json::array({{{"bufferView", view}, {"mimeType", "image/png"}}});
  doc.json["textures"] = json::array({{{"source", 0}, {"sampler", 0}}});
  doc.json["samplers"] = json::array({{{"wrapS", 33071}, {"wrapT", 33648}}});
  doc.json["materials"] = json::array({material});
  doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = texture_info;
  doc.json["meshes"][0]["primitives"][0]["material"] = 0;
  doc.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uvs;
  return doc;
}

TEST(GltfMaterial, PictureSamplerAndDefaultsArrive) {
  const ImportedFile file = ReadText(Textured({{"index", 0}}).Text());
  ASSERT_EQ(file.textures.size(), 1u);
  EXPECT_TRUE(file.textures[0].srgb);
  EXPECT_EQ(file.textures[0].wrap_u, Wrap::kClamp);
  EXPECT_EQ(file.textures[0].wrap_v, Wrap::kMirror);
  EXPECT_EQ(file.textures[0].levels.front()(1, 1), (Rgba8{255, 0, 0, 255}));
  const Material& m = file.materials[0];
  EXPECT_EQ(m.base_color_texture, 0);
  EXPECT_EQ(m.metallic, 1);  // the defaults of glTF, not ours
  EXPECT_EQ(m.roughness, 1);
}

TEST(GltfMaterial, TextureTransformIsTranslationTimesRotationTimesScale) {
  // The example of the extension's text: the lower left quadrant, turned.
  const double quarter = std::acos(0.0);
  const json info = {{"index", 0},
                     {"extensions", {{"KHR_texture_transform", {{"offset", {0, 1}}, {"rotation", quarter}, {"scale", {0.5, 0.5}}}}}}};
  const Mesh mesh = ReadText(Textured(info).Text()).meshes[0];
  const Vec2f expected[] = {{0, 1}, {0, 0.5f}, {0.5f, 1}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(mesh.uvs[i].x, expected[i].x, 1e-6);
    EXPECT_NEAR(mesh.uvs[i].y, expected[i].y, 1e-6);
  }
}

TEST(GltfMaterial, AlphaModesBecomeOpaqueMaskOrGlass) {
  const auto read = [](const json& material) {
    GltfDocument doc = GltfDocument::Triangle();
    doc.json["materials"] = json::array({material});
    doc.json["meshes"][0]["primitives"][0]["material"] = 0;
    return ReadText(doc.Text()).materials[0];
  };
  EXPECT_EQ(read(json::object()).alpha_mode, AlphaMode::kOpaque);
  const Material mask = read({{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}});
  EXPECT_EQ(mask.alpha_mode, AlphaMode::kMask);
  EXPECT_EQ(mask.alpha_cutoff, 0.25f);
  const Material pane = read({{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.3}}}}});
  EXPECT_EQ(pane.kind, SurfaceKind::kGlass);
  const Material clear = read({{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}});
  EXPECT_EQ(clear.kind, SurfaceKind::kGlass);
  const Material lamp =
      read({{"emissiveFactor", {1, 0.5, 0}}, {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}});
  EXPECT_EQ(lamp.emission, (Vec3f{4, 2, 0}));
  const Material lacquer =
      read({{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.125}}}}}});
  EXPECT_EQ(lacquer.clear_coat, 0.75f);
  EXPECT_EQ(lacquer.clear_coat_roughness, 0.125f);
}

TEST(GltfMaterial, BlackDiffuseWithBrightSpecularIsMetal) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["materials"] =
      json::array({{{"extensions",
                     {{"KHR_materials_pbrSpecularGlossiness",
                       {{"diffuseFactor", {0, 0, 0, 1}}, {"specularFactor", {0.9, 0.6, 0.3}}, {"glossinessFactor", 0.75}}}}}}});
  doc.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Material m = ReadText(doc.Text()).materials[0];
  EXPECT_GT(m.metallic, 0.95f);
  EXPECT_NEAR(m.roughness, 0.25f, 1e-6);
  EXPECT_NEAR(m.base_color.y, 0.6f, 0.05f);
}

TEST(GltfMaterial, MissingPictureIsAWarning) {
  GltfDocument doc = Textured({{"index", 0}});
  doc.json["images"][0] = {{"uri", "absent.png"}};
  const ImportedFile file = ReadText(doc.Text());
  EXPECT_EQ(file.materials[0].base_color_texture, kNoTexture);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(Contains(file.warnings[0], {"absent.png"}));
}

TEST(Gltf, SkinsAreBoundAtRest) {
  GltfDocument doc = GltfDocument::Triangle();
  const size_t joints = doc.AddAccessor<uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 5121, "VEC4");
  const size_t weights = doc.AddAccessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, 5126, "VEC4");
  doc.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = joints;
  doc.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = weights;
  doc.json["skins"] = json::array({{{"joints", {1, 2}}}});
  // The node's own place does not count; joint 2 stands 10 higher.
  doc.json["nodes"] =
      json::array({{{"mesh", 0}, {"skin", 0}, {"translation", {99, 99, 99}}}, json::object(), {{"translation", {0, 10, 0}}}});
  const ImportedFile file = ReadText(doc.Text());
  const Mesh& mesh = file.meshes[0];
  ExpectNear(file.nodes[0].X_WM * mesh.positions[0], {0, 0, 0});
  ExpectNear(file.nodes[0].X_WM * mesh.positions[1], {1, 0, 10});
  ExpectNear(file.nodes[0].X_WM * mesh.positions[2], {0, 0, 6});
}

TEST(Gltf, MorphTargetsApplyAtTheirRestWeights) {
  GltfDocument doc = GltfDocument::Triangle();
  const size_t delta = doc.AddAccessor<float>({0, 0, 0, 0, 0, 0, 0, 4, 0}, 5126, "VEC3");
  doc.json["meshes"][0]["primitives"][0]["targets"] = json::array({{{"POSITION", delta}}});
  doc.json["meshes"][0]["weights"] = {0.5};
  ExpectNear(ReadText(doc.Text()).meshes[0].positions[2], {0, 0, 3});
}

TEST(Gltf, WeightsOfANodeCountBeforeThoseOfItsMesh) {
  GltfDocument doc = GltfDocument::Triangle();
  const size_t delta = doc.AddAccessor<float>({0, 0, 0, 0, 0, 0, 0, 4, 0}, 5126, "VEC3");
  doc.json["meshes"][0]["primitives"][0]["targets"] = json::array({{{"POSITION", delta}}});
  doc.json["meshes"][0]["weights"] = {0.5};
  doc.json["nodes"].push_back({{"mesh", 0}, {"name", "own"}, {"weights", {1.0}}});
  doc.json["nodes"].push_back({{"mesh", 0}, {"name", "again"}});
  const ImportedFile file = ReadText(doc.Text());
  ASSERT_EQ(file.nodes.size(), 3u);
  const auto top = [&](size_t node) { return file.meshes[static_cast<size_t>(file.nodes[node].mesh)].positions[2]; };
  ExpectNear(top(0), {0, 0, 3});
  ExpectNear(top(1), {0, 0, 5});
  EXPECT_EQ(file.nodes[2].mesh, file.nodes[0].mesh);
}

TEST(Gltf, EscapedBase64IsRead) {
  GltfDocument doc = GltfDocument::Triangle();
  std::string text = EncodeBase64(doc.bytes()), escaped;
  for (const char c : text) escaped += c == 'A' ? "%41" : c == '=' ? "%3d" : std::string(1, c);
  ASSERT_NE(escaped, text);
  doc.json["buffers"][0] = {{"byteLength", doc.bytes().size()}, {"uri", "data:application/gltf-buffer;base64," + escaped}};
  EXPECT_EQ(ReadText(doc.Text()).meshes[0].positions, ReadText(GltfDocument::Triangle().Text()).meshes[0].positions);
}

TEST(Gltf, UnusedVerticesAreDropped) {
  GltfDocument doc;
  const size_t positions = doc.AddAccessor<float>({9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3");
  const size_t indices = doc.AddAccessor<uint32_t>({1, 2, 3}, 5125, "SCALAR");
  doc.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}}});
  doc.json["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(ReadText(doc.Text()).meshes[0].positions.size(), 3u);
}

TEST(Gltf, OnlyTheDefaultSceneIsRead) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["nodes"].push_back({{"mesh", 0}, {"name", "other"}});
  doc.json["scenes"] = json::array({{{"nodes", {0}}}, {{"nodes", {1}}}});
  doc.json["scene"] = 1;
  const ImportedFile file = ReadText(doc.Text());
  ASSERT_EQ(file.nodes.size(), 1u);
  EXPECT_EQ(file.nodes[0].name, "other");
}

}  // namespace
}  // namespace airsim360::internal
