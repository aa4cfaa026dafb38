#include "airsim360/worlds/town_maker/town_lexicon.h"

#include <algorithm>
#include <array>

namespace airsim360::internal {
namespace {

using D = TownDraft;
constexpr WordLevel K = WordLevel::kKind, P = WordLevel::kPlace, S = WordLevel::kSaid;

void Size(TownSpec& s, double width, double depth) { s.width = width, s.depth = depth; }
void Floors(TownSpec& s, double least, double most) { s.least_floors = least, s.most_floors = most; }
void Rural(TownSpec& s) {
  s.country = TownCountry::kFields;
  s.traffic = 0.4;
}
void Old(TownSpec& s) {
  s.plan = TownPlan::kOrganic;
  s.street = 8.2;
  s.block = 54;
}

bool Always(const D&) { return true; }
bool AtSea(const D& d) { return d.spec.at_sea(); }
// A clear sky may be above snow that lies, not above clouds, fog or rain.
bool ClearSky(const D& d) {
  return std::ranges::all_of(d.airs, [](const std::string& air) { return air == "clear" || air == "winter"; });
}
bool Sunlit(const D& d) { return ClearSky(d) && d.time != "night" && d.time != "dusk" && d.time != "dawn"; }
template <size_t kNumber>
void HourOf(D& d) {
  static constexpr const char* kHours[] = {"night", "sunset", "dusk", "morning", "dawn", "sunrise", "day"};
  d.time = kHours[kNumber];
}
template <size_t kNumber>
void SkyOf(D& d) {
  static constexpr const char* kAirs[] = {"clear", "rain", "fog", "mist", "winter", "overcast", "snow", "storm"};
  d.airs.insert(kAirs[kNumber]);
}
bool Uneven(const D& d) { return d.spec.relief != TownRelief::kFlat; }
template <TownRelief kRelief>
bool Lies(const D& d) {
  return d.spec.relief == kRelief;
}

// Much of it: what another word has more of already stays.
void Much(double& field, double amount) { field = amount >= 1 ? std::max(field, amount) : amount; }
void Trees(D& d, double amount) {
  Much(d.spec.trees, amount);
  if (amount == 0) d.spec.palms = false;
}
void Traffic(D& d, double amount) { Much(d.spec.traffic, amount); }
void People(D& d, double amount) {
  if (amount == 0)
    d.people_share = -1;
  else
    Much(d.people_share, amount);
}

void Village(D& d) {
  Size(d.spec, 300, 260);
  Floors(d.spec, 1, 2);
  Rural(d.spec);
  d.spec.plan = TownPlan::kOrganic;
  d.spec.style = TownStyle::kStone;
  d.spec.street = 8.8;
  d.spec.block = 50;
  d.spec.setback = 2.6;
  d.spec.built = 0.85;
}
void Town(D& d) {
  Size(d.spec, 380, 340);
  Floors(d.spec, 2, 4);
  d.spec.plan = TownPlan::kOrganic;
  d.spec.street = 10.5;
  d.spec.country = TownCountry::kFields;
}
void City(D& d) {
  Size(d.spec, 520, 460);
  Floors(d.spec, 3, 8);
  d.spec.street = 15;
  d.spec.block = 80;
  d.spec.squares = 2;
}
void Downtown(D& d) {
  City(d);
  d.spec.style = TownStyle::kModern;
  Floors(d.spec, 8, 36);
  d.spec.street = 21;
  d.spec.block = 92;
}
void Suburb(D& d) {
  Size(d.spec, 420, 360);
  Floors(d.spec, 1, 2);
  d.spec.plan = TownPlan::kOrganic;
  d.spec.style = TownStyle::kSuburban;
  d.spec.street = 13;
  d.spec.block = 68;
  d.spec.setback = 6;
  d.spec.squares = 0;
  d.spec.traffic = 0.6;
}
void Industrial(D& d) {
  Size(d.spec, 440, 380);
  d.spec.style = TownStyle::kIndustrial;
  Floors(d.spec, 2, 4);
  d.spec.street = 17;
  d.spec.block = 100;
  d.spec.trees = 0.3;
  d.spec.squares = 0;
  d.spec.parks = 0;
}
void Cabins(D& d) {
  Size(d.spec, 300, 300);
  d.spec.plan = TownPlan::kScattered;
  d.spec.style = TownStyle::kTimber;
  d.spec.paving = TownPaving::kDirt;
  d.spec.country = TownCountry::kForest;
  Floors(d.spec, 1, 2);
  d.spec.street = 9;
  d.spec.block = 62;
  d.spec.traffic = 0;
  d.spec.squares = 0;
}

constexpr auto kWords = std::to_array<TownWord>({
    // What it is.
    {"hamlet", K, "kind", "hamlet", [](D& d) { Village(d); Size(d.spec, 220, 190); d.spec.plan = TownPlan::kLinear; d.spec.houses = 24; d.spec.parks = 0; }},
    {"village", K, "kind", "village", Village},
    {"town", K, "kind", "town", Town},
    {"city", K, "kind", "city", City},
    {"metropolis", K, "kind", "city", [](D& d) { City(d); d.scale *= 1.4; Floors(d.spec, 5, 20); }},
    {"megacity", K, "kind", "city", [](D& d) { City(d); d.scale *= 1.4; Floors(d.spec, 5, 20); }},
    {"suburb", K, "kind", "suburb", Suburb},
    {"suburban", K, "kind", "suburb", Suburb},
    {"suburbia", K, "kind", "suburb", Suburb},
    {"estate", K, "kind", "estate", [](D& d) { Suburb(d); d.spec.style = TownStyle::kMixed; Floors(d.spec, 3, 6); d.spec.parks = 2; }},
    {"university campus", K, "kind", "campus", [](D& d) { Suburb(d); d.spec.style = TownStyle::kBrick; Floors(d.spec, 2, 5); d.spec.setback = 8; d.spec.parks = 3; d.spec.squares = 1; }},
    {"campus", K, "kind", "campus", [](D& d) { Suburb(d); d.spec.style = TownStyle::kBrick; Floors(d.spec, 2, 5); d.spec.setback = 8; d.spec.parks = 3; d.spec.squares = 1; }},
    {"slum", K, "kind", "slum", [](D& d) { Old(d.spec); Size(d.spec, 260, 240); Floors(d.spec, 1, 3); d.spec.street = 5.5; d.spec.block = 34; d.spec.trees = 0.1; d.spec.traffic = 0.1; d.spec.parks = 0; d.spec.squares = 0; }},
    {"shanty town", K, "kind", "slum", [](D& d) { Old(d.spec); Size(d.spec, 260, 240); Floors(d.spec, 1, 2); d.spec.street = 5.5; d.spec.block = 34; d.spec.trees = 0.1; d.spec.traffic = 0.1; d.spec.parks = 0; d.spec.squares = 0; }},
    {"resort", K, "kind", "resort", [](D& d) { City(d); d.spec.style = TownStyle::kWhitewashed; Floors(d.spec, 3, 8); d.spec.water = TownWater::kSea; d.spec.palms = true; d.spec.cafes = true; }},
    {"cabin", K, "houses", "cabins", Cabins},
    {"log cabin", K, "houses", "cabins", Cabins},
    {"hut", K, "houses", "cabins", Cabins},
    {"chalet", K, "houses", "cabins", Cabins},
    // A part of one: no kind of its own, so that "a district of a city" is one thing.
    {"downtown", K, "part", "downtown", Downtown},
    {"business district", K, "part", "downtown", Downtown},
    {"financial district", K, "part", "downtown", Downtown},
    {"city centre", K, "part", "centre", City},
    {"city center", K, "part", "centre", City},
    {"old town", K, "part", "old town", [](D& d) { Town(d); Old(d.spec); d.spec.paving = TownPaving::kCobbles; }},
    {"old quarter", K, "part", "old town", [](D& d) { Town(d); Old(d.spec); d.spec.paving = TownPaving::kCobbles; }},
    {"historic centre", K, "part", "old town", [](D& d) { Town(d); Old(d.spec); d.spec.paving = TownPaving::kCobbles; }},
    {"industrial", K, "part", "industrial", Industrial},
    {"industrial district", K, "part", "industrial", Industrial},
    {"industrial estate", K, "part", "industrial", Industrial},
    {"factory", K, "part", "industrial", Industrial},
    {"warehouse", K, "part", "industrial", Industrial},
    {"residential", K, "part", "residential", [](D& d) { d.spec.traffic = 0.5; }},
    // Places and peoples.
    {"lisbon", P, "place", "style: azulejo, paving: calcada", [](D& d) { Old(d.spec); d.spec.style = TownStyle::kAzulejo; d.spec.paving = TownPaving::kCalcada; Floors(d.spec, 3, 6); d.spec.relief = TownRelief::kSlope; d.spec.climb = 34; }},
    {"portuguese", P, "place", "style: azulejo, paving: calcada", [](D& d) { Old(d.spec); d.spec.style = TownStyle::kAzulejo; d.spec.paving = TownPaving::kCalcada; }},
    {"rome", P, "place", "style: ochre, paving: cobbles", [](D& d) { Old(d.spec); d.spec.style = TownStyle::kOchre; d.spec.paving = TownPaving::kCobbles; Floors(d.spec, 3, 5); }},
    {"roman", P, "place", "style: ochre, paving: cobbles", [](D& d) { Old(d.spec); d.spec.style = TownStyle::kOchre; d.spec.paving = TownPaving::kCobbles; }},
    {"italian", P, "place", "style: ochre, paving: cobbles", [](D& d) { Old(d.spec); d.spec.style = TownStyle::kOchre; d.spec.paving = TownPaving::kCobbles; }},
    {"mediterranean", P, "place", "style: ochre, roofs: tiled", [](D& d) { Old(d.spec); d.spec.style = TownStyle::kOchre; d.spec.roofs = TownRoofs::kTiled; }},
    {"spanish", P, "place", "style: whitewashed, roofs: tiled", [](D& d) { Old(d.spec); d.spec.style = TownStyle::kWhitewashed; d.spec.roofs = TownRoofs::kTiled; }},
    {"greek", P, "place", "style: whitewashed, roofs: flat", [](D& d) { Old(d.spec); d.spec.style = TownStyle::kWhitewashed; d.spec.roofs = TownRoofs::kFlat; d.spec.paving = TownPaving::kCobbles; }},
    {"scandinavian", P, "place", "style: timber, colours: bright", [](D& d) { d.spec.style = TownStyle::kTimber; d.spec.colours = TownColours::kBright; }},
    {"norwegian", P, "place", "style: timber, colours: bright", [](D& d) { d.spec.style = TownStyle::kTimber; d.spec.colours = TownColours::kBright; }},
    {"swedish", P, "place", "style: timber, colours: red", [](D& d) { d.spec.style = TownStyle::kTimber; d.spec.colours = TownColours::kRed; }},
    {"alpine", P, "place", "style: timber, relief: valley", [](D& d) { d.spec.style = TownStyle::kTimber; d.spec.relief = TownRelief::kValley; d.spec.climb = 40; d.spec.country = TownCountry::kForest; }},
    {"swiss", P, "place", "style: timber, relief: valley", [](D& d) { d.spec.style = TownStyle::kTimber; d.spec.relief = TownRelief::kValley; d.spec.climb = 40; d.spec.country = TownCountry::kForest; }},
    {"english", P, "place", "style: stone, roofs: slate", [](D& d) { d.spec.style = TownStyle::kStone; d.spec.roofs = TownRoofs::kSlate; }},
    {"british", P, "place", "style: brick, roofs: slate", [](D& d) { d.spec.style = TownStyle::kBrick; d.spec.roofs = TownRoofs::kSlate; }},
    {"victorian", P, "place", "style: brick, roofs: slate", [](D& d) { d.spec.style = TownStyle::kBrick; d.spec.roofs = TownRoofs::kSlate; Floors(d.spec, 2, 3); }},
    {"french", P, "place", "style: stone", [](D& d) { d.spec.style = TownStyle::kStone; d.spec.roofs = TownRoofs::kSlate; }},
    {"german", P, "place", "style: mixed, roofs: tiled", [](D& d) { d.spec.style = TownStyle::kMixed; d.spec.roofs = TownRoofs::kTiled; }},
    {"dutch", P, "place", "style: brick, roofs: tiled", [](D& d) { d.spec.style = TownStyle::kBrick; d.spec.roofs = TownRoofs::kTiled; }},
    {"european", P, "place", "plan: organic", [](D& d) { d.spec.plan = TownPlan::kOrganic; }},
    {"american", P, "place", "plan: grid", [](D& d) { if (d.spec.setback == 0) d.spec.plan = TownPlan::kGrid, d.spec.style = TownStyle::kBrick; }},
    {"new york", P, "place", "plan: grid, style: brick", [](D& d) { d.spec.plan = TownPlan::kGrid; d.spec.style = TownStyle::kBrick; Floors(d.spec, 4, 9); d.spec.street = 18; d.spec.block = 84; }},
    {"manhattan", P, "place", "plan: grid, style: modern", [](D& d) { Downtown(d); d.spec.plan = TownPlan::kGrid; }},
    {"western", P, "place", "style: timber, paving: dirt, country: desert", [](D& d) { d.spec.style = TownStyle::kTimber; d.spec.paving = TownPaving::kDirt; d.spec.country = TownCountry::kDesert; d.spec.trees = 0.1; d.spec.setback = 0; d.spec.street = 15; }},
    {"medieval", P, "age", "plan: organic, style: stone, paving: cobbles", [](D& d) { Old(d.spec); d.spec.style = TownStyle::kStone; d.spec.paving = TownPaving::kCobbles; }},
    {"old", P, "age", "plan: organic", [](D& d) { Old(d.spec); }},
    {"historic", P, "age", "plan: organic", [](D& d) { Old(d.spec); }},
    {"ancient", P, "age", "plan: organic", [](D& d) { Old(d.spec); }},
    {"modern", P, "age", "style: modern or mixed", [](D& d) { d.spec.style = d.spec.most_floors > 7 ? TownStyle::kModern : TownStyle::kMixed; d.spec.roofs = TownRoofs::kFlat; }},
    {"contemporary", P, "age", "style: modern or mixed", [](D& d) { d.spec.style = d.spec.most_floors > 7 ? TownStyle::kModern : TownStyle::kMixed; d.spec.roofs = TownRoofs::kFlat; }},
    {"fishing", P, "trade", "water: sea, harbour: true", [](D& d) { if (d.spec.water == TownWater::kNone) d.spec.water = TownWater::kSea; d.spec.harbour = true; }},
    {"farming", P, "trade", "country: fields", [](D& d) { d.spec.country = TownCountry::kFields; }},
    {"rural", P, "trade", "country: fields", [](D& d) { Rural(d.spec); }},
    // Size.
    {"tiny", S, "size", "sides x 0.6", [](D& d) { d.scale *= 0.6; }, Always},
    {"small", S, "size", "sides x 0.8", [](D& d) { d.scale *= 0.8; }, Always},
    {"little", S, "size", "sides x 0.8", [](D& d) { d.scale *= 0.8; }, Always},
    {"medium sized", S, "size", "sides x 1", [](D&) {}, Always},
    {"large", S, "size", "sides x 1.3", [](D& d) { d.scale *= 1.3; }, Always},
    {"big", S, "size", "sides x 1.3", [](D& d) { d.scale *= 1.3; }, Always},
    {"huge", S, "size", "sides x 1.7", [](D& d) { d.scale *= 1.7; }, Always},
    {"vast", S, "size", "sides x 1.7", [](D& d) { d.scale *= 1.7; }, Always},
    // Plan and streets.
    {"grid", S, "plan", "plan: grid", [](D& d) { d.spec.plan = TownPlan::kGrid; }},
    {"grid plan", S, "plan", "plan: grid", [](D& d) { d.spec.plan = TownPlan::kGrid; }},
    {"gridded", S, "plan", "plan: grid", [](D& d) { d.spec.plan = TownPlan::kGrid; }},
    {"rectangular", S, "plan", "plan: grid", [](D& d) { d.spec.plan = TownPlan::kGrid; }},
    {"straight", S, "plan", "plan: grid", [](D& d) { d.spec.plan = TownPlan::kGrid; }},
    {"organic", S, "plan", "plan: organic", [](D& d) { d.spec.plan = TownPlan::kOrganic; }},
    {"winding", S, "plan", "plan: organic", [](D& d) { d.spec.plan = TownPlan::kOrganic; }},
    {"crooked", S, "plan", "plan: organic", [](D& d) { d.spec.plan = TownPlan::kOrganic; }},
    {"curved", S, "plan", "plan: organic", [](D& d) { d.spec.plan = TownPlan::kOrganic; }},
    {"curving", S, "plan", "plan: organic", [](D& d) { d.spec.plan = TownPlan::kOrganic; }},
    {"irregular", S, "plan", "plan: organic", [](D& d) { d.spec.plan = TownPlan::kOrganic; }},
    {"radial", S, "plan", "plan: radial", [](D& d) { d.spec.plan = TownPlan::kRadial; }},
    {"circular", S, "plan", "plan: radial", [](D& d) { d.spec.plan = TownPlan::kRadial; }},
    {"round", S, "plan", "plan: radial", [](D& d) { d.spec.plan = TownPlan::kRadial; }},
    {"star shaped", S, "plan", "plan: radial", [](D& d) { d.spec.plan = TownPlan::kRadial; }},
    {"concentric", S, "plan", "plan: radial", [](D& d) { d.spec.plan = TownPlan::kRadial; }},
    {"linear", S, "plan", "plan: linear", [](D& d) { d.spec.plan = TownPlan::kLinear; }},
    {"one street", S, "plan", "plan: linear", [](D& d) { d.spec.plan = TownPlan::kLinear; }},
    {"single street", S, "plan", "plan: linear", [](D& d) { d.spec.plan = TownPlan::kLinear; }},
    {"two street", S, "plan", "plan: linear", [](D& d) { d.spec.plan = TownPlan::kLinear; }},
    {"along a road", S, "plan", "plan: linear", [](D& d) { d.spec.plan = TownPlan::kLinear; }},
    {"scattered", S, "plan", "plan: scattered", [](D& d) { d.spec.plan = TownPlan::kScattered; d.spec.setback = 0; }, [](const D& d) { return d.spec.plan == TownPlan::kScattered; }},
    {"dispersed", S, "plan", "plan: scattered", [](D& d) { d.spec.plan = TownPlan::kScattered; d.spec.setback = 0; }, [](const D& d) { return d.spec.plan == TownPlan::kScattered; }},
    {"narrow", S, "street", "street: narrow", [](D& d) { d.spec.street = std::max(5.6, 0.62 * d.spec.street); d.spec.block = std::max(36.0, 0.85 * d.spec.block); }, Always},
    {"wide", S, "street", "street: wide", [](D& d) { d.spec.street = std::min(34.0, 1.45 * d.spec.street); d.spec.block *= 1.1; }, Always},
    {"broad", S, "street", "street: wide", [](D& d) { d.spec.street = std::min(34.0, 1.45 * d.spec.street); d.spec.block *= 1.1; }, Always},
    {"boulevard", S, "boulevard", "street: at least 22 m", [](D& d) { d.spec.street = std::max(22.0, d.spec.street); }},
    {"avenue", S, "boulevard", "street: at least 18 m", [](D& d) { d.spec.street = std::max(18.0, d.spec.street); }},
    {"cobbled", S, "paving", "paving: cobbles", [](D& d) { d.spec.paving = TownPaving::kCobbles; }},
    {"cobble", S, "paving", "paving: cobbles", [](D& d) { d.spec.paving = TownPaving::kCobbles; }},
    {"cobblestone", S, "paving", "paving: cobbles", [](D& d) { d.spec.paving = TownPaving::kCobbles; }},
    {"paved", S, "paving", "paving: asphalt", [](D& d) { d.spec.paving = TownPaving::kAsphalt; }},
    {"asphalt", S, "paving", "paving: asphalt", [](D& d) { d.spec.paving = TownPaving::kAsphalt; }},
    {"calcada", S, "paving", "paving: calcada", [](D& d) { d.spec.paving = TownPaving::kCalcada; }},
    {"dirt", S, "paving", "paving: dirt", [](D& d) { d.spec.paving = TownPaving::kDirt; }},
    {"unpaved", S, "paving", "paving: dirt", [](D& d) { d.spec.paving = TownPaving::kDirt; }},
    {"dusty", S, "paving", "paving: dirt", [](D& d) { d.spec.paving = TownPaving::kDirt; }},
    {"muddy", S, "paving", "paving: dirt", [](D& d) { d.spec.paving = TownPaving::kDirt; }},
    // Ground.
    {"flat", S, "relief", "relief: flat", [](D& d) { d.spec.relief = TownRelief::kFlat; }, Lies<TownRelief::kFlat>},
    {"level", S, "relief", "relief: flat", [](D& d) { d.spec.relief = TownRelief::kFlat; }, Lies<TownRelief::kFlat>},
    {"rolling", S, "relief", "relief: rolling", [](D& d) { d.spec.relief = TownRelief::kRolling; d.spec.climb = 14; }, Lies<TownRelief::kRolling>},
    {"hilly", S, "relief", "relief: rolling", [](D& d) { d.spec.relief = TownRelief::kRolling; d.spec.climb = 36; d.hilly = true; }, Lies<TownRelief::kRolling>},
    {"hill", S, "relief", "relief: hill", [](D& d) { d.spec.relief = TownRelief::kHill; d.spec.climb = 42; }, Lies<TownRelief::kHill>},
    {"hilltop", S, "relief", "relief: hill", [](D& d) { d.spec.relief = TownRelief::kHill; d.spec.climb = 42; }, Lies<TownRelief::kHill>},
    {"slope", S, "relief", "relief: slope", [](D& d) { d.spec.relief = TownRelief::kSlope; d.spec.climb = 34; }, Lies<TownRelief::kSlope>},
    {"sloping", S, "relief", "relief: slope", [](D& d) { d.spec.relief = TownRelief::kSlope; d.spec.climb = 30; }, Lies<TownRelief::kSlope>},
    {"hillside", S, "relief", "relief: slope", [](D& d) { d.spec.relief = TownRelief::kSlope; d.spec.climb = 40; }, Lies<TownRelief::kSlope>},
    {"valley", S, "relief", "relief: valley", [](D& d) { d.spec.relief = TownRelief::kValley; d.spec.climb = 36; }, Lies<TownRelief::kValley>},
    {"mountain", S, "relief", "relief: valley, country: forest", [](D& d) { d.spec.relief = TownRelief::kValley; d.spec.climb = 42; d.spec.country = TownCountry::kForest; }},
    {"steep", S, "steep", "climb: 24 % of the shorter side", [](D& d) { if (d.spec.relief == TownRelief::kFlat) d.spec.relief = TownRelief::kSlope; d.spec.climb = 999; }, Uneven},
    {"gentle", S, "steep", "climb: 12", [](D& d) { if (d.spec.relief == TownRelief::kFlat) d.spec.relief = TownRelief::kRolling; d.spec.climb = 12; }, Uneven},
    // Water.
    {"coastal", S, "water", "water: sea", [](D& d) { d.spec.water = TownWater::kSea; }, AtSea},
    {"coast", S, "water", "water: sea", [](D& d) { d.spec.water = TownWater::kSea; }, AtSea},
    {"sea", S, "water", "water: sea", [](D& d) { d.spec.water = TownWater::kSea; }, AtSea},
    {"seaside", S, "water", "water: sea", [](D& d) { d.spec.water = TownWater::kSea; }, AtSea},
    {"sea view", S, "water", "water: sea", [](D& d) { d.spec.water = TownWater::kSea; }, AtSea},
    {"ocean", S, "water", "water: sea", [](D& d) { d.spec.water = TownWater::kSea; }, AtSea},
    {"bay", S, "water", "water: sea", [](D& d) { d.spec.water = TownWater::kSea; }, AtSea},
    {"island", S, "island", "water: island", [](D& d) { d.spec.water = TownWater::kIsland; }},
    {"surrounded by the sea", S, "island", "water: island", [](D& d) { d.spec.water = TownWater::kIsland; }},
    {"surrounded by sea", S, "island", "water: island", [](D& d) { d.spec.water = TownWater::kIsland; }},
    {"surrounded by water", S, "island", "water: island", [](D& d) { d.spec.water = TownWater::kIsland; }},
    {"beach", S, "beach", "water: sea, harbour: false", [](D& d) { d.spec.water = TownWater::kSea; d.spec.harbour = false; }, [](const D& d) { return d.spec.at_sea() && !d.spec.harbour; }},
    {"promenade", S, "water", "water: sea", [](D& d) { d.spec.water = TownWater::kSea; }, AtSea},
    {"river", S, "water", "water: river", [](D& d) { d.spec.water = TownWater::kRiver; }},
    {"riverside", S, "water", "water: river", [](D& d) { d.spec.water = TownWater::kRiver; }},
    {"canal", S, "water", "water: canal", [](D& d) { d.spec.water = TownWater::kCanal; }},
    {"lake", S, "water", "water: lake", [](D& d) { d.spec.water = TownWater::kLake; }},
    {"lakeside", S, "water", "water: lake", [](D& d) { d.spec.water = TownWater::kLake; }},
    {"pond", S, "water", "water: lake", [](D& d) { d.spec.water = TownWater::kLake; }},
    {"through the middle", S, "middle", "central_water: true", [](D& d) { d.spec.central_water = true; }},
    {"through the centre", S, "middle", "central_water: true", [](D& d) { d.spec.central_water = true; }},
    {"through the center", S, "middle", "central_water: true", [](D& d) { d.spec.central_water = true; }},
    {"through the town", S, "middle", "central_water: true", [](D& d) { d.spec.central_water = true; }},
    {"through it", S, "middle", "central_water: true", [](D& d) { d.spec.central_water = true; }},
    {"lake in the middle", S, "middle", "water: lake, central_water: true", [](D& d) { d.spec.water = TownWater::kLake; d.spec.central_water = true; }},
    {"lake in the centre", S, "middle", "water: lake, central_water: true", [](D& d) { d.spec.water = TownWater::kLake; d.spec.central_water = true; }},
    {"lake in the center", S, "middle", "water: lake, central_water: true", [](D& d) { d.spec.water = TownWater::kLake; d.spec.central_water = true; }},
    {"pond in the middle", S, "middle", "water: lake, central_water: true", [](D& d) { d.spec.water = TownWater::kLake; d.spec.central_water = true; }},
    {"around a lake", S, "middle", "water: lake, central_water: true", [](D& d) { d.spec.water = TownWater::kLake; d.spec.central_water = true; }},
    {"around the lake", S, "middle", "water: lake, central_water: true", [](D& d) { d.spec.water = TownWater::kLake; d.spec.central_water = true; }},
    {"marina", S, "harbour", "harbour: true", [](D& d) { d.spec.harbour = true; }},
    {"harbour", S, "harbour", "harbour: true", [](D& d) { d.spec.harbour = true; }},
    {"harbor", S, "harbour", "harbour: true", [](D& d) { d.spec.harbour = true; }},
    {"port", S, "harbour", "harbour: true", [](D& d) { d.spec.harbour = true; }},
    {"pier", S, "harbour", "harbour: true", [](D& d) { d.spec.harbour = true; }},
    {"jetty", S, "harbour", "harbour: true", [](D& d) { d.spec.harbour = true; }},
    {"boat", S, "harbour", "harbour: true", [](D& d) { d.spec.harbour = true; }},
    {"bridge", S, "bridge", "water: river", [](D& d) { if (d.spec.water == TownWater::kNone) d.spec.water = TownWater::kRiver; }},
    // Country.
    {"forest", S, "country", "country: forest", [](D& d) { d.spec.country = TownCountry::kForest; }},
    {"dense forest", S, "dense forest", "country: forest, trees: 1.4", [](D& d) { d.spec.country = TownCountry::kForest; d.spec.trees = std::max(1.4, d.spec.trees); }},
    {"thick forest", S, "dense forest", "country: forest, trees: 1.4", [](D& d) { d.spec.country = TownCountry::kForest; d.spec.trees = std::max(1.4, d.spec.trees); }},
    {"deep forest", S, "dense forest", "country: forest, trees: 1.4", [](D& d) { d.spec.country = TownCountry::kForest; d.spec.trees = std::max(1.4, d.spec.trees); }},
    {"dense wood", S, "dense forest", "country: forest, trees: 1.4", [](D& d) { d.spec.country = TownCountry::kForest; d.spec.trees = std::max(1.4, d.spec.trees); }},
    {"thick wood", S, "dense forest", "country: forest, trees: 1.4", [](D& d) { d.spec.country = TownCountry::kForest; d.spec.trees = std::max(1.4, d.spec.trees); }},
    {"dense woodland", S, "dense forest", "country: forest, trees: 1.4", [](D& d) { d.spec.country = TownCountry::kForest; d.spec.trees = std::max(1.4, d.spec.trees); }},
    {"pine forest", S, "country", "country: forest", [](D& d) { d.spec.country = TownCountry::kForest; }},
    {"wood", S, "country", "country: forest", [](D& d) { d.spec.country = TownCountry::kForest; }},
    {"woodland", S, "country", "country: forest", [](D& d) { d.spec.country = TownCountry::kForest; }},
    {"field", S, "country", "country: fields", [](D& d) { d.spec.country = TownCountry::kFields; }},
    {"farmland", S, "country", "country: fields", [](D& d) { d.spec.country = TownCountry::kFields; }},
    {"countryside", S, "country", "country: fields", [](D& d) { d.spec.country = TownCountry::kFields; }},
    {"meadow", S, "country", "country: fields", [](D& d) { d.spec.country = TownCountry::kFields; }},
    {"desert", S, "country", "country: desert", [](D& d) { d.spec.country = TownCountry::kDesert; }},
    {"arid", S, "country", "country: desert", [](D& d) { d.spec.country = TownCountry::kDesert; }},
    // Houses.
    {"wooden", S, "style", "style: timber", [](D& d) { d.spec.style = TownStyle::kTimber; }},
    {"timber", S, "style", "style: timber", [](D& d) { d.spec.style = TownStyle::kTimber; }},
    {"log", S, "style", "style: timber", [](D& d) { d.spec.style = TownStyle::kTimber; }},
    {"stone", S, "style", "style: stone", [](D& d) { d.spec.style = TownStyle::kStone; }},
    {"brick", S, "style", "style: brick", [](D& d) { d.spec.style = TownStyle::kBrick; }},
    {"glass", S, "style", "style: modern", [](D& d) { d.spec.style = TownStyle::kModern; }},
    {"concrete", S, "style", "style: modern", [](D& d) { d.spec.style = TownStyle::kModern; }},
    {"tiled house", S, "style", "style: azulejo", [](D& d) { d.spec.style = TownStyle::kAzulejo; }},
    {"azulejo", S, "style", "style: azulejo", [](D& d) { d.spec.style = TownStyle::kAzulejo; }},
    {"whitewashed", S, "style", "style: whitewashed", [](D& d) { d.spec.style = TownStyle::kWhitewashed; }},
    {"stucco", S, "style", "style: ochre", [](D& d) { d.spec.style = TownStyle::kOchre; }},
    {"white", S, "colours", "colours: white", [](D& d) { d.spec.colours = TownColours::kWhite; }},
    {"ochre", S, "colours", "colours: ochre", [](D& d) { d.spec.colours = TownColours::kOchre; }},
    {"yellow", S, "colours", "colours: ochre", [](D& d) { d.spec.colours = TownColours::kOchre; }},
    {"colourful", S, "colours", "colours: bright", [](D& d) { d.spec.colours = TownColours::kBright; }},
    {"colorful", S, "colours", "colours: bright", [](D& d) { d.spec.colours = TownColours::kBright; }},
    {"bright", S, "colours", "colours: bright", [](D& d) { d.spec.colours = TownColours::kBright; }},
    {"red", S, "colours", "colours: red", [](D& d) { d.spec.colours = TownColours::kRed; }},
    {"grey", S, "colours", "colours: grey", [](D& d) { d.spec.colours = TownColours::kGrey; }},
    {"gray", S, "colours", "colours: grey", [](D& d) { d.spec.colours = TownColours::kGrey; }},
    {"terracotta roof", S, "roofs", "roofs: tiled", [](D& d) { d.spec.roofs = TownRoofs::kTiled; }},
    {"tiled roof", S, "roofs", "roofs: tiled", [](D& d) { d.spec.roofs = TownRoofs::kTiled; }},
    {"red roof", S, "roofs", "roofs: tiled", [](D& d) { d.spec.roofs = TownRoofs::kTiled; }},
    {"slate roof", S, "roofs", "roofs: slate", [](D& d) { d.spec.roofs = TownRoofs::kSlate; }},
    {"flat roof", S, "roofs", "roofs: flat", [](D& d) { d.spec.roofs = TownRoofs::kFlat; }},
    {"flat roofed", S, "roofs", "roofs: flat", [](D& d) { d.spec.roofs = TownRoofs::kFlat; }},
    {"low", S, "heights", "floors: 1 to 2", [](D& d) { Floors(d.spec, 1, 2); }, Always},
    {"low rise", S, "heights", "floors: 2 to 4", [](D& d) { Floors(d.spec, 2, 4); }, Always},
    {"mid rise", S, "heights", "floors: 4 to 8", [](D& d) { Floors(d.spec, 4, 8); }, Always},
    {"tall", S, "heights", "floors: 7 to 18", [](D& d) { Floors(d.spec, 7, 18); }, Always},
    {"high", S, "heights", "floors: 7 to 18", [](D& d) { Floors(d.spec, 7, 18); }, Always},
    {"high rise", S, "heights", "floors: 10 to 30", [](D& d) { Floors(d.spec, 10, 30); d.spec.style = d.spec.style == TownStyle::kBrick ? TownStyle::kBrick : TownStyle::kModern; d.spec.street = std::max(18.0, d.spec.street); d.spec.block = std::max(84.0, d.spec.block); }, Always},
    {"dense", S, "built", "built: 1, setback: 0", [](D& d) { d.spec.built = 1; d.spec.setback = 0; }},
    {"compact", S, "built", "built: 1, setback: 0", [](D& d) { d.spec.built = 1; d.spec.setback = 0; }},
    {"crammed", S, "built", "built: 1, setback: 0", [](D& d) { d.spec.built = 1; d.spec.setback = 0; }},
    {"sparse", S, "built", "built: 0.45", [](D& d) { d.spec.built = 0.45; }},
    {"spacious", S, "built", "built: 0.6", [](D& d) { d.spec.built = 0.6; }},
    {"detached", S, "apart", "setback: at least 5", [](D& d) { d.spec.setback = 5; }, [](const D& d) { return d.spec.setback >= 5; }},
    {"lawn", S, "lawns", "setback: at least 6", [](D& d) { d.spec.setback = std::max(6.0, d.spec.setback); }, [](const D& d) { return d.spec.setback >= 5; }},
    {"garden", S, "gardens", "setback: at least 5", [](D& d) { d.spec.setback = std::max(5.0, d.spec.setback); }, [](const D& d) { return d.spec.setback >= 5; }},
    {"front garden", S, "gardens", "setback: at least 5", [](D& d) { d.spec.setback = std::max(5.0, d.spec.setback); }, [](const D& d) { return d.spec.setback >= 5; }},
    {"terraced", S, "setback", "setback: 0", [](D& d) { d.spec.setback = 0; }},
    {"row house", S, "setback", "setback: 0", [](D& d) { d.spec.setback = 0; }},
    {"tree lined", S, "tree lined", "trees: at least 1.2", [](D& d) { d.spec.trees = std::max(1.2, d.spec.trees); }},
    {"palm lined", S, "palm lined", "palms: true", [](D& d) { d.spec.palms = true; }},
    {"trees everywhere", S, "green", "trees: 1.5", [](D& d) { d.spec.trees = 1.5; }, [](const D& d) { return d.spec.trees >= 1; }},
    {"green", S, "green", "trees: 1.5", [](D& d) { d.spec.trees = 1.5; }, [](const D& d) { return d.spec.trees >= 1; }},
    {"leafy", S, "green", "trees: 1.5", [](D& d) { d.spec.trees = 1.5; }, [](const D& d) { return d.spec.trees >= 1; }},
    {"busy", S, "life", "traffic: 1.4, people: many", [](D& d) { d.spec.traffic = 1.4; d.people_share = 1.6; }, [](const D& d) { return d.spec.traffic >= 1.2 && d.people_share >= 1; }},
    {"lively", S, "life", "traffic: 1.2, people: many", [](D& d) { d.spec.traffic = 1.2; d.people_share = 1.6; }, [](const D& d) { return d.spec.traffic >= 1.2 && d.people_share >= 1; }},
    {"crowded", S, "crowd", "people: many", [](D& d) { d.people_share = 1.8; }, [](const D& d) { return d.people_share >= 1; }},
    {"quiet", S, "life", "traffic: 0.3", [](D& d) { d.spec.traffic = 0.3; }, [](const D& d) { return d.spec.traffic <= 0.4; }},
    {"sleepy", S, "life", "traffic: 0.3", [](D& d) { d.spec.traffic = 0.3; }, [](const D& d) { return d.spec.traffic <= 0.4; }},
    {"peaceful", S, "life", "traffic: 0.3", [](D& d) { d.spec.traffic = 0.3; }, [](const D& d) { return d.spec.traffic <= 0.4; }},
    {"deserted", S, "crowd", "people: none", [](D& d) { d.people_share = -1; }},
    {"car free", S, "life", "traffic: 0", [](D& d) { d.spec.traffic = 0; }},
    {"pedestrian", S, "life", "traffic: 0", [](D& d) { d.spec.traffic = 0; }},
    {"terrace on a roof", S, "terrace", "terrace: true", [](D& d) { d.spec.terrace = true; }},
    {"roof terrace", S, "terrace", "terrace: true", [](D& d) { d.spec.terrace = true; }},
    {"rooftop terrace", S, "terrace", "terrace: true", [](D& d) { d.spec.terrace = true; }},
    {"rooftop garden", S, "terrace", "terrace: true", [](D& d) { d.spec.terrace = true; }},
    {"rooftop", S, "terrace", "terrace: true", [](D& d) { d.spec.terrace = true; }},
    // Light and weather.
    {"sunny", S, "sky", "environment weather: clear", SkyOf<0>, Sunlit},
    {"clear weather", S, "sky", "environment weather: clear", SkyOf<0>, ClearSky},
    {"clear day", S, "sky", "environment weather: clear", SkyOf<0>, ClearSky},
    {"clear sky", S, "sky", "environment weather: clear", SkyOf<0>, ClearSky},
    {"sunshine", S, "sky", "environment weather: clear", SkyOf<0>, Sunlit},
    {"cloudy", S, "sky", "environment weather: overcast", SkyOf<5>},
    {"overcast", S, "sky", "environment weather: overcast", SkyOf<5>},
    {"rainy", S, "rain", "environment weather: rain", SkyOf<1>},
    {"rain", S, "rain", "environment weather: rain", SkyOf<1>},
    {"in the rain", S, "rain", "environment weather: rain", SkyOf<1>},
    {"stormy", S, "rain", "environment weather: storm", SkyOf<7>},
    {"storm", S, "rain", "environment weather: storm", SkyOf<7>},
    {"foggy", S, "fog", "environment weather: fog", SkyOf<2>},
    {"fog", S, "fog", "environment weather: fog", SkyOf<2>},
    {"misty", S, "fog", "environment weather: mist", SkyOf<3>},
    {"mist", S, "fog", "environment weather: mist", SkyOf<3>},
    {"snowy", S, "snow", "environment weather: winter", SkyOf<4>},
    {"snow covered", S, "snow", "environment weather: winter", SkyOf<4>},
    {"winter", S, "snow", "environment weather: winter", SkyOf<4>},
    {"in winter", S, "snow", "environment weather: winter", SkyOf<4>},
    {"wintry", S, "snow", "environment weather: winter", SkyOf<4>},
    {"snow", S, "snowfall", "environment weather: snow", SkyOf<6>},
    {"snowing", S, "snowfall", "environment weather: snow", SkyOf<6>},
    {"snowfall", S, "snowfall", "environment weather: snow", SkyOf<6>},
    {"at night", S, "time", "environment weather: night", HourOf<0>},
    {"by night", S, "time", "environment weather: night", HourOf<0>},
    {"night", S, "time", "environment weather: night", HourOf<0>},
    {"night time", S, "time", "environment weather: night", HourOf<0>},
    {"after dark", S, "time", "environment weather: night", HourOf<0>},
    {"at sunset", S, "time", "environment weather: sunset", HourOf<1>},
    {"sunset", S, "time", "environment weather: sunset", HourOf<1>},
    {"in the evening", S, "time", "environment weather: sunset", HourOf<1>},
    {"evening", S, "time", "environment weather: sunset", HourOf<1>},
    {"at dusk", S, "time", "environment weather: dusk", HourOf<2>},
    {"dusk", S, "time", "environment weather: dusk", HourOf<2>},
    {"in the morning", S, "time", "environment weather: morning", HourOf<3>},
    {"morning", S, "time", "environment weather: morning", HourOf<3>},
    {"at dawn", S, "time", "environment weather: dusk, sun in the east", HourOf<4>},
    {"dawn", S, "time", "environment weather: dusk, sun in the east", HourOf<4>},
    {"at sunrise", S, "time", "environment weather: sunset, sun in the east", HourOf<5>},
    {"sunrise", S, "time", "environment weather: sunset, sun in the east", HourOf<5>},
    {"by day", S, "time", "environment weather: day", HourOf<6>},
    {"at noon", S, "time", "environment weather: day", HourOf<6>},
    {"noon", S, "time", "environment weather: day", HourOf<6>},
    {"midday", S, "time", "environment weather: day", HourOf<6>},
    {"daytime", S, "time", "environment weather: day", HourOf<6>},
    {"summer", S, "season", "as towns are: trees in leaf, no snow", [](D&) {}, [](const D& d) { return !d.airs.contains("winter") && !d.airs.contains("snow"); }},
    {"in summer", S, "season", "as towns are: trees in leaf, no snow", [](D&) {}, [](const D& d) { return !d.airs.contains("winter") && !d.airs.contains("snow"); }},
});

constexpr auto kStuffs = std::to_array<TownStuff>({
    {"tree", "trees", Trees},
    {"street tree", "trees", Trees},
    {"car", "traffic", Traffic},
    {"traffic", "traffic", Traffic},
    {"vehicle", "traffic", Traffic},
    {"people", "people", People},
    {"pedestrian", "people", People},
    {"passer by", "people", People},
    {"water", "water",
     [](D& d, double amount) {
       if (amount == 0)
         d.spec.water = TownWater::kNone;
       else if (d.spec.water == TownWater::kNone)
         d.spec.water = TownWater::kLake;
     }},
    {"park", "parks",
     [](D& d, double amount) { d.spec.parks = amount == 0  ? 0
                                              : amount < 1 ? 1
                                              : amount > 1 ? 4
                                                           : std::max<uint64_t>(1, d.spec.parks); }},
    {"plaza", "squares",
     [](D& d, double amount) {
       d.spec.squares = amount == 0 ? 0 : amount < 1 ? 1 : amount > 1 ? 4 : std::max<uint64_t>(1, d.spec.squares);
     }},
    {"piazza", "squares",
     [](D& d, double amount) {
       d.spec.squares = amount == 0 ? 0 : amount < 1 ? 1 : amount > 1 ? 4 : std::max<uint64_t>(1, d.spec.squares);
     }},
    {"square", "squares",
     [](D& d, double amount) {
       d.spec.squares = amount == 0 ? 0 : amount < 1 ? 1 : amount > 1 ? 4 : std::max<uint64_t>(1, d.spec.squares);
     }},
});

constexpr auto kThings = std::to_array<TownThing>({
    {"church", "church", &TownSpec::church},
    {"cathedral", "church", &TownSpec::church},
    {"chapel", "church", &TownSpec::church},
    {"castle", "castle", &TownSpec::castle},
    {"fortress", "castle", &TownSpec::castle},
    {"citadel", "castle", &TownSpec::castle},
    {"clock tower", "clock_tower", &TownSpec::clock_tower},
    {"belfry", "clock_tower", &TownSpec::clock_tower},
    {"windmill", "windmill", &TownSpec::windmill},
    {"market", "market", &TownSpec::market},
    {"market square", "market", &TownSpec::market},
    {"bazaar", "market", &TownSpec::market},
    {"stall", "market", &TownSpec::market},
    {"cafe", "cafes", &TownSpec::cafes},
    {"cafe terrace", "cafes", &TownSpec::cafes},
    {"restaurant", "cafes", &TownSpec::cafes},
    {"terrace", "cafes", &TownSpec::cafes},
    {"bar", "cafes", &TownSpec::cafes},
    {"pub", "cafes", &TownSpec::cafes},
    {"ruin", "ruins", &TownSpec::ruins},
    {"temple", "ruins", &TownSpec::ruins},
    {"forum", "ruins", &TownSpec::ruins},
    {"column", "ruins", &TownSpec::ruins},
    {"arch", "arches", &TownSpec::arches},
    {"tram", "wires", &TownSpec::wires},
    {"tram wire", "wires", &TownSpec::wires},
    {"tramway", "wires", &TownSpec::wires},
    {"streetcar", "wires", &TownSpec::wires},
    {"playground", "playground", &TownSpec::playground},
    {"fountain", "fountain", &TownSpec::fountain},
    {"skyscraper", "towers", &TownSpec::towers},
    {"tower", "towers", &TownSpec::towers},
    {"tower block", "towers", &TownSpec::towers},
    {"cycle path", "cycle_lanes", &TownSpec::cycle_lanes},
    {"cycle lane", "cycle_lanes", &TownSpec::cycle_lanes},
    {"bike lane", "cycle_lanes", &TownSpec::cycle_lanes},
    {"bike path", "cycle_lanes", &TownSpec::cycle_lanes},
    {"lamp", "lamps", &TownSpec::lamps},
    {"street lamp", "lamps", &TownSpec::lamps},
    {"street light", "lamps", &TownSpec::lamps},
    {"streetlight", "lamps", &TownSpec::lamps},
    {"streetlamp", "lamps", &TownSpec::lamps},
    {"street lighting", "lamps", &TownSpec::lamps},
    {"lamp post", "lamps", &TownSpec::lamps},
    {"lamppost", "lamps", &TownSpec::lamps},
    {"lantern", "lamps", &TownSpec::lamps},
    {"bus stop", "bus_stops", &TownSpec::bus_stops},
    {"bus shelter", "bus_stops", &TownSpec::bus_stops},
    {"bus stop at the corner", "bus_stops", &TownSpec::bus_stops},
    {"bus stop on the corner", "bus_stops", &TownSpec::bus_stops},
    {"bus stop at a corner", "bus_stops", &TownSpec::bus_stops},
    {"bus stop on a corner", "bus_stops", &TownSpec::bus_stops},
    {"palm", "palms", &TownSpec::palms},
    {"palm tree", "palms", &TownSpec::palms},
});

}  // namespace

std::span<const TownWord> TownWords() { return kWords; }
std::span<const TownStuff> TownStuffs() { return kStuffs; }
std::span<const TownThing> TownThings() { return kThings; }

}  // namespace airsim360::internal
