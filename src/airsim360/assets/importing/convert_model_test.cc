#include "airsim360/assets/importing/convert_model.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "airsim360/assets/gltf/gltf_test_internal.h"
#include "airsim360/assets/importing/import.h"
#include "airsim360/assets/test_text.h"
#include "airsim360/base/error.h"
#include "airsim360/base/process.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using internal::Contains;
using internal::GltfDocument;

/// A folder with models, and one with programs that $PATH names alone.
class ConvertTest : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::getenv("PATH");
    fs::create_directories(programs());
    ::setenv("PATH", programs().c_str(), 1);
    ::setenv("AIRSIM360_CACHE", "", 1);
  }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }

  fs::path programs() const { return scratch_.path() / "programs"; }
  fs::path Write(const std::string& name, const std::string& text) {
    WriteFileAtomically(scratch_.path() / name, text);
    return scratch_.path() / name;
  }
  void Install(const std::string& name, const std::string& script) {
    const fs::path program = Write("programs/" + name, "#!/bin/sh\nPATH=/usr/bin:/bin\n" + script);
    fs::permissions(program, fs::perms::owner_all);
  }
  static std::string ErrorOf(const fs::path& file) {
    try {
      ImportScene(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  ScratchFolder scratch_{"convert_test"};
  std::string path_;
};

TEST_F(ConvertTest, AFileOfAKnownFormatThatIsNotReadSaysWhatItIsAndTheWayRound) {
  for (const char* extension : {"fbx", "usd", "usda", "usdc", "usdz", "las", "laz",     "pnts", "stl", "dae", "3ds", "blend",
                                "x3d", "ifc", "3mf",  "off",  "hgt",  "tif", "geojson", "kml",  "shp", "gml", "skp", "zip"}) {
    const std::string name = std::string("thing.") + extension, error = ErrorOf(Write(name, "x"));
    EXPECT_TRUE(Contains(error, {name, "(." + std::string(extension) + ")", ".glb", ".osm.pbf"})) << error;
    EXPECT_EQ(error.find("did you mean"), std::string::npos) << error;
  }
  EXPECT_TRUE(Contains(ErrorOf(Write("a.fbx", "x")), {"apt install assimp-utils", "apt install blender"}));
  EXPECT_TRUE(Contains(ErrorOf(Write("a.blend", "x")), {"apt install blender"}));
  EXPECT_TRUE(Contains(ErrorOf(Write("a.hgt", "x")), {"--heights"}));
  EXPECT_TRUE(Contains(ErrorOf(Write("a.qqq", "x")), {"'.qqq'", "read are"}));
  EXPECT_TRUE(Contains(ErrorOf(scratch_.path() / "none.fbx"), {"none.fbx: no such file"}));
}

TEST_F(ConvertTest, AnInstalledProgramConvertsAndItsResultIsRead) {
  Write("made.glb", GltfDocument::Triangle().Glb());
  Install("assimp", "test \"$1\" = export && cp " + scratch_.path().string() + "/made.glb \"$3\"\n");
  const auto plain = ImportScene(scratch_.path() / "made.glb"), fbx = ImportScene(Write("car.dae", "x"));
  EXPECT_EQ(fbx->bounds.max, plain->bounds.max);
  EXPECT_EQ(fbx->meshes[0].positions, plain->meshes[0].positions);

  // STL has +Z up, which assimp leaves as it is: its z is ours.
  const auto stl = ImportScene(Write("part.stl", "x"));
  EXPECT_EQ(stl->bounds.max, (Vec3f{1, 1, 0}));
  EXPECT_EQ(plain->bounds.max, (Vec3f{1, 0, 1}));

  // 3MF is in millimetres, FBX in what it says, else centimetres.
  EXPECT_NEAR(ImportScene(Write("part.3mf", "x"))->bounds.max.x, 0.001, 1e-9);
  EXPECT_NEAR(ImportScene(Write("a.fbx", "x"))->bounds.max.x, 0.01, 1e-8);
  EXPECT_NEAR(ImportScene(Write("b.fbx", "P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",2.54\n"))->bounds.max.x, 0.0254, 1e-8);
}

TEST_F(ConvertTest, BlenderComesFirstAndAssimpWhereItFails) {
  Write("made.glb", GltfDocument::Triangle().Glb());
  Install("assimp", "cp " + scratch_.path().string() + "/made.glb \"$3\"\n");
  Install("blender",
          "for last; do :; done; echo \"$@\" > " + scratch_.path().string() + "/words; echo 'Error: no such operator'; exit 1\n");
  EXPECT_EQ(ImportScene(Write("a.dae", "x"))->entities.size(), 2u);
  const std::string words = ReadTextFile(scratch_.path() / "words");
  EXPECT_TRUE(Contains(words, {"--background", "--disable-autoexec", "collada_import", "use_empty=True"})) << words;
  EXPECT_TRUE(Contains(ErrorOf(Write("a.usd", "x")), {"a.usd", "cannot be converted", "blender failed", "no such operator"}));
}

TEST_F(ConvertTest, AProgramThatWritesRubbishOrNothingIsAnError) {
  Install("assimp", "echo rubbish > \"$3\"\n");
  EXPECT_TRUE(Contains(ErrorOf(Write("a.off", "x")), {"a.off"}));
  Install("assimp", "exit 0\n");
  EXPECT_TRUE(Contains(ErrorOf(Write("a.off", "x")), {"a.off", "assimp failed"}));
}

TEST_F(ConvertTest, PicturesAreFoundByTheirBareNameAndNowhereElse) {
  fs::create_directories(scratch_.path() / "textures");
  Write("textures/wood.png", "wood");
  WriteFileAtomically(scratch_.path().parent_path() / "airsim360_outside.png", std::string_view("secret"));
  const auto load = internal::SearchingLoader(scratch_.path() / "a.fbx");
  for (const char* name : {"wood.png", "D:\\art\\maps\\wood.png", "/home/x/wood.png", "../../wood.png", "textures\\wood.png"})
    EXPECT_TRUE(load(name)) << name;
  for (const char* name : {"../airsim360_outside.png", "", "..", "a/", "none.png"}) EXPECT_FALSE(load(name)) << name;
  fs::remove(scratch_.path().parent_path() / "airsim360_outside.png");
}

TEST_F(ConvertTest, TheUnitOfAnFbxFileIsReadFromItsHeader) {
  constexpr char kHead[] = "xxS\x0f\0\0\0UnitScaleFactorS\x06\0\0\0doubleS\x06\0\0\0NumberS\0\0\0\0D";
  std::string binary(kHead, sizeof kHead - 1);
  const double factor = 100;
  binary.append(reinterpret_cast<const char*>(&factor), 8);
  EXPECT_DOUBLE_EQ(internal::FbxUnit(AsBytes(binary)), 1);
  for (size_t cut = 0; cut < binary.size(); ++cut) EXPECT_DOUBLE_EQ(internal::FbxUnit(AsBytes(binary.substr(0, cut))), 0.01);
}

TEST_F(ConvertTest, RealProgramsConvertABox) {
  // A box of 2 x 4 x 6 above z = 1, as an OFF and an STL file.
  std::string off = "OFF\n8 6 0\n", stl = "solid box\n";
  for (int i = 0; i < 8; ++i) off += std::string(i & 1 ? "2 " : "0 ") + (i & 2 ? "4 " : "0 ") + (i & 4 ? "7\n" : "1\n");
  for (const char* face : {"0 2 3 1", "4 5 7 6", "0 1 5 4", "2 6 7 3", "0 4 6 2", "1 3 7 5"}) off += std::string("4 ") + face + "\n";
  for (const char* corners : {"0 0 1|2 0 1|0 4 7", "2 0 1|2 4 7|0 4 7"}) {
    stl += "facet normal 0 0 0\nouter loop\nvertex " + std::string(corners) + "\nendloop\nendfacet\n";
    for (size_t at; (at = stl.find('|')) != std::string::npos;) stl.replace(at, 1, "\nvertex ");
  }
  stl += "endsolid box\n";
  ::setenv("PATH", path_.c_str(), 1);
  const bool assimp = FindProgram("assimp").has_value(), blender = FindProgram("blender").has_value();
  if (!assimp && !blender) GTEST_SKIP() << "neither assimp-utils nor blender is installed";
  const Box3f box{{0, 0, 1}, {2, 4, 7}};
  std::vector<fs::path> files = {Write("box.stl", stl)};
  if (assimp) files.push_back(Write("box.off", off));
  for (const fs::path& file : files) {
    const Box3f bounds = ImportScene(file)->bounds;
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(bounds.min[k], box.min[k], 1e-5) << file;
      EXPECT_NEAR(bounds.max[k], box.max[k], 1e-5) << file;
    }
  }
}

}  // namespace
}  // namespace airsim360
