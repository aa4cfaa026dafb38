#include "airsim360/assets/import.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "airsim360/assets/gltf_test_internal.h"
#include "airsim360/assets/test_text.h"
#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using internal::Contains;
using internal::GltfDocument;

class ImportTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("airsim360_import_" + std::string(info->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "inside");
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path Write(const std::string& name, const std::string& text) {
    WriteFileAtomically(folder_ / name, text);
    return folder_ / name;
  }
  static std::string ErrorOf(const fs::path& file) {
    try {
      ImportScene(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  fs::path folder_;
};

// Area of all triangles of a scene and its bounds tell two imports of one shape apart from two shapes.
double TotalArea(const Scene& scene) {
  double area = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (Vec3u t : mesh.triangles) {
      const Vec3f a = instance.X_WM * mesh.positions[t.x];
      area +=
          0.5 * Norm(Cross(instance.X_WM * mesh.positions[t.y] - a, instance.X_WM * mesh.positions[t.z] - a));
    }
  }
  return area;
}

TEST_F(ImportTest, GltfAndObjOfOneShapeGiveTheSameScene) {
  const auto obj = ImportScene(Write("a.obj", "o car\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["nodes"][0]["name"] = "car";
  const auto gltf = ImportScene(Write("a.glb", doc.Glb()));
  for (const auto& scene : {obj, gltf}) {
    ASSERT_EQ(scene->entities.size(), 2u);
    EXPECT_EQ(scene->entities[0].name, "car");
    EXPECT_EQ(scene->tree[scene->entities[0].category].path, "vehicle/car");
    EXPECT_EQ(scene->sky_entity, 2u);
    EXPECT_EQ(scene->bounds.max, (Vec3f{1, 0, 1}));
    EXPECT_NEAR(TotalArea(*scene), 0.5, 1e-6);
    ASSERT_TRUE(scene->spawn);
    EXPECT_LT(scene->spawn->y, -0.5f);  // before its front
  }
  EXPECT_EQ(obj->meshes[0].normals, gltf->meshes[0].normals);
}

TEST_F(ImportTest, FilesOutsideTheFolderAreRefused) {
  WriteFileAtomically(folder_ / "secret.bin", std::string(100, 'x'));
  fs::create_symlink(folder_ / "secret.bin", folder_ / "inside/link.bin");
  for (const char* uri : {"../secret.bin", "/etc/passwd", "a/../../secret.bin", "%2e%2e/secret.bin",
                          "file:///etc/passwd", "C:/x.bin", "link.bin"}) {
    GltfDocument doc = GltfDocument::Triangle();
    doc.json["buffers"][0] = {{"uri", uri}, {"byteLength", 42}};
    EXPECT_TRUE(Contains(ErrorOf(Write("inside/m.gltf", doc.json.dump())), {"m.gltf: refers to"})) << uri;
  }
  EXPECT_TRUE(
      Contains(ErrorOf(Write("inside/m.obj", "mtllib ../secret.bin\n")), {"leaves the model's folder"}));
}

TEST_F(ImportTest, RulesBesideTheModelAreFound) {
  Write("a.labels.yaml", "rules: [{match: node, category: vehicle/boat}]\n");
  const auto scene = ImportScene(Write("a.glb", GltfDocument::Triangle().Glb()));
  EXPECT_EQ(scene->tree[scene->entities[0].category].path, "vehicle/boat");
}

TEST_F(ImportTest, UnknownMissingAndEmptyFilesSaySo) {
  EXPECT_TRUE(Contains(ErrorOf(folder_ / "a.fbx"), {"a.fbx", ".gltf"}));
  EXPECT_TRUE(Contains(ErrorOf(folder_ / "none.glb"), {"no such file"}));
  EXPECT_TRUE(Contains(ErrorOf(Write("e.obj", "")), {"no triangles"}));
  EXPECT_THROW(ImportModel(folder_ / "e.obj"), InputError);
}

TEST_F(ImportTest, ModelsStandOnTheGroundAndAreCentred) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["nodes"][0]["translation"] = {7, 5, 3};
  const Model model = ImportModel(Write("a.glb", doc.Glb()));
  EXPECT_EQ(model.mesh.Bounds().min.z, 0);
  EXPECT_NEAR(model.mesh.Bounds().center().x, 0, 1e-6);
  EXPECT_NEAR(model.mesh.Bounds().center().y, 0, 1e-6);
}

TEST_F(ImportTest, PlacementsBeyondAllBoundsAreErrors) {
  GltfDocument doc = GltfDocument::Triangle();
  doc.json["nodes"][0]["translation"] = {1e12, 0, 0};
  EXPECT_TRUE(Contains(ErrorOf(Write("a.glb", doc.Glb())), {"node 'node'", "beyond"}));
  EXPECT_THROW(ImportModel(folder_ / "a.glb"), InputError);
}

// Every model file below a folder.
std::vector<fs::path> ModelsBelow(const fs::path& folder, std::initializer_list<std::string> endings) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (std::find(endings.begin(), endings.end(), entry.path().extension()) != endings.end())
      files.push_back(entry.path());
  }
  return files;
}

TEST(RealFiles, SharedModelsLoad) {
  const fs::path shared = "/work/shared";
  if (!fs::exists(shared / "gltf")) GTEST_SKIP() << "no development models here";
  for (const char* folder : {"gltf", "obj"}) {
    for (const fs::path& file : ModelsBelow(shared / folder, {".gltf", ".glb", ".obj"})) {
      EXPECT_GT(ImportScene(file)->Count().unique_triangles, 1000u) << file;
    }
  }
}

TEST(RealFiles, AssimpsGltfModelsLoadOrSayWhyNot) {
  const fs::path folder = "/usr/share/assimp/models/glTF2";
  if (!fs::exists(folder)) GTEST_SKIP() << "assimp-testmodels is not installed";
  int loaded = 0;
  for (const fs::path& file : ModelsBelow(folder, {".gltf", ".glb"})) {
    const std::string name = file.string();
    bool malformed = false;
    for (const char* part : {"SchemaFailures", "wrongTypes", "IndexOutOfRange", "RecursiveNodes",
                             "MissingBin", "BoxWithInfinites"}) {
      malformed = malformed || name.find(part) != std::string::npos;
    }
    try {
      ImportScene(file);
      EXPECT_FALSE(malformed) << name;
      ++loaded;
    } catch (const InputError& error) {
      // Files of points, lines or nothing have nothing to show.
      EXPECT_TRUE(malformed || Contains(error.what(), {"no triangles"}) ||
                  Contains(error.what(), {"0 scenes"}))
          << error.what();
    }
  }
  EXPECT_GE(loaded, 20);
}

}  // namespace
}  // namespace airsim360
