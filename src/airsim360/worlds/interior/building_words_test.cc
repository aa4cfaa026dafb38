#include "airsim360/worlds/interior/building_words.h"

#include <gtest/gtest.h>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// What was answered: the refusal, "a town", or the settings.
std::string AnswerTo(const char* words) {
  try {
    const auto request = BuildingFromWords(words);
    if (!request) return "a town";
    std::string all;
    for (const auto& [said, as] : request->words)
      if (as != "filler") all += as + "; ";
    return all;
  } catch (const InputError& error) {
    return error.what();
  }
}
void ExpectPart(const char* words, const char* part) {
  EXPECT_NE(AnswerTo(words).find(part), std::string::npos) << words << " → " << AnswerTo(words);
}

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

TEST(BuildingWords, SignsOfNumbersAreKept) {
  ExpectPart("office with -2 storeys", "storeys: -2 is not");
  ExpectPart("library, -20 people", "people: -20 is not");
  ExpectPart("office, −40 x 20 m", "width: -40 is not from 10 to 120");
  ExpectPart("library 1e308 m by 3 m", "width: 1e+308 is not from 10 to 120");
  ExpectPart("library, 0 storeys", "storeys: 0 is not");
  ExpectPart("office of 3–5 storeys", "'3-5 storeys'");
  ExpectPart("a two-storey office", "storeys: 2");
  ExpectPart("office, several people", "'several people'");
  ExpectPart("office, 3 storeys at most", "'3 storeys at most'");
}

TEST(BuildingWords, WhatExcludesIsRefusedWithBoth) {
  ExpectPart("office, open doors, closed doors", "'open doors' and 'closed doors' exclude each other");
  ExpectPart("tidy cluttered office", "'tidy' and 'cluttered'");
  ExpectPart("empty messy office", "'empty' and 'messy'");
  ExpectPart("office, 2 storeys, 3 storeys", "'2 storeys' and '3 storeys'");
  ExpectPart("office, 600 m2, 40 x 20 m", "'600 m2' and '40 x 20 m'");
  ExpectPart("small office, 40 x 20 m", "'small' and '40 x 20 m'");
  ExpectPart("deserted library, 20 people", "'deserted' and '20 people'");
  ExpectPart("empty warehouse with racks", "'empty' and 'racks'");
  ExpectPart("library with an atrium, no atrium", "'atrium' and 'no atrium'");
  ExpectPart("office, 2 storeys, two levels", "use: office; storeys: 2; storeys: 2; ");
}

TEST(BuildingWords, MeasuresInWordsThatPeopleUse) {
  ExpectPart("office 40 m by 20 m", "width: 40, depth: 20");
  ExpectPart("office, 40x20m", "width: 40, depth: 20");
  ExpectPart("office, 40 m wide and 20 m deep", "width: 40; depth: 20");
  ExpectPart("office of about 131 by 66 ft", "width: 39.93, depth: 20.12");
  ExpectPart("warehouse, 12 metres high", "storey_height: 12");
  ExpectPart("a flat of 90 m2", "90 m2 a storey is not from 141");
  ExpectPart("library, twenty-five people", "people: 25");
  ExpectPart("mall, people: 10", "people: 10");
  ExpectPart("small office", "width: 30, depth: 19.4");
  ExpectPart("office with one hundred and twenty workers", "people: 120");
  ExpectPart("office, approx. 15,000 sq. ft, ~25 workers", "people: 25");
  ExpectPart("office, half an acre", "width: 59.76, depth: 33.86");
  ExpectPart("parking garage of 0.9 acres with 2 levels", "storeys: 2");
  for (const char* words : {"office of 1,200 m²", "office, 2 storeys, 2,400 square metres"}) {
    const auto request = BuildingFromWords(words);
    ASSERT_TRUE(request);
    EXPECT_NEAR(request->spec.width * request->spec.depth, 1200, 1);
  }
}

TEST(BuildingWords, DenialsAreUnderstoodOrRefused) {
  ExpectPart("library without an atrium", "atrium: false");
  ExpectPart("mall with no atrium", "a mall is built around its hall");
  ExpectPart("office with an atrium", "atrium: true, storeys: 2");
  ExpectPart("office, no people", "people: 0");
  ExpectPart("car park with no cars", "furnished: false");
  ExpectPart("empty car park", "furnished: false");
  ExpectPart("unfurnished flat", "furnished: false");
  ExpectPart("tidy flat", "clutter: 0");
  ExpectPart("warehouse without racks", "'without racks'");
  ExpectPart("office with no kitchen", "'no kitchen'");
  ExpectPart("office, not empty", "'not empty'");
}

TEST(BuildingWords, RefusalsNameThePhrase) {
  ExpectPart("office with people", "'20 people'");
  ExpectPart("office, at least 3 storeys", "'at least 3 storeys'");
  ExpectPart("apartment with three bedrooms", "'three bedrooms'");
  ExpectPart("library at night", "--weather");
  ExpectPart("modern library", "'modern'");
  ExpectPart("busy atrium, office, 2 storeys", "'busy atrium'");
  ExpectPart("apartment building", "'apartment building'");
  ExpectPart("warehouse with a food court", "'food court'");
  ExpectPart("one-storey mall with escalators", "'escalators' needs 2 storeys");
  ExpectPart("office, 2 flors", "did you mean 'floor");
}

TEST(BuildingWords, KindsOfBuildingsAndTheirMisspellings) {
  ExpectPart("officce, 2 floors", "did you mean 'office'");
  ExpectPart("hospital with 20 beds", "apartment, office, warehouse, mall, car park, library");
  ExpectPart("libraries", "one building; did you mean 'library'");
  ExpectPart("a flat", "use: apartment");
  ExpectPart("tidy flat, 5 people", "use: apartment");
  for (const char* words : {"10% slope, flat", "flat roofs on a hill", "castle, flat", "a campus, flat", "small town"})
    EXPECT_EQ(AnswerTo(words), "a town") << words;
}

}  // namespace
}  // namespace airsim360
