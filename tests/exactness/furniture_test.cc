// The props of the worlds and the models of sweethome3d-furniture fit together.
#include <gtest/gtest.h>

#include <filesystem>

#include "airsim360/assets/importing/import.h"
#include "airsim360/worlds/props/props.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

class Furniture : public testing::Test {
 protected:
  void SetUp() override {
    models_ = OpenSweetHomeModels();
    if (models_ == nullptr) GTEST_SKIP() << "package sweethome3d-furniture is not installed";
  }
  std::unique_ptr<ModelSource> models_;
};

TEST_F(Furniture, EveryModelThatAPropAsksForExistsAndHasThePropsHeight) {
  int asked = 0;
  for (const PropKind& kind : PropKinds()) {
    for (uint32_t variant = 0; variant < kind.library.size(); ++variant) {
      const std::string name(kind.library[variant].name);
      if (name.empty()) continue;
      ++asked;
      ASSERT_TRUE(models_->Load(name).has_value()) << kind.name << " asks for " << name;
      const Model model = MakeProp(kind, variant, 1, models_.get());
      EXPECT_FALSE(model.attribution.empty()) << name;
      const Box3f box = model.mesh.Bounds();
      EXPECT_GE(box.min.z, -0.35f) << kind.name << " " << name;
      EXPECT_GE(box.max.z, kind.min_height) << kind.name << " " << name;
      EXPECT_LE(box.max.z, kind.max_height) << kind.name << " " << name;
    }
  }
  EXPECT_GT(asked, 5);
}

TEST_F(Furniture, WithAndWithoutTheLibraryAWorldHasTheSameEntities) {
  const auto with = BuildWorld("downtown_west", {.seed = 0, .models = models_.get()});
  const auto without = BuildWorld("downtown_west", {.seed = 0, .models = nullptr});
  ASSERT_EQ(with->entities.size(), without->entities.size());
  for (size_t i = 0; i < with->entities.size(); ++i) {
    ASSERT_EQ(with->entities[i].name, without->entities[i].name);
    ASSERT_EQ(with->entities[i].category, without->entities[i].category);
  }
  EXPECT_FALSE(with->attributions.empty());
  EXPECT_TRUE(without->attributions.empty());
}

}  // namespace
}  // namespace airsim360
