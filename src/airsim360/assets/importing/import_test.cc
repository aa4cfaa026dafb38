#include "airsim360/assets/importing/import.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "airsim360/assets/gltf/gltf_test_internal.h"
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
      area += 0.5 * Norm(Cross(instance.X_WM * mesh.positions[t.y] - a, instance.X_WM * mesh.positions[t.z] - a));
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
  for (const char* uri :
       {"../secret.bin", "/etc/passwd", "a/../../secret.bin", "%2e%2e/secret.bin", "file:///etc/passwd", "C:/x.bin", "link.bin"}) {
    GltfDocument doc = GltfDocument::Triangle();
    doc.json["buffers"][0] = {{"uri", uri}, {"byteLength", 42}};
    EXPECT_TRUE(Contains(ErrorOf(Write("inside/m.gltf", doc.json.dump())), {"m.gltf: refers to"})) << uri;
  }
  EXPECT_TRUE(Contains(ErrorOf(Write("inside/m.obj", "mtllib ../secret.bin\n")), {"leaves the model's folder"}));
  EXPECT_TRUE(Contains(ErrorOf(Write("inside/m.obj", "mtllib a/../b.mtl\n")), {"write it without '..'"}));
}

TEST_F(ImportTest, RulesBesideTheModelAreFound) {
  Write("a.labels.yaml", "rules: [{match: node, category: vehicle/boat}]\n");
  const auto scene = ImportScene(Write("a.glb", GltfDocument::Triangle().Glb()));
  EXPECT_EQ(scene->tree[scene->entities[0].category].path, "vehicle/boat");
}

TEST_F(ImportTest, UnknownMissingAndEmptyFilesSaySo) {
  EXPECT_TRUE(Contains(ErrorOf(folder_ / "a.fbx"), {"a.fbx: no such file"}));
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
    if (std::find(endings.begin(), endings.end(), entry.path().extension()) != endings.end()) files.push_back(entry.path());
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
    for (const char* part : {"SchemaFailures", "wrongTypes", "IndexOutOfRange", "RecursiveNodes", "MissingBin", "BoxWithInfinites"}) {
      malformed = malformed || name.find(part) != std::string::npos;
    }
    try {
      ImportScene(file);
      EXPECT_FALSE(malformed) << name;
      ++loaded;
    } catch (const InputError& error) {
      // Files of points, lines or nothing have nothing to show.
      EXPECT_TRUE(malformed || Contains(error.what(), {"no triangles"}) || Contains(error.what(), {"0 scenes"})) << error.what();
    }
  }
  EXPECT_GE(loaded, 20);
}

TEST_F(ImportTest, ScaleUpGroundAndOffsetPlaceAModel) {
  const fs::path file = Write("a.obj", "v 1 2 3\nv 2 2 3\nv 1 4 3\nv 1 2 4\nf 1 2 3\nf 1 2 4\n");
  // The box of the file's coordinates (1, 2, 3) … (2, 4, 4), each axis as W's up.
  struct Case {
    const char* up;
    Vec3f low, high;
  };
  for (const Case& c : {Case{"y", {1, -4, 2}, {2, -3, 4}}, Case{"z", {1, 2, 3}, {2, 4, 4}}, Case{"x", {2, 3, 1}, {4, 4, 2}},
                        Case{"-x", {2, -4, -2}, {4, -3, -1}}, Case{"-y", {1, 3, -4}, {2, 4, -2}}, Case{"-z", {1, -4, -4}, {2, -2, -3}}}) {
    const auto scene = ImportScene(file, {.placement = {.up = c.up}});
    EXPECT_EQ(scene->bounds.min, c.low) << c.up;
    EXPECT_EQ(scene->bounds.max, c.high) << c.up;
    // Turned, not mirrored.
    for (const Instance& instance : scene->instances) EXPECT_GT(instance.X_WM.A.determinant(), 0) << c.up;
  }
  const auto placed = ImportScene(file, {.placement = {.scale = 0.5, .up = "z", .ground = true, .offset = {10, 20, 1}}});
  const auto model = std::find_if(placed->entities.begin(), placed->entities.end(), [](const Entity& e) { return e.name != "plain"; });
  EXPECT_EQ(model->bounds.min, (Vec3f{10.5f, 21, 1}));
  EXPECT_EQ(model->bounds.max, (Vec3f{11, 22, 1.5f}));
  const auto plain = std::find_if(placed->entities.begin(), placed->entities.end(), [](const Entity& e) { return e.name == "plain"; });
  ASSERT_NE(plain, placed->entities.end());
  EXPECT_EQ(placed->tree[plain->category].path, "ground/terrain/landscape");
  EXPECT_EQ(plain->bounds.max.z, 0);
}

TEST_F(ImportTest, PlacementsOutOfRangeNameTheValueAndTheRange) {
  const auto error = [&](ModelPlacement placement) -> std::string {
    try {
      ValidatePlacement(placement, "w.yaml: ");
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(error({.scale = 1e-6, .up = "-z", .offset = {-1e6, 0, 1e6}}), "no error");
  for (double scale : {0.0, -1.0, 9e-7, 2e6, std::nan("")}) EXPECT_TRUE(Contains(error({.scale = scale}), {"w.yaml: scale", "1e-06"}));
  EXPECT_TRUE(Contains(error({.up = "w"}), {"up: ", "'w'", "-x"}));
  EXPECT_TRUE(Contains(error({.offset = {0, 0, 1.1e6}}), {"offset: 1.1e+06"}));
}

TEST_F(ImportTest, UnlikelyUnitsAreToldAloud) {
  const auto told = [&](const std::string& name, double size, ModelPlacement placement = {}) {
    const std::string s = std::to_string(size);
    const fs::path file = Write("a.obj", "o " + name + "\nv 0 0 0\nv " + s + " 0 0\nv 0 1 0\nf 1 2 3\n");
    testing::internal::CaptureStderr();
    ImportScene(file, {.placement = placement});
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_TRUE(Contains(told("car", 450), {"'car' (vehicle/car)", "centimetres: use scale: 0.01"}));
  EXPECT_TRUE(Contains(told("car", 4500), {"millimetres: use scale: 0.001"}));
  EXPECT_TRUE(Contains(told("car", 177), {"inches: use scale: 0.0254"}));
  EXPECT_TRUE(Contains(told("thing", 3438), {"3438 m wide", "centimetres: use scale: 0.01"}));
  EXPECT_EQ(told("car", 4.5), "");
  EXPECT_EQ(told("thing", 900), "");
  EXPECT_EQ(told("car", 450, {.scale = 1}), "");  // the user has said it
}

TEST_F(ImportTest, WhatLiesSoFarAwayThatPlacesAreCoarseIsToldAloud) {
  const auto told = [&](const std::string& x) {
    const fs::path file = Write("a.obj", "v " + x + " 0 0\nv " + x + " 1 0\nv " + x + " 0 1\nf 1 2 3\n");
    testing::internal::CaptureStderr();
    ImportScene(file, {});
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_TRUE(Contains(told("4000000"), {"a.obj: lies around (4000000, ", "kept to 0.48 m"}));
  EXPECT_EQ(told("20000"), "");
}

}  // namespace
}  // namespace airsim360
