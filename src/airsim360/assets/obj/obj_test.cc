#include "airsim360/assets/obj/obj.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "airsim360/assets/test_text.h"
#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"

namespace airsim360::internal {
namespace {

using Files = std::map<std::string, std::string>;

ImportedFile ReadText(const std::string& text, const Files& files = {}) {
  return ReadObj("test.obj", text, [&](const std::string& name) -> std::optional<Bytes> {
    const auto it = files.find(name);
    if (it == files.end()) return std::nullopt;
    const auto bytes = AsBytes(it->second);
    return Bytes(bytes.begin(), bytes.end());
  });
}

std::string ObjError(const std::string& text, const Files& files = {}) {
  try {
    ReadText(text, files);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, AxesTextureOriginAndNormalsAreConverted) {
  const ImportedFile file = ReadText(kSquare + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\n");
  const Mesh& mesh = file.meshes.at(0);
  ASSERT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.positions[2], (Vec3f{1, 0, 1}));
  EXPECT_EQ(mesh.normals[2], (Vec3f{0, -1, 0}));
  EXPECT_EQ(mesh.uvs[0], (Vec2f{0, 1}));  // v = 0 is the bottom of an OBJ picture, the top of ours
}

TEST(Obj, PolygonsNegativeIndicesAndContinuedLinesGiveTheSameSquare) {
  for (const char* face : {"f 1 2 3 4\n", "f -4 -3 -2 -1\n", "f 1 2 \\\n 3 4\n", "f 1// 2// 3// 4//\r\n"}) {
    const ImportedFile file = ReadText(kSquare + face);
    ASSERT_EQ(file.meshes.size(), 1u) << face;
    EXPECT_EQ(file.meshes[0].triangles.size(), 2u) << face;
    for (Vec3f n : file.meshes[0].normals) EXPECT_EQ(n, (Vec3f{0, -1, 0})) << face;
  }
}

TEST(Obj, LinesMayEndAsOnTheOldMacintosh) {
  std::string text = kSquare + "f 1 2 3 4\n";
  std::ranges::replace(text, '\n', '\r');
  EXPECT_EQ(ReadText(text).meshes.at(0).positions.size(), 4u);
}

TEST(Obj, ObjectsAndGroupsBecomeNodesAndNamedOnesContinue) {
  const ImportedFile file = ReadText(kSquare + "o house\nf 1 2 3\ng roof\nf 1 2 4\no house\nf 2 3 4\ng\nf 1 3 4\n");
  ASSERT_EQ(file.nodes.size(), 2u);
  EXPECT_EQ(file.nodes[0].name, "house");
  EXPECT_EQ(file.meshes[0].triangles.size(), 3u);
  EXPECT_EQ(file.nodes[1].name, "roof");
  EXPECT_EQ(ReadText(kSquare + "g\nf 1 2 3\ng\nf 1 2 4\n").nodes.size(), 2u);
}

TEST(Obj, MaterialsSplitPartsAndKeepTheirNamesWithoutALibrary) {
  const ImportedFile file = ReadText("mtllib gone.mtl\n" + kSquare + "usemtl red paint\nf 1 2 3\nusemtl glass\nf 1 3 4\n");
  EXPECT_EQ(file.meshes.at(0).parts.size(), 2u);
  EXPECT_EQ(file.materials.at(0).name, "red paint");
  ASSERT_EQ(file.warnings.size(), 3u);
  EXPECT_TRUE(Contains(file.warnings[0], {"test.obj:1", "gone.mtl"}));
}

TEST(Mtl, SurfacesAreToldFromOpacityNameAndHighlight) {
  const Files files = {{"m.mtl",
                        "Ns 3\nnewmtl pane\nKd 0.5 0.5 0.5\nd 0.3\nnewmtl chrome\nKd .6 .6 .6\nKs .9 .9 .9\nNs 200\n"
                        "newmtl leaves\nKd 0.1 0.5 0.1\nnewmtl chalk\nKd 0.9 0.9 0.9\nKs 0 0 0\nNs 900\n"}};
  const ImportedFile file = ReadText(
      "mtllib m.mtl\n" + kSquare + "usemtl pane\nf 1 2 3\nusemtl chrome\nf 1 3 4\nusemtl leaves\nf 1 2 4\nusemtl chalk\nf 2 3 4\n", files);
  ASSERT_EQ(file.materials.size(), 4u);
  EXPECT_EQ(file.materials[0].kind, SurfaceKind::kGlass);
  EXPECT_EQ(file.materials[1].metallic, 1);
  EXPECT_LT(file.materials[1].roughness, 0.35f);
  EXPECT_EQ(file.materials[2].kind, SurfaceKind::kFoliage);
  EXPECT_GT(file.materials[2].transmission, 0);
  EXPECT_GT(file.materials[3].roughness, 0.9f);  // no highlight at all: matte whatever Ns says
}

TEST(Mtl, PicturesReplaceTheColourAndHolesMakeAMask) {
  const Bytes png = EncodePng(Image<Rgb8>(1, 1, {10, 20, 30}));
  const Bytes hole = EncodePng(Image<uint8_t>(1, 1, 0));
  const Files files = {{"m.mtl",
                        "newmtl a\nKd 0 0 0\nmap_Kd -s 1 1 1 my picture.png\nnewmtl b\nmap_Kd my "
                        "picture.png\nmap_d hole.png\n"},
                       {"my picture.png", std::string(AsText(png))},
                       {"hole.png", std::string(AsText(hole))}};
  const ImportedFile file = ReadText("mtllib m.mtl\n" + kSquare + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n", files);
  EXPECT_EQ(file.materials.at(0).base_color, (Vec3f{1, 1, 1}));
  EXPECT_EQ(file.materials.at(0).alpha_mode, AlphaMode::kOpaque);
  EXPECT_EQ(file.materials.at(1).alpha_mode, AlphaMode::kMask);
  EXPECT_EQ(file.textures.size(), 2u);
}

TEST(Mtl, MissingPicturesLeaveAColourThatTheirNameTells) {
  const Files files = {{"m.mtl", "newmtl a\nKd 0.6 0.6 0.6\nmap_Kd WoodPlanks01.jpg\n"}};
  const Vec3f wood = ReadText("mtllib m.mtl\n" + kSquare + "usemtl a\nf 1 2 3\n", files).materials.at(0).base_color;
  EXPECT_GT(wood.x, wood.z * 1.5f);
}

TEST(HostileObj, DamageNamesItsLine) {
  EXPECT_TRUE(Contains(ObjError("v 0 0\n"), {"test.obj:1: three numbers"}));
  EXPECT_TRUE(Contains(ObjError("\nv 0 zero 0\n"), {"test.obj:2: 'zero' is not a number"}));
  EXPECT_TRUE(Contains(ObjError("v 0 nan 0\n"), {"'nan' is not a finite number"}));
  EXPECT_TRUE(Contains(ObjError("v 0 1e999 0\n"), {"1e999"}));
  EXPECT_TRUE(Contains(ObjError("v 0 1e30 0\n"), {"too large"}));
  EXPECT_TRUE(Contains(ObjError(kSquare + "f 1 2 9\n"), {"test.obj:5: vertex index 9 of 4"}));
  EXPECT_TRUE(Contains(ObjError(kSquare + "f 1 2 -5\n"), {"vertex index -5 of 4"}));
  EXPECT_TRUE(Contains(ObjError(kSquare + "f 0 1 2\n"), {"vertex index 0 of 4"}));
  EXPECT_TRUE(Contains(ObjError(kSquare + "f 1 2 99999999999999999999\n"), {"is not a vertex index"}));
  EXPECT_TRUE(Contains(ObjError(kSquare + "f 1/7 2/7 3/7\n"), {"test.obj:5: texture index 7 of 0"}));
  EXPECT_TRUE(Contains(ObjError(kSquare + "f 1//5000000000 2//1 3//1\n"), {"normal index 5000000000 of 0"}));
  EXPECT_TRUE(Contains(ObjError("\x89PNG\r\n"), {"is not an OBJ statement"}));
  EXPECT_TRUE(Contains(ObjError(std::string("v 0 0 0\n\0\0\0", 11)), {"zero byte"}));
  EXPECT_TRUE(Contains(ObjError("mtllib m.mtl\n", {{"m.mtl", "newmtl a\nKd red\n"}}), {"m.mtl:2: 'red' is not a number"}));
}

TEST(Obj, TextureIndicesMayRunAhead) { EXPECT_EQ(ObjError(kSquare + "f 1/1 2/1 3/1\nvt 0 0\n"), "no error"); }

TEST(Obj, FacesOfTwoCornersAreAWarning) {
  const ImportedFile file = ReadText(kSquare + "f 1 2\nf 1 2 3\n");
  EXPECT_EQ(file.meshes.at(0).triangles.size(), 1u);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(Contains(file.warnings[0], {"test.obj:5"}));
}

TEST(HostileObj, TriangleLimitHolds) {
  ImportLimits limits;
  limits.max_triangles = 1;
  EXPECT_THROW(ReadObj(
                   "t", kSquare + "f 1 2 3 4\n", [](const std::string&) { return std::optional<Bytes>(); }, limits),
               InputError);
}

TEST(Obj, NormalsThatAreNotThereAreComputedWithAWarning) {
  const ImportedFile file = ReadText(kSquare + "f 1//5 2//5 3//5\n"), plain = ReadText(kSquare + "f 1 2 3\n");
  EXPECT_EQ(file.meshes.at(0).normals, plain.meshes.at(0).normals);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_TRUE(Contains(file.warnings[0], {"test.obj:5", "normal index 5 of 0", "computed"}));
  // Those that are there stay.
  const ImportedFile some = ReadText(kSquare + "vn 0 0.6 0.8\nf 1//1 2//9 3//9\n");
  EXPECT_EQ(std::count(some.meshes.at(0).normals.begin(), some.meshes.at(0).normals.end(), Vec3f{0, -0.8f, 0.6f}), 1);
}

}  // namespace
}  // namespace airsim360::internal
