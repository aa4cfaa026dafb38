// Damaged and hostile glTF: every kind gives an InputError that names the place; nothing crashes or takes
// much memory.
#include <gtest/gtest.h>

#include "airsim360/assets/gltf/gltf_test_internal.h"
#include "airsim360/assets/test_text.h"
#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

using nlohmann::json;

std::string GltfError(const std::string& text, const ResourceLoader& load = kNoFiles) {
  try {
    ReadGltf("test.gltf", AsBytes(text), load);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// The message after damaging a good document at a JSON pointer.
std::string ErrorAfter(const std::string& pointer, const json& value) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json[json::json_pointer(pointer)] = value;
  return GltfError(doc.Text());
}

TEST(HostileGltf, BrokenJsonNamesLineAndColumn) {
  EXPECT_TRUE(Contains(GltfError("{\n  \"asset\": {\n    \"version\" \"2.0\"}}"), {"test.gltf:3:19: not valid JSON"}));
  EXPECT_TRUE(Contains(GltfError("{\"asset\": "), {"ends too early"}));
  EXPECT_TRUE(Contains(GltfError(""), {"test.gltf:1:1"}));
  EXPECT_TRUE(Contains(GltfError("[1]"), {"an object expected"}));
}

TEST(HostileGltf, DeepNestingOfJsonIsNoRecursion) { EXPECT_TRUE(Contains(GltfError(std::string(1000000, '[')), {"not valid JSON"})); }

TEST(HostileGltf, EveryTruncationOfAGlbIsAnError) {
  const std::string glb = GltfDocument::Triangle().Glb();
  EXPECT_EQ(GltfError(glb), "no error");
  for (size_t size = 0; size < glb.size(); ++size) EXPECT_NE(GltfError(glb.substr(0, size)), "no error") << size;
}

TEST(HostileGltf, WrongTypesNameTheirPlaceAndValue) {
  EXPECT_TRUE(Contains(ErrorAfter("/scene", "hello"), {"/scene", "\"hello\""}));
  EXPECT_TRUE(Contains(ErrorAfter("/meshes/0/primitives", 3), {"/meshes/0/primitives: an array expected (3)"}));
  EXPECT_TRUE(Contains(ErrorAfter("/nodes/0/mesh", -1), {"/nodes/0/mesh"}));
  EXPECT_TRUE(Contains(ErrorAfter("/nodes/0/translation", {1, 2}), {"3 numbers expected"}));
  EXPECT_TRUE(Contains(ErrorAfter("/nodes/0/name", 42), {"/nodes/0/name: a string expected (42)"}));
  EXPECT_TRUE(Contains(ErrorAfter("/asset/version", "1.0"), {"only glTF 2"}));
  EXPECT_TRUE(Contains(ErrorAfter("/asset/minVersion", "2.1"), {"/asset/minVersion", "only glTF 2.0"}));
}

TEST(HostileGltf, IndicesOutOfRangeNameTheCount) {
  EXPECT_TRUE(Contains(ErrorAfter("/nodes/0/mesh", 7), {"there are only 1 meshes (7)"}));
  EXPECT_TRUE(Contains(ErrorAfter("/meshes/0/primitives/0/attributes/POSITION", 9), {"there are only 2 accessors"}));
  EXPECT_TRUE(Contains(ErrorAfter("/accessors/0/bufferView", 5), {"there are only 2 bufferViews"}));
  EXPECT_TRUE(Contains(ErrorAfter("/bufferViews/0/buffer", 5), {"there are only 1 buffers"}));
  EXPECT_TRUE(Contains(ErrorAfter("/meshes/0/primitives/0/material", 5), {"there are only 0 materials"}));
  GltfDocument doc = GltfDocument::Triangle();
  doc.AddAccessor<uint16_t>({0, 1, 3}, 5123, "SCALAR");
  doc.json["meshes"][0]["primitives"][0]["indices"] = 2;
  EXPECT_TRUE(Contains(GltfError(doc.Text()), {"element 2 is vertex 3 of 3"}));
}

TEST(HostileGltf, HugeCountsAreRefusedBeforeMemoryIsTaken) {
  EXPECT_TRUE(Contains(ErrorAfter("/accessors/0/count", 4294967295u), {"/accessors/0/count"}));
  EXPECT_TRUE(Contains(ErrorAfter("/accessors/0/count", uint64_t{18446744073709551615u}), {"/accessors/0/count"}));
  EXPECT_TRUE(Contains(ErrorAfter("/accessors/0/count", 100000000), {"the buffer view has 36"}));
  EXPECT_TRUE(Contains(ErrorAfter("/accessors/0/byteOffset", uint64_t{18446744073709551610u}), {"the buffer view has 36"}));
  EXPECT_TRUE(Contains(ErrorAfter("/bufferViews/0/byteLength", uint64_t{18446744073709551615u}), {"of a buffer of"}));
  EXPECT_TRUE(Contains(ErrorAfter("/bufferViews/0/byteOffset", uint64_t{18446744073709551615u}), {"of a buffer of"}));
  EXPECT_TRUE(Contains(ErrorAfter("/buffers/0/byteLength", uint64_t{4} << 30), {"bytes are there"}));
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["accessors"][0] = {{"componentType", 5126}, {"count", 100000000}, {"type", "VEC3"}};  // zeros from nowhere
  EXPECT_TRUE(Contains(GltfError(doc.Text()), {"/accessors/0/count"}));
}

TEST(HostileGltf, BadStridesAndTypesAreRefused) {
  EXPECT_TRUE(Contains(ErrorAfter("/bufferViews/0/byteStride", 4), {"at a stride of 4"}));
  EXPECT_TRUE(Contains(ErrorAfter("/bufferViews/0/byteStride", uint64_t{1} << 62), {"byteStride"}));
  EXPECT_TRUE(Contains(ErrorAfter("/accessors/0/componentType", 5124), {"unknown component type"}));
  EXPECT_TRUE(Contains(ErrorAfter("/accessors/0/type", "VEC2"), {"VEC3 expected"}));
  EXPECT_TRUE(Contains(ErrorAfter("/accessors/1/componentType", 5126), {"/accessors/1"}));
}

TEST(HostileGltf, SparseIndicesAreChecked) {
  GltfDocument doc = GltfDocument::Triangle();
  const size_t index = doc.AddView<uint8_t>({3});
  const size_t value = doc.AddView<float>({4, 0, 0});
  doc.json["accessors"][0]["sparse"] = {
      {"count", 1}, {"indices", {{"bufferView", index}, {"componentType", 5121}}}, {"values", {{"bufferView", value}}}};
  EXPECT_TRUE(Contains(GltfError(doc.Text()), {"/accessors/0/sparse/indices: index 3 of 3"}));
  doc.json["accessors"][0]["sparse"]["count"] = 4000000000u;
  EXPECT_TRUE(Contains(GltfError(doc.Text()), {"/accessors/0/sparse/count"}));
}

TEST(HostileGltf, NodesMustBeAForest) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["nodes"] = json::array({{{"children", {1}}}, {{"children", {0}}}});
  EXPECT_TRUE(Contains(GltfError(doc.Text()), {"cycle"}));
  doc.json["nodes"] = json::array({{{"children", {0}}}});
  EXPECT_NE(GltfError(doc.Text()), "no error");
  doc.json["nodes"] = json::array({{{"children", {2}}}, {{"children", {2}}}, {{"mesh", 0}}});
  EXPECT_TRUE(Contains(GltfError(doc.Text()), {"two parents"}));
  doc.json["nodes"] = json::array({{{"mesh", 0}}});
  doc.json["scenes"] = json::array({{{"nodes", {0, 0}}}});
  EXPECT_TRUE(Contains(GltfError(doc.Text()), {"twice"}));
}

TEST(HostileGltf, DepthIsBounded) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["nodes"] = json::array();
  for (int i = 0; i < 1000; ++i) doc.json["nodes"].push_back({{"children", {i + 1}}});
  doc.json["nodes"].push_back({{"mesh", 0}});
  EXPECT_TRUE(Contains(GltfError(doc.Text()), {"nested deeper than 256"}));
}

TEST(HostileGltf, NumbersThatAreNotFiniteAreRefused) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.AddAccessor<float>({0, 0, 0, NAN, 0, 0, 0, 1, 0}, 5126, "VEC3");
  doc.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 2;
  EXPECT_TRUE(Contains(GltfError(doc.Text()), {"vertex 1", "not finite"}));
  EXPECT_TRUE(Contains(ErrorAfter("/nodes/0/rotation", {0, 0, 0, 0}), {"quaternion"}));
  std::string text = GltfDocument::Triangle().Text();
  text.replace(text.find("\"mesh\":0"), 8, "\"mesh\":0,\"scale\":[1e999,1,1]");
  EXPECT_NE(GltfError(text), "no error");
}

TEST(HostileGltf, UnknownRequiredExtensionIsNamed) {
  EXPECT_TRUE(Contains(ErrorAfter("/extensionsRequired", {"ACME_gizmo"}), {"/extensionsRequired/0", "ACME_gizmo"}));
}

TEST(HostileGltf, MissingAndDamagedBuffersAreErrors) {
  EXPECT_TRUE(Contains(ErrorAfter("/buffers/0/uri", "gone.bin"), {"/buffers/0/uri", "gone.bin"}));
  EXPECT_TRUE(Contains(ErrorAfter("/buffers/0/uri", "data:;base64,####"), {"damaged data URI"}));
  EXPECT_TRUE(Contains(ErrorAfter("/buffers/0/uri", "a%zz"), {"damaged URI"}));
}

TEST(HostileGltf, CompressedStreamsAreCheckedBeforeTheyAreDecoded) {
  GltfDocument doc = GltfDocument::Triangle();
  // A Draco head (sequential, 2.2) that claims 4 billion faces.
  const size_t view =
      doc.AddView<uint8_t>({'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 0x0f, 0xff, 0xff, 0xff, 0xff, 0x0f});
  doc.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                                                        {"attributes", {{"POSITION", 0}}}};
  EXPECT_TRUE(Contains(GltfError(doc.Text()), {"claims 4294967295"}));

  GltfDocument packed = GltfDocument::Triangle();
  packed.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0}, {"byteLength", 36}, {"byteStride", 12}, {"count", 4000000000u}, {"mode", "ATTRIBUTES"}};
  EXPECT_TRUE(Contains(GltfError(packed.Text()), {"compressed bytes can hold"}));
  packed.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = 3;
  EXPECT_TRUE(Contains(GltfError(packed.Text()), {"damaged compressed data"}));
}

TEST(HostileGltf, DamagedPicturesAreErrors) {
  GltfDocument doc = GltfDocument::Triangle();
  const size_t view = doc.AddView<uint8_t>({0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 1, 2, 3});
  doc.json["images"] = json::array({{{"bufferView", view}, {"mimeType", "image/png"}}});
  doc.json["textures"] = json::array({{{"source", 0}}});
  doc.json["materials"] = json::array({{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}});
  doc.json["meshes"][0]["primitives"][0]["material"] = 0;
  EXPECT_TRUE(Contains(GltfError(doc.Text()), {"images/0"}));
}

TEST(HostileGltf, LimitsBoundWhatAFileMayAskFor) {
  GltfDocument doc = GltfDocument::Triangle();
  for (int i = 0; i < 10; ++i) doc.json["meshes"][0]["primitives"].push_back(doc.json["meshes"][0]["primitives"][0]);
  ImportLimits limits;
  limits.max_triangles = 5;
  EXPECT_THROW(ReadText(doc.Text(), limits), InputError);
}

}  // namespace
}  // namespace airsim360::internal
