#include "airsim360/assets/sweethome3d/sweethome3d.h"

#include <gtest/gtest.h>

#include "airsim360/assets/importing/import.h"
#include "airsim360/assets/sweethome3d/properties.h"
#include "airsim360/assets/test_text.h"
#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"

namespace airsim360 {
namespace {

TEST(Properties, EscapesSeparatorsAndContinuationsFollowJava) {
  const auto p =
      internal::ParseProperties("p", "# c\n! c\na=1\nb : two words \nc\\=d=\\u00e9\\u20ac\\ud83d\\ude00\ne=x\\\n   y\nf caf\xe9\n");
  EXPECT_EQ(p.at("a"), "1");
  EXPECT_EQ(p.at("b"), "two words");
  EXPECT_EQ(p.at("c=d"), "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80");
  EXPECT_EQ(p.at("f"), "caf\xc3\xa9");
  EXPECT_TRUE(p.contains("e"));
}

TEST(Properties, DamagedEscapeNamesItsLine) {
  try {
    internal::ParseProperties("p", "a=1\nb=\\u12");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(internal::Contains(error.what(), {"p:2:"}));
  }
}

TEST(Catalogue, PiecesAreReadInMetres) {
  const auto models = internal::ParseCatalogue("c",
                                               "license=Creative Commons Attribution 3.0 license\nmodel#1=/a/b/chair.obj\nwidth#1=50\n"
                                               "depth#1=40\nheight#1=90.5\nname#1=Chair\ncreator#1=Me\nmodelRotation#1=0 0 1 0 1 0 -1 0 0\n"
                                               "model#2=/x.obj\nwidth#2=-3\ndepth#2=1\nheight#2=1\n");
  ASSERT_EQ(models.size(), 1u);
  EXPECT_EQ(models[0].stem, "chair");
  EXPECT_EQ(models[0].path, "a/b/chair.obj");
  EXPECT_EQ(models[0].licence, "CC-BY-3.0");
  EXPECT_FLOAT_EQ(models[0].size.z, 0.905f);
  EXPECT_EQ(models[0].rotation_G.m[0][2], 1);
  EXPECT_THROW(internal::ParseCatalogue("c", "model#1=/a.obj\nwidth#1=wide"), InputError);
}

class SweetHome : public testing::Test {
 protected:
  void SetUp() override {
    models_ = OpenSweetHomeModels();
    if (!models_) GTEST_SKIP() << "sweethome3d-furniture is not installed";
  }
  std::unique_ptr<ModelSource> models_;
};

TEST_F(SweetHome, ModelsHaveTheirCatalogueSizeAndStandOnTheGround) {
  // Name, width, depth, height in metres; among them models without normals and one with a rotation.
  const std::tuple<const char*, Vec3f> expected[] = {{"fordFocus", {2.045f, 4.358f, 1.551f}},
                                                     {"cityBus", {3.031f, 12.192f, 3.02f}},
                                                     {"cone", {0.379f, 0.379f, 0.7f}},
                                                     {"poplar", {4.044f, 3.754f, 7.3f}}};
  for (const auto& [name, size] : expected) {
    const auto model = models_->Load(name);
    ASSERT_TRUE(model) << name;
    const Box3f box = model->mesh.Bounds();
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(box.size()[i], size[i], 1e-3) << name;
    EXPECT_NEAR(box.min.z, 0, 1e-4) << name;
    EXPECT_NEAR(box.center().x, 0, 1e-4) << name;
    EXPECT_FALSE(model->attribution.empty());
    EXPECT_EQ(model->mesh.normals.size(), model->mesh.positions.size());
  }
}

TEST_F(SweetHome, SurfacesGetTheirKinds) {
  const auto kinds = [&](const char* name) {
    std::set<SurfaceKind> out;
    const std::optional<Model> model = models_->Load(name);
    for (const Material& material : model->materials) out.insert(material.kind);
    return out;
  };
  EXPECT_TRUE(kinds("cityBus").contains(SurfaceKind::kGlass));
  EXPECT_TRUE(kinds("sycamoreMaple").contains(SurfaceKind::kFoliage));
  EXPECT_TRUE(kinds("sycamoreMaple").contains(SurfaceKind::kStandard));  // the trunk
}

TEST_F(SweetHome, ModelsWithoutNormalsLoad) {
  for (const char* name : {"cafe-chair", "park-light", "hanging-restaurant-light", "male-01-suit"})
    EXPECT_TRUE(models_->Load(name)) << name;
}

TEST_F(SweetHome, UnknownNamesGiveNothing) { EXPECT_FALSE(models_->Load("no such model")); }

TEST_F(SweetHome, ThreadsLoadTheSameModel) {
  std::vector<std::optional<Model>> loaded(4);
  ParallelFor(4, [&](int64_t i) { loaded[static_cast<size_t>(i)] = models_->Load("cone"); });
  for (const auto& model : loaded) EXPECT_EQ(model->mesh.positions, loaded[0]->mesh.positions);
}

TEST(SweetHomeAbsent, AnEmptyFolderGivesNoSource) { EXPECT_EQ(OpenSweetHomeModels("/nonexistent"), nullptr); }

}  // namespace
}  // namespace airsim360
