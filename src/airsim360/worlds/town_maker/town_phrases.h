// Small words of towns: amounts, denials, filler, and what is refused by name.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "airsim360/worlds/town_maker/town_lexicon.h"

namespace airsim360::town_tables {

using internal::TownDraft;

// One word a line would hide them.
// clang-format off
inline constexpr auto kFillers = std::to_array<std::string_view>(
    {"a", "an", "the", "with", "and", "of", "in", "on", "at", "by", "to", "for", "near", "beside", "along", "through",
     "between", "over", "above", "under", "below", "behind", "into", "from", "its", "it", "is", "are", "be", "that", "which", "where",
     "has", "have", "having", "like", "s", "as", "very", "quite", "rather", "also", "all", "any", "some", "other",
     "each", "every", "house", "home", "cottage", "building", "block", "apartment", "street", "alley", "lane", "road", "path", "roof", "wall",
     "pavement", "sidewalk", "district", "quarter", "neighbourhood", "neighborhood", "area", "place", "settlement", "centre", "center",
     "community", "facade", "front", "plan", "style", "type", "kind", "view", "land", "ground", "side", "surrounded", "lined", "built",
     "full", "set", "located", "situated", "about", "roughly", "central", "main", "make", "create", "generate", "build", "please",
     "me", "want", "i", "world", "scene", "storey", "terrain", "architecture", "but", "need", "site",
     "exactly", "approximately", "around", "there", "outside", "outdoors", "out", "walking", "d", "would", "we", "our", "run", "running", "flow",
     "flowing", "lie", "lying", "stand", "standing", "include", "including", "containing", "featuring", "plus"});
inline constexpr auto kNone = std::to_array<std::string_view>({"no", "without", "free of", "not any", "devoid of"});
/// Every house has what a town has: said of it, they say the same as "all".
inline constexpr auto kMostly = std::to_array<std::string_view>({"mostly", "mainly", "predominantly", "largely", "most"});

struct Amount {
  std::string_view words;
  double share;
};
inline constexpr auto kAmounts = std::to_array<Amount>(
    {{"hardly any", 0.1}, {"almost no", 0.1}, {"nearly no", 0.1}, {"very few", 0.25}, {"few", 0.4}, {"a few", 0.4}, {"little", 0.4},
     {"light", 0.4}, {"sparse", 0.4}, {"moderate", 1}, {"some", 1}, {"many", 1.5}, {"many many", 1.6}, {"very many", 1.6},
     {"lots of", 1.5}, {"a lot of", 1.5}, {"plenty of", 1.5}, {"heavy", 1.5}, {"dense", 1.5}, {"big", 1.3}, {"large", 1.3}});

/// What else can be denied.
struct Absent {
  std::string_view noun, subject, means;
  void (*apply)(TownDraft&);
};
inline void LowHouses(TownDraft& d) {
  d.spec.most_floors = std::min(d.spec.most_floors, 4.0);
  d.spec.least_floors = std::min(d.spec.least_floors, d.spec.most_floors);
  d.spec.towers = false;
}
inline constexpr auto kAbsent = std::to_array<Absent>(
    {{"hill", "relief", "relief: flat", [](TownDraft& d) { d.spec.relief = TownRelief::kFlat; }},
     {"slope", "relief", "relief: flat", [](TownDraft& d) { d.spec.relief = TownRelief::kFlat; }},
     {"sea", "sea", "water: no sea", [](TownDraft& d) { if (d.spec.at_sea()) d.spec.water = TownWater::kNone; }},
     {"river", "no river", "water: no river", [](TownDraft& d) { if (d.spec.water == TownWater::kRiver) d.spec.water = TownWater::kNone; }},
     {"lake", "no lake", "water: no lake", [](TownDraft& d) { if (d.spec.water == TownWater::kLake) d.spec.water = TownWater::kNone; }},
     {"harbour", "harbour", "harbour: false", [](TownDraft& d) { d.spec.harbour = false; }},
     {"boat", "harbour", "harbour: false", [](TownDraft& d) { d.spec.harbour = false; }},
     {"tall building", "no tall", "floors: 4 at most, towers: false", LowHouses},
     {"tall house", "no tall", "floors: 4 at most, towers: false", LowHouses},
     {"high building", "no tall", "floors: 4 at most, towers: false", LowHouses},
     {"high rise", "no tall", "floors: 4 at most, towers: false", LowHouses},
     {"high rise building", "no tall", "floors: 4 at most, towers: false", LowHouses},
     {"fog", "no fog", "no fog", [](TownDraft& d) { d.airs.erase("fog"); d.airs.erase("mist"); }},
     {"rain", "no rain", "no rain", [](TownDraft& d) { d.airs.erase("rain"); d.airs.erase("storm"); }},
     {"snow", "no snow", "no snow", [](TownDraft& d) { d.airs.erase("winter"); d.airs.erase("snow"); }}});

/// Words of which no world is made, with what can be had.
struct Refused {
  std::string_view words, instead;
};
constexpr std::string_view kBothWays = "every street is driven in both directions; what can be had are 'narrow streets', 'pedestrian streets', 'no cars'",
                           kSeasons = "trees are in full leaf; the seasons that can be had are 'summer' and 'winter'";
inline constexpr auto kRefused = std::to_array<Refused>(
    {{"one way", kBothWays}, {"two way", kBothWays}, {"spring", kSeasons}, {"springtime", kSeasons}, {"autumn", kSeasons},
     {"autumnal", kSeasons}, {"fall", kSeasons},
     {"bus", "buses drive where there is traffic, on their own; what can be had are 'bus stop' and 'traffic'"},
     {"hotel", "no town has one yet"}, {"school", "no town has one yet"}, {"metro", "no town has one; 'tram' can be had"},
     {"subway", "no town has one; 'tram' can be had"}, {"railway", "no town has one; 'tram' can be had"},
     {"train", "no town has one; 'tram' can be had"}, {"motorway", "no town has one; the widest are 'boulevards'"},
     {"highway", "no town has one; the widest are 'boulevards'"}});
// clang-format on

}  // namespace airsim360::town_tables
