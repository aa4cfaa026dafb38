// What a recipe makes of which worlds.
#include "airsim360/vln/episodes/recipe.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/scene/environment.h"

namespace airsim360 {
namespace {

std::vector<std::string> Known() {
  return {"apartment", "box_room", "building", "downtown_west", "new_york_city", "new_york_city_1950s",
          "office",    "rome",     "roof",     "sunlit_room",   "town",          "warehouse"};
}

TEST(VlnRecipe, UnseenWorldsAreInNoOtherSplitAndTestRoomsInNone) {
  std::map<std::string, std::set<std::string>> splits;
  for (const VlnMakeOptions& part : VlnRecipe("omni360-vln", Known())) splits[part.world].insert(part.split);
  EXPECT_EQ(splits.at("rome"), std::set<std::string>{"val_unseen"});
  EXPECT_EQ(splits.at("warehouse"), std::set<std::string>{"val_unseen"});
  EXPECT_EQ(splits.at("new_york_city"), std::set<std::string>{""});
  for (const char* room : {"box_room", "sunlit_room", "town", "building"}) EXPECT_FALSE(splits.contains(room)) << room;
  // Everything else takes part.
  EXPECT_EQ(splits.size() + 4, Known().size());
}

TEST(VlnRecipe, ThePapersInstructionsAreForItsTwoCitiesAndAnotherInThreeTownsEach) {
  std::map<std::string, int> seeds;
  for (const VlnMakeOptions& part : VlnRecipe("omni360-vln", Known())) {
    EXPECT_EQ(part.starts, 3);
    EXPECT_EQ(part.weather, "mix");
    if (part.templates == "paper37")
      seeds[part.world] += static_cast<int>(part.seeds);
    else
      EXPECT_EQ(part.templates, "any");
  }
  EXPECT_EQ(seeds, (std::map<std::string, int>{{"downtown_west", 3}, {"new_york_city", 3}, {"new_york_city_1950s", 3}}));
}

TEST(VlnRecipe, EveryWeatherThatIsMixedCanBeDrawn) {
  for (const char* weather : kMixedWeathers) EXPECT_NO_THROW(ParseEnvironmentPreset(weather)) << weather;
}

TEST(VlnRecipe, IsTheSameWhateverElseIsKnownAndNamesTheNearestRecipe) {
  EXPECT_EQ(VlnRecipe("omni360-vln", std::vector<std::string>{"box_room"}).size(), 0U);
  EXPECT_EQ(VlnRecipe("omni360-vln", std::vector<std::string>{"roof"}).size(), 1U);
  try {
    VlnRecipe("omni360", Known());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("omni360-vln"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace airsim360
