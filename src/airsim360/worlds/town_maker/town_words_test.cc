#include "airsim360/worlds/town_maker/town_words.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

TownSpec SpecOf(const char* words) { return TownFromWords(words).spec; }

// The message of the error, "" if there was none.
std::string Refusal(const std::string& words) {
  try {
    TownFromWords(words);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TownWords, TheContractsExampleIsUnderstood) {
  const TownSpec spec = SpecOf("a small coastal town with a church and a marina, 40 ha, narrow streets");
  EXPECT_EQ(spec.water, TownWater::kSea);
  EXPECT_TRUE(spec.church);
  EXPECT_TRUE(spec.harbour);
  EXPECT_NEAR(spec.width * spec.depth, 4e5, 2e3);
  EXPECT_LT(spec.street, SpecOf("a small coastal town").street);
}

TEST(TownWords, EveryWordComesBackWithWhatBecameOfIt) {
  for (const char* words : {"a small coastal town with a church and a marina, 40 ha, narrow streets",
                            "medieval hilltop village without cars or trees, 2 to 3 storeys",
                            "Large grid city of brick buildings; 120 people, many trees, two parks",
                            "300 m by 200 m of log cabins in a forest by a lake, foggy"}) {
    std::string back;
    for (const UnderstoodWords& row : TownFromWords(words).words) {
      EXPECT_FALSE(row.as.empty()) << row.words;
      back += row.words + " ";
    }
    std::string plain;
    for (const char* c = words; *c; ++c)
      plain += std::isalnum(static_cast<unsigned char>(*c)) ? std::string(1, static_cast<char>(std::tolower(*c))) : "";
    std::erase(back, ' ');
    EXPECT_EQ(back, plain);
  }
}

TEST(TownWords, AWordThatMeansNothingIsRefusedWithTheNearest) {
  EXPECT_NE(Refusal("a town with a chruch").find("did you mean 'church'"), std::string::npos);
  EXPECT_NE(Refusal("a costal town").find("did you mean 'coastal'"), std::string::npos);
  EXPECT_NE(Refusal("a town with a spaceport").find("'spaceport'"), std::string::npos);
  EXPECT_NE(Refusal("a town with 7 of them").find("a number of what"), std::string::npos);
}

TEST(TownWords, WordsThatExcludeEachOtherAreRefusedByBothNames) {
  for (const auto& [words, one, other] : {std::array<const char*, 3>{"a flat town on a hill", "flat", "hill"},
                                          {"a town with a church and without a church", "church", "without a church"},
                                          {"a village and a city", "village", "city"},
                                          {"narrow and wide streets", "narrow", "wide"},
                                          {"low houses of 12 storeys", "low", "12 storeys"},
                                          {"many trees, few trees", "many trees", "few trees"},
                                          {"wooden stone houses", "wooden", "stone"},
                                          {"20 ha, 300 m by 300 m", "20 ha", "300 m by 300 m"}}) {
    const std::string refusal = Refusal(words);
    EXPECT_NE(refusal.find("exclude each other"), std::string::npos) << words << ": " << refusal;
    EXPECT_NE(refusal.find(one), std::string::npos) << refusal;
    EXPECT_NE(refusal.find(other), std::string::npos) << refusal;
  }
  EXPECT_NE(Refusal("a town with a marina and no water"), "");
}

TEST(TownWords, NumbersAreBounded) {
  for (const char* words : {"2e18 ha", "a town of 0 houses", "a town of 99999999 houses", "a 61 storey city", "a 0 storey city",
                            "5 to 2 storeys", "a town of 3.5 houses", "119 m by 300 m", "300 m by 1201 m", "9000 ha", "a town of 12 parks",
                            "80 % slope", "a town with 1e308 people"})
    EXPECT_NE(Refusal(words), "") << words;
  EXPECT_EQ(SpecOf("a town of 5 storeys").most_floors, 5);
  EXPECT_EQ(SpecOf("a two-storey suburb").least_floors, 2);
  EXPECT_EQ(SpecOf("a hamlet of 12 houses").houses, 12u);
  EXPECT_EQ(SpecOf("a town with three parks").parks, 3u);
  EXPECT_NEAR(SpecOf("a village, 300 m by 400 m, 10 % slope").climb, 40, 1);
  EXPECT_EQ(TownFromWords("a town with 30 people").people, 30u);
  EXPECT_EQ(TownFromWords("a town of 3000 people").people, 150u);
}

TEST(TownWords, WhatIsDeniedIsNotThere) {
  EXPECT_EQ(SpecOf("a town without trees").trees, 0);
  EXPECT_EQ(SpecOf("a town with no cars").traffic, 0);
  EXPECT_EQ(SpecOf("a resort with no palms").palms, false);
  EXPECT_EQ(SpecOf("a town with no parks and no squares").parks, 0u);
}

TEST(TownWords, GroundWaterAndHarboursCanBeDenied) {
  EXPECT_EQ(SpecOf("an alpine village with no hills").relief, TownRelief::kFlat);
  EXPECT_EQ(SpecOf("a resort with no sea").water, TownWater::kNone);
  EXPECT_FALSE(SpecOf("a fishing village without boats").harbour);
  for (const char* words : {"a hilltop town with no hills", "a coastal town, no sea", "a marina without boats", "riverside town, no river"})
    EXPECT_NE(Refusal(words).find("exclude each other"), std::string::npos) << words << ": " << Refusal(words);
  EXPECT_NE(Refusal("a harbour but no sea"), "");
}

TEST(TownWords, MoreOfAWordMeansMoreOfTheThing) {
  EXPECT_GT(SpecOf("a town with many trees").trees, SpecOf("a town with few trees").trees);
  EXPECT_GT(SpecOf("a town with heavy traffic").traffic, SpecOf("a town with light traffic").traffic);
  EXPECT_GT(SpecOf("a large town").width, SpecOf("a small town").width);
  EXPECT_GT(SpecOf("a steep town").climb, SpecOf("a gentle town").climb);
}

TEST(TownWords, TheOrderOfWordsDoesNotMatter) {
  const TownSpec a = SpecOf("a small medieval town on a hill with a market"), b = SpecOf("market, hill, town, small, medieval");
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.relief, b.relief);
  EXPECT_EQ(a.style, b.style);
  EXPECT_EQ(a.street, b.street);
}

// As Refusal, of the town of seed 0 too.
std::string NotBuilt(const std::string& words) {
  try {
    TownRequest request = TownFromWords(words);
    SettleTown(request, 0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TownWords, AMinusSignBelongsToItsNumber) {
  for (const char* words : {"town with -3 storeys", "town, -5 ha", "town -5ha", "a -10 % slope", "-20 people", "village of -4 houses",
                            "300 m by -200 m", "\u22125 ha", "\u20135 ha", "-.5 ha", "2 to -4 storeys", "-2 parks"})
    EXPECT_NE(Refusal(words).find("is not from"), std::string::npos) << words << ": " << Refusal(words);
  EXPECT_EQ(SpecOf("a 3-5 storey town").least_floors, 3);
  EXPECT_EQ(SpecOf("a two-storey town").most_floors, 2);
}

TEST(TownWords, NothingSaidIsUndoneByWhatElseIsSaid) {
  for (const char* words : {"car-free town with heavy traffic",
                            "pedestrian town with cars",
                            "leafy town with no trees",
                            "deserted village with people",
                            "deserted town with 30 people",
                            "rooftop terrace, 2 storeys",
                            "low houses with a roof terrace",
                            "town with palms, no trees",
                            "busy town without cars",
                            "quiet town with heavy traffic",
                            "crowded town with no people",
                            "boulevards, narrow streets",
                            "a flat town with a 10 % slope",
                            "steep flat town",
                            "dense detached houses",
                            "terraced houses with lawns",
                            "beach with a harbour",
                            "bridge, no water",
                            "playground, no parks",
                            "narrow streets, 20 m wide streets",
                            "green town, few trees"})
    EXPECT_NE(Refusal(words).find("exclude each other"), std::string::npos) << words << ": " << Refusal(words);
  for (const char* words : {"busy town with heavy traffic", "leafy town with many trees", "detached houses with front lawns",
                            "front gardens and lawns", "cafes, no bars", "no chapel but a church", "a steep hill town", "water, a lake",
                            "quiet town without cars", "crowded town with many people", "car-free town with no cars"})
    EXPECT_EQ(Refusal(words), "") << words;
  EXPECT_GT(SpecOf("a town on a steep hill").climb, SpecOf("a town on a hill").climb);
  EXPECT_FALSE(SpecOf("a resort with no trees").palms);
}

TEST(TownWords, LimitsOfNumbersAreKept) {
  EXPECT_EQ(SpecOf("a city of 20 storeys").least_floors, 20);
  EXPECT_EQ(SpecOf("one-storey village").most_floors, 1);
  EXPECT_EQ(SpecOf("one house").houses, 1u);
  EXPECT_EQ(SpecOf("a town of over 4 storeys").least_floors, 5);
  EXPECT_EQ(SpecOf("a town of at least 4 storeys").least_floors, 4);
  EXPECT_EQ(SpecOf("a town under 3 storeys").most_floors, 2);
  EXPECT_EQ(SpecOf("a town of up to 4 storeys").most_floors, 4);
  EXPECT_EQ(SpecOf("between two and four storeys").least_floors, 2);
  EXPECT_EQ(SpecOf("a town with fewer than 20 houses").houses, 19u);
  EXPECT_NE(Refusal("a town of over 4 ha"), "");
  EXPECT_NE(Refusal("a town over 60 storeys"), "");
  EXPECT_NE(Refusal("one tree"), "");
  EXPECT_EQ(Refusal("one church over a river"), "");
}

TEST(TownWords, AnAdjectiveIsSaidOfWhatItSuits) {
  for (const char* words : {"tall trees", "a high hill", "a wide river", "green roofs", "old people", "yellow cars", "tiny cars",
                            "large park", "small church", "wooden boats", "narrow canal", "cobbled roofs", "modern cars",
                            "tall and old trees", "steep roofs", "quiet sea", "round square", "brick streets", "white boats"})
    EXPECT_NE(Refusal(words).find("is said of"), std::string::npos) << words << ": " << Refusal(words);
  for (const char* words :
       {"small market town", "tall houses", "narrow cobbled streets", "old harbour town", "wide green boulevards", "town, tall, river",
        "white brick houses", "medieval castle", "quiet leafy university campus", "glass skyscrapers", "steep hillside"})
    EXPECT_EQ(Refusal(words), "") << words;
  EXPECT_GT(TownFromWords("town with pedestrians").people, 0u);
  EXPECT_EQ(SpecOf("town with pedestrian streets").traffic, 0);
}

TEST(TownWords, NumbersAreReadAsTheyAreWritten) {
  EXPECT_EQ(SpecOf("two hundred and fifty houses").houses, 250u);
  EXPECT_EQ(SpecOf("twenty five houses").houses, 25u);
  EXPECT_EQ(SpecOf("a dozen houses").houses, 12u);
  EXPECT_NEAR(SpecOf("1,5 ha").width * SpecOf("1,5 ha").depth, 15000, 200);
  EXPECT_NEAR(SpecOf("20,000 m2").width * SpecOf("20,000 m2").depth, 20000, 200);
  EXPECT_NEAR(SpecOf("streets 40 ft wide").street, 12.19, 0.01);
  EXPECT_EQ(SpecOf("3\u20135 storeys").most_floors, 5);
  EXPECT_EQ(TownFromWords("one hundred houses").words[0].words, "one hundred houses");
  EXPECT_EQ(Refusal("1e308 ha").find("inf"), std::string::npos);
  EXPECT_NE(Refusal("twenty two-storey houses"), "");
  EXPECT_NE(Refusal("of the with"), "");
}

// The environment of a world file: "night, visibility_m 180 …".
std::string SkyOf(const char* words) {
  const TownRequest request = TownFromWords(words);
  std::string sky = request.weather;
  for (const auto& [key, value] : request.environment)
    if (value > 0) sky += ", " + key + " " + std::to_string(std::lround(100 * value));
  return sky;
}

TEST(TownWords, WeatherAndTimeOfDayGoTogether) {
  EXPECT_EQ(SkyOf("foggy village"), "fog");
  EXPECT_EQ(SkyOf("village at night"), "night");
  EXPECT_EQ(SkyOf("foggy village at night"), "night, cloud_cover 60, visibility_m 18000, wetness 20");
  EXPECT_EQ(SkyOf("rainy town at dusk"), "dusk, cloud_cover 100, visibility_m 400000, wetness 100, rain_mm_h 600");
  EXPECT_EQ(SkyOf("misty hamlet in winter"), "winter, cloud_cover 25, cirrus_cover 40, visibility_m 150000, wetness 10, snow_depth 90");
  EXPECT_EQ(SkyOf("town under a clear sky at night"), "night");
  EXPECT_EQ(SkyOf("town at dawn"), "dusk, sun_azimuth_deg 7500");
  for (const char* words : {"sunny town at night", "sunny foggy town", "foggy misty town", "town at night, at noon",
                            "summer town with snow", "a foggy town without fog", "snowy town, no snow"})
    EXPECT_NE(Refusal(words).find("exclude each other"), std::string::npos) << words << ": " << Refusal(words);
  for (const char* words : {"town in autumn", "a spring town", "a town in the fall"})
    EXPECT_NE(Refusal(words).find("'summer' and 'winter'"), std::string::npos) << words << ": " << Refusal(words);
  EXPECT_EQ(SkyOf("a town in summer"), "");
}

TEST(TownWords, LampsBusStopsAndHeightsCanBeSaidAndDenied) {
  EXPECT_TRUE(SpecOf("town with street lamps").lamps);
  EXPECT_FALSE(SpecOf("town without street lights").lamps);
  EXPECT_TRUE(SpecOf("town with a bus stop at the corner").bus_stops);
  EXPECT_EQ(SpecOf("city with no tall buildings").most_floors, 4);
  EXPECT_EQ(SpecOf("no buildings over 3 storeys").most_floors, 3);
  EXPECT_EQ(SpecOf("city, no houses taller than three floors").most_floors, 3);
  EXPECT_EQ(NotBuilt("town with a bus stop, 4 ha"), "");
  for (const char* words : {"city of 6 storeys, no tall buildings", "high rise city, no tall buildings", "skyscrapers, no tall buildings"})
    EXPECT_NE(Refusal(words).find("exclude each other"), std::string::npos) << words << ": " << Refusal(words);
  EXPECT_NE(Refusal("town with one-way streets").find("both directions"), std::string::npos);
  EXPECT_NE(NotBuilt("cabins with street lamps").find("pavements"), std::string::npos);
}

TEST(TownWords, AmountsAreOrdered) {
  const auto trees = [](const char* words) { return SpecOf(words).trees; };
  EXPECT_EQ(trees("town with no trees"), 0);
  EXPECT_GT(trees("town with hardly any trees"), 0);
  EXPECT_LT(trees("town with hardly any trees"), trees("town with few trees"));
  EXPECT_LT(trees("town with few trees"), trees("town"));
  EXPECT_LT(trees("town"), trees("town with many trees"));
  EXPECT_GT(trees("cabins, dense forest around"), trees("cabins, forest around"));
  EXPECT_GT(SpecOf("tree-lined streets").street, 14.4);
  EXPECT_NE(Refusal("narrow tree-lined streets").find("exclude"), std::string::npos);
  EXPECT_NE(Refusal("a town of many houses").find("a number is"), std::string::npos);
  EXPECT_EQ(SpecOf("several squares, a couple of parks").squares, 3u);
  EXPECT_EQ(SpecOf("a couple of dozen houses").houses, 24u);
  EXPECT_EQ(SpecOf("20 to 30 wooden houses").houses, 30u);
  EXPECT_EQ(SpecOf("mostly brick houses").style, TownStyle::kBrick);
  EXPECT_NE(Refusal("mostly trees"), "");
}

TEST(TownWords, WatersLieWhereTheyAreSaidToLie) {
  EXPECT_EQ(SpecOf("an island village with a beach by the sea").water, TownWater::kIsland);
  EXPECT_TRUE(SpecOf("a fishing village on an island").harbour);
  EXPECT_TRUE(SpecOf("a town with a river through the middle").central_water);
  EXPECT_NE(Refusal("a river on an island").find("exclude"), std::string::npos);
  EXPECT_NE(Refusal("island, no sea").find("exclude"), std::string::npos);
  EXPECT_NE(Refusal("a market through the middle").find("of what?"), std::string::npos);
}

TEST(TownWords, AreasInUnitsOfSeveralCountries) {
  for (const auto& [words, hectares] : {std::pair<const char*, double>{"1/4 square mile", 64.75},
                                        {"approx. 10 acres", 4.05},
                                        {"half a square kilometre", 50},
                                        {"between 3 and 5 ha", 4},
                                        {"~ 40.000 m2", 4},
                                        {"0.5 km by 300 m", 15}})
    EXPECT_NEAR(SpecOf(words).width * SpecOf(words).depth / 1e4, hectares, 0.01 * hectares) << words;
}

TEST(TownWords, WhatHasNoRoomIsMadeRoomForOrRefused) {
  for (const char* words :
       {"medieval hilltop town with castle, 6 ha", "town with castle, 4 ha", "village with a castle", "town with arches, 4 ha",
        "town of 200 houses", "town with a playground, 4 ha", "river town with a bridge, 6 ha", "town with two parks, 6 ha"})
    EXPECT_EQ(NotBuilt(words), "") << words;
  for (const auto& [words, says] : {std::array<const char*, 2>{"400 houses, 2 ha", "room for"},
                                    {"cabins with cafes", "'cafes'"},
                                    {"cabins with cycle lanes", "'cycle lanes'"},
                                    {"bridge by the sea", "'bridge'"},
                                    {"arches, wide streets", "'arches'"}})
    EXPECT_NE(NotBuilt(words).find(says), std::string::npos) << words << ": " << NotBuilt(words);
  TownRequest request = TownFromWords("medieval hilltop town with castle, 6 ha");
  SettleTown(request, 0);
  bool said = false;
  for (const UnderstoodWords& row : request.words) said = said || row.as.starts_with("castle: true, block: ");
  EXPECT_TRUE(said);
}

TEST(TownWords, AnyTextIsUnderstoodOrRefusedAndNeverBreaksTheBounds) {
  RngStream rng(7, "words");
  const char* pieces[] = {"no", "town", "9",     "ha",  "x",      "%",  "\xc3",   "é",   "m",    "by",    "-1", "storeys", "people",
                          "to", ".",    "1e400", "nan", "church", "or", "hardly", "any", "park", "steep", "2",  "without"};
  for (int i = 0; i < 500; ++i) {
    std::string words;
    for (uint32_t k = rng.Index(9); k > 0; --k) words += std::string(pieces[rng.Index(std::size(pieces))]) + (rng.Chance(0.8) ? " " : "");
    try {
      const TownRequest request = TownFromWords(words);
      EXPECT_NO_THROW(request.spec.Check(""));
      EXPECT_LE(request.spec.width, TownSpec::kMostSide) << words;
      EXPECT_GE(request.spec.depth, TownSpec::kLeastSide - 1) << words;
    } catch (const InputError&) {
    }
  }
  EXPECT_NE(Refusal(std::string(1001, 'a')), "");
  EXPECT_NE(Refusal(""), "");
}

}  // namespace
}  // namespace airsim360
