#include "airsim360/worlds/town_maker/town_adjectives.h"

#include <algorithm>
#include <array>
#include <utility>

namespace airsim360::internal {
namespace {

enum Kind : unsigned {
  kHouses = 1,
  kStreets = 2,
  kPlaces = 4,
  kGround = 8,
  kTrees = 16,
  kWaters = 32,
  kCountry = 64,
  kSquares = 128,
  kSights = 256,  // churches, castles, bridges, harbours
  kWalls = 512,
  kRoofs = 1024,
  kGardens = 2048,
  kCars = 4096,
  kPeople = 8192,
  kMarkets = 16384,
  kAnything = ~0u,
  kAdjective = 1u << 30
};

struct Suit {
  std::string_view subject;
  unsigned nouns;
  std::string_view of;
};
// A word whose subject is missing here is a noun, or suits everything.
constexpr auto kSuits = std::to_array<Suit>({
    {"size", kPlaces, "a town"},
    {"plan", kPlaces | kStreets, "streets"},
    {"street", kPlaces | kStreets, "streets"},
    {"paving", kPlaces | kStreets | kSquares, "streets"},
    {"relief", kPlaces | kStreets | kGround | kCountry, "the ground"},
    {"steep", kPlaces | kStreets | kGround, "the ground"},
    {"style", kPlaces | kHouses | kWalls, "houses"},
    {"colours", kPlaces | kHouses | kWalls, "houses"},
    {"heights", kPlaces | kHouses, "houses"},
    {"built", kPlaces | kHouses | kStreets, "a town"},
    {"setback", kPlaces | kHouses, "houses"},
    {"apart", kPlaces | kHouses, "houses"},
    {"age", kAnything & ~(kTrees | kCars | kPeople | kWaters | kGround | kCountry), "a town"},
    {"place", kAnything & ~(kTrees | kCars | kPeople), "a town"},
    {"life", kPlaces | kStreets | kSquares | kMarkets, "a town"},
    {"crowd", kPlaces | kStreets | kSquares | kMarkets, "a town"},
    {"green", kPlaces | kStreets | kTrees | kGround | kCountry | kGardens | kSquares, "a town"},
    {"tree lined", kPlaces | kStreets | kSquares, "streets"},
    {"palm lined", kPlaces | kStreets | kSquares | kWaters, "streets"},
    {"trade", kAnything, ""},
});

constexpr auto kNouns = std::to_array<std::pair<std::string_view, unsigned>>({
    {"house", kHouses},         {"home", kHouses},         {"building", kHouses},     {"block", kHouses},
    {"apartment", kHouses},     {"architecture", kHouses}, {"row house", kHouses},    {"tiled house", kHouses},
    {"cottage", kHouses},       {"wall", kWalls},          {"facade", kWalls},        {"front", kWalls},
    {"roof", kRoofs},           {"street", kStreets},      {"alley", kStreets},       {"lane", kStreets},
    {"road", kStreets},         {"path", kStreets},        {"pavement", kStreets},    {"sidewalk", kStreets},
    {"boulevard", kStreets},    {"avenue", kStreets},      {"district", kPlaces},     {"quarter", kPlaces},
    {"neighbourhood", kPlaces}, {"neighborhood", kPlaces}, {"area", kPlaces},         {"place", kPlaces},
    {"settlement", kPlaces},    {"centre", kPlaces},       {"center", kPlaces},       {"community", kPlaces},
    {"world", kPlaces},         {"scene", kPlaces},        {"site", kPlaces},         {"plan", kPlaces | kStreets},
    {"land", kGround},          {"ground", kGround},       {"terrain", kGround},      {"hill", kGround},
    {"slope", kGround},         {"hillside", kGround},     {"hilltop", kGround},      {"valley", kGround},
    {"mountain", kGround},      {"coast", kWaters},        {"sea", kWaters},          {"ocean", kWaters},
    {"bay", kWaters},           {"island", kWaters},       {"promenade", kWaters},    {"beach", kWaters},
    {"river", kWaters},         {"canal", kWaters},        {"lake", kWaters},         {"pond", kWaters},
    {"forest", kCountry},       {"pine forest", kCountry}, {"wood", kCountry},        {"woodland", kCountry},
    {"field", kCountry},        {"farmland", kCountry},    {"countryside", kCountry}, {"meadow", kCountry},
    {"desert", kCountry},       {"marina", kSights},       {"harbour", kSights},      {"harbor", kSights},
    {"port", kSights},          {"pier", kSights},         {"jetty", kSights},        {"boat", kSights},
    {"bridge", kSights},        {"lawn", kGardens},        {"garden", kGardens},      {"front garden", kGardens},
    {"view", kAnything},        {"side", kAnything},       {"type", kAnything},       {"kind", kAnything},
    {"style", kAnything},
});

unsigned OfThing(std::string_view setting) {
  if (setting == "towers") return kHouses;
  if (setting == "palms") return kTrees;
  if (setting == "wires") return kCars;
  if (setting == "cycle_lanes") return kStreets;
  if (setting == "market" || setting == "cafes") return kMarkets;
  return kSights;
}

unsigned OfStuff(std::string_view setting) {
  return setting == "trees"     ? kTrees
         : setting == "traffic" ? kCars
         : setting == "people"  ? kPeople
         : setting == "water"   ? kWaters
                                : kSquares;
}

bool Reads(const std::vector<WordToken>& tokens, size_t at, size_t n, std::string_view phrase) {
  std::string plain, text;
  for (size_t k = at; k < at + n; ++k) {
    if (k > at && tokens[k].breaks) return false;
    plain += (k > at ? " " : "") + tokens[k].plain;
    text += (k > at ? " " : "") + tokens[k].text;
  }
  return plain == phrase || text == phrase;
}

// What the longest known phrase at `at` is, and its words.
std::pair<unsigned, size_t> KindAt(const std::vector<WordToken>& tokens, size_t at) {
  for (size_t n = std::min<size_t>(4, tokens.size() - at); n > 0; --n) {
    for (const auto& [noun, kind] : kNouns)
      if (Reads(tokens, at, n, noun)) return {kind, n};
    for (const TownThing& thing : TownThings())
      if (Reads(tokens, at, n, thing.noun)) return {OfThing(thing.setting), n};
    // "pedestrian lanes" are lanes.
    for (const TownWord& word : TownWords()) {
      if (!Reads(tokens, at, n, word.phrase) || tokens[at].text == "pedestrians") continue;
      if (word.subject == "kind" || word.subject == "part") return {kPlaces, n};
      if (word.subject == "houses") return {kHouses, n};
      if (word.subject == "roofs") return {kRoofs, n};
      return {kAdjective, n};
    }
    for (const TownStuff& stuff : TownStuffs())
      if (Reads(tokens, at, n, stuff.noun)) return {OfStuff(stuff.setting), n};
  }
  return {0, 0};
}

}  // namespace

TownNoun NounAfter(const std::vector<WordToken>& tokens, size_t at) {
  TownNoun noun;
  for (size_t i = at; i < tokens.size() && !tokens[i].breaks;) {
    const auto [kind, n] = KindAt(tokens, i);
    if (kind == 0 && noun.kind == 0 && tokens[i].plain == "and" && i + 1 < tokens.size() && !tokens[i + 1].breaks &&
        KindAt(tokens, i + 1).first == kAdjective) {
      ++i;
      continue;
    }
    if (kind == 0 || (kind == kAdjective && noun.kind != 0)) break;
    i += n;
    if (kind != kAdjective) noun = {kind, i};
  }
  return noun;
}

bool Suits(std::string_view subject, const TownNoun& noun, std::string& of) {
  const auto* suit = std::find_if(kSuits.begin(), kSuits.end(), [&](const Suit& row) { return row.subject == subject; });
  if (suit == kSuits.end() || noun.kind == 0 || (suit->nouns & noun.kind) != 0) return true;
  of = suit->of;
  return false;
}

}  // namespace airsim360::internal
