#include "airsim360/worlds/interior/building_words.h"

#include <gtest/gtest.h>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

TEST(BuildingWords, ALibraryOfTwoStoreysWithAnAtrium) {
  const auto request = BuildingFromWords("a two-storey library with an atrium");
  ASSERT_TRUE(request);
  EXPECT_EQ(request->spec.use, BuildingUse::kLibrary);
  EXPECT_EQ(request->spec.storeys, 2u);
  EXPECT_TRUE(request->spec.atrium);
  std::string all;
  for (const auto& [words, as] : request->words) all += words + " ";
  EXPECT_EQ(all, "a two storey library with an atrium ");
}

TEST(BuildingWords, MeasuresPeopleAndDoors) {
  const auto request = BuildingFromWords("A cluttered warehouse, 50 x 40 m, 12 workers, open doors");
  ASSERT_TRUE(request);
  EXPECT_EQ(request->spec.use, BuildingUse::kWarehouse);
  EXPECT_EQ(request->spec.width, 50);
  EXPECT_EQ(request->spec.depth, 40);
  EXPECT_EQ(request->spec.clutter, 1.5);
  EXPECT_EQ(request->spec.open_doors, 1);
  EXPECT_EQ(request->people, 12u);
}

TEST(BuildingWords, DescriptionsOfTownsAreNotOfBuildings) {
  EXPECT_FALSE(BuildingFromWords("a small coastal town with a church and a marina"));
  EXPECT_FALSE(BuildingFromWords("a city of office towers"));
  EXPECT_FALSE(BuildingFromWords(""));
}

TEST(BuildingWords, WhatMeansNothingIsRefusedWithTheNearest) {
  const auto message = [](const char* words) {
    try {
      BuildingFromWords(words);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_NE(message("a library with an atriun").find("atrium"), std::string::npos);
  EXPECT_NE(message("a library and a warehouse").find("one use"), std::string::npos);
  EXPECT_NE(message("a warehouse with 3 storeys").find("storeys"), std::string::npos);
  EXPECT_NE(message("an office, 5 x 5 m").find("width"), std::string::npos);
}

}  // namespace
}  // namespace airsim360
