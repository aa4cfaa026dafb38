// The words that describe buildings from inside.
#pragma once

#include <array>
#include <string_view>

#include "airsim360/worlds/building_spec.h"

namespace airsim360::building_tables {

struct UseWord {
  std::string_view words;
  BuildingUse use;
};
inline constexpr auto kUses = std::to_array<UseWord>({{"apartment", BuildingUse::kApartment},
                                                      {"flat", BuildingUse::kApartment},
                                                      {"maisonette", BuildingUse::kApartment},
                                                      {"office", BuildingUse::kOffice},
                                                      {"offices", BuildingUse::kOffice},
                                                      {"office building", BuildingUse::kOffice},
                                                      {"office tower", BuildingUse::kOffice},
                                                      {"warehouse", BuildingUse::kWarehouse},
                                                      {"storage hall", BuildingUse::kWarehouse},
                                                      {"mall", BuildingUse::kMall},
                                                      {"shopping mall", BuildingUse::kMall},
                                                      {"shopping centre", BuildingUse::kMall},
                                                      {"shopping center", BuildingUse::kMall},
                                                      {"car park", BuildingUse::kCarPark},
                                                      {"parking garage", BuildingUse::kCarPark},
                                                      {"multi storey car park", BuildingUse::kCarPark},
                                                      {"library", BuildingUse::kLibrary},
                                                      {"public library", BuildingUse::kLibrary}});
// One word a line would hide them.
// clang-format off
inline constexpr auto kFillerWords = std::to_array<std::string_view>({"a", "an", "the", "with", "and", "but", "of", "in", "its", "it", "that", "which", "has", "have", "having",
                                "is", "are", "building", "for", "make", "create", "build", "please", "me", "i", "want", "need"});
// Words of a place out of doors: such descriptions are of towns.
inline constexpr auto kPlaceWords = std::to_array<std::string_view>(
    {"town", "city", "village", "street", "streets", "suburb", "downtown", "hamlet", "settlement", "harbour", "island", "forest", "cabins",
     "houses", "towers"});
// Beside these "flat" is how land lies.
inline constexpr auto kLandWords = std::to_array<std::string_view>(
    {"slope", "hill", "hills", "hilltop", "castle", "roofs", "terrain", "land", "landscape", "ha", "hectares", "campus", "park", "trees",
     "sea", "coast"});
// Of which no inside is made.
inline constexpr auto kOtherBuildings = std::to_array<std::string_view>({"hospital", "school", "hotel", "museum", "theatre", "theater", "cinema", "airport", "stadium",
                                   "supermarket", "restaurant", "gym", "prison", "hangar", "bank", "laboratory", "clinic", "kindergarten",
                                   "factory", "workshop", "studio", "shop", "gallery", "gymnasium", "hostel", "arena"});
inline constexpr auto kStoreyWords = std::to_array<std::string_view>({"storey", "storeys", "story", "stories", "storied", "floor", "floors", "level", "levels", "deck", "decks"});
inline constexpr auto kPeopleWords = std::to_array<std::string_view>({"people", "persons", "visitors", "workers", "shoppers", "readers"});
inline constexpr auto kBounds = std::to_array<std::string_view>({"over", "under", "above", "below", "at", "least", "most", "up", "to", "more", "less", "fewer", "than",
                           "between", "minus", "many", "few", "mostly"});
inline constexpr auto kDenials = std::to_array<std::string_view>({"no", "without", "not", "free"});
inline constexpr auto kLightWords = std::to_array<std::string_view>({"night", "day", "evening", "morning", "dusk", "sunset", "fog", "foggy", "rain", "rainy", "snow", "snowy",
                               "sunny", "dark", "winter", "summer", "autumn", "spring"});
// clang-format on

// What a word sets; two that set one key must agree.
struct Setting {
  std::string_view words, as;
  void (*set)(BuildingSpec&);
  std::array<std::string_view, 2> keys;  ///< "clutter=0"
};
inline constexpr auto kSettings = std::to_array<Setting>({
    {"atrium", "atrium: true", [](BuildingSpec& s) { s.atrium = true; }, {"atrium=true"}},
    {"cluttered", "clutter: 1.5", [](BuildingSpec& s) { s.clutter = 1.5; }, {"clutter=1.5", "furnished=true"}},
    {"messy", "clutter: 1.5", [](BuildingSpec& s) { s.clutter = 1.5; }, {"clutter=1.5", "furnished=true"}},
    {"busy", "clutter: 1.3", [](BuildingSpec& s) { s.clutter = 1.3; }, {"clutter=1.3", "furnished=true"}},
    {"tidy", "clutter: 0", [](BuildingSpec& s) { s.clutter = 0; }, {"clutter=0", "furnished=true"}},
    {"furnished", "furnished: true", [](BuildingSpec& s) { s.furnished = true; }, {"furnished=true"}},
    {"unfurnished", "furnished: false", [](BuildingSpec& s) { s.furnished = false; }, {"furnished=false"}},
    {"empty", "furnished: false", [](BuildingSpec& s) { s.furnished = false; }, {"furnished=false"}},
    {"half open doors", "open_doors: 0.5", [](BuildingSpec& s) { s.open_doors = 0.5; }, {"doors=0.5"}},
    {"doors half open", "open_doors: 0.5", [](BuildingSpec& s) { s.open_doors = 0.5; }, {"doors=0.5"}},
    {"open doors", "open_doors: 1", [](BuildingSpec& s) { s.open_doors = 1; }, {"doors=1"}},
    {"doors open", "open_doors: 1", [](BuildingSpec& s) { s.open_doors = 1; }, {"doors=1"}},
    {"all doors open", "open_doors: 1", [](BuildingSpec& s) { s.open_doors = 1; }, {"doors=1"}},
    {"no closed doors", "open_doors: 1", [](BuildingSpec& s) { s.open_doors = 1; }, {"doors=1"}},
    {"closed doors", "open_doors: 0", [](BuildingSpec& s) { s.open_doors = 0; }, {"doors=0"}},
    {"doors closed", "open_doors: 0", [](BuildingSpec& s) { s.open_doors = 0; }, {"doors=0"}},
    {"all doors closed", "open_doors: 0", [](BuildingSpec& s) { s.open_doors = 0; }, {"doors=0"}},
    {"no open doors", "open_doors: 0", [](BuildingSpec& s) { s.open_doors = 0; }, {"doors=0"}},
    {"no atrium", "atrium: false", [](BuildingSpec& s) { s.atrium = false; }, {"atrium=false"}},
    {"no clutter", "clutter: 0", [](BuildingSpec& s) { s.clutter = 0; }, {"clutter=0"}},
    {"no furniture", "furnished: false", [](BuildingSpec& s) { s.furnished = false; }, {"furnished=false"}},
});
// Small ones have the least sides of the use, large ones 1.4 times the usual.
inline constexpr auto kSmall = std::to_array<std::string_view>({"small", "little", "tiny"});
inline constexpr auto kLarge = std::to_array<std::string_view>({"large", "big", "huge", "spacious"});

// What buildings of a use have in any case, and so can be said.
struct Part {
  std::string_view words;
  unsigned uses;                        ///< their bits
  bool storeys = false, loose = false;  ///< needs two storeys; gone where unfurnished
};
// Bits of uses.
inline constexpr unsigned kHome = 1, kOffices = 2, kHalls = 4, kMalls = 8, kDecksOfCars = 16, kLibraries = 32;
inline constexpr auto kParts = std::to_array<Part>({{"furniture", kHome | kOffices | kHalls | kMalls | kLibraries, false, true},
                                                    {"lamp", kHome | kOffices | kHalls | kMalls | kDecksOfCars | kLibraries},
                                                    {"living room", kHome},
                                                    {"dining room", kHome},
                                                    {"kitchen", kHome},
                                                    {"bedroom", kHome},
                                                    {"bathroom", kHome},
                                                    {"meeting room", kOffices},
                                                    {"pantry", kOffices},
                                                    {"desk", kOffices, false, true},
                                                    {"pallet rack", kHalls, false, true},
                                                    {"rack", kHalls, false, true},
                                                    {"goods", kHalls, false, true},
                                                    {"forklift", kHalls, false, true},
                                                    {"shop", kMalls},
                                                    {"supermarket", kMalls},
                                                    {"food court", kMalls},
                                                    {"escalator", kMalls, true},
                                                    {"car", kDecksOfCars, false, true},
                                                    {"parked car", kDecksOfCars, false, true},
                                                    {"ramp", kDecksOfCars, true},
                                                    {"lift", kOffices | kMalls | kLibraries},
                                                    {"stairs", kOffices | kMalls | kLibraries, true},
                                                    {"reading room", kLibraries},
                                                    {"book stack", kLibraries}});

}  // namespace airsim360::building_tables
