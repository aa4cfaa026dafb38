#include "airsim360/worlds/words/number_words.h"

#include <algorithm>
#include <array>

namespace airsim360::internal {
namespace {

using L = NumberLimit;
constexpr double kFoot = 0.3048, kYard = 0.9144, kMile = 1609.344, kAcre = 4046.9;

// One word a line would hide them.
// clang-format off
constexpr auto kUnits = std::to_array<NumberWord>(
    {{"one", 1}, {"single", 1}, {"two", 2}, {"three", 3}, {"four", 4}, {"five", 5}, {"six", 6}, {"seven", 7}, {"eight", 8}, {"nine", 9}});
constexpr auto kTeens = std::to_array<NumberWord>(
    {{"zero", 0}, {"ten", 10}, {"eleven", 11}, {"twelve", 12}, {"thirteen", 13}, {"fourteen", 14}, {"fifteen", 15}, {"sixteen", 16},
     {"seventeen", 17}, {"eighteen", 18}, {"nineteen", 19}});
constexpr auto kTens = std::to_array<NumberWord>(
    {{"twenty", 20}, {"thirty", 30}, {"forty", 40}, {"fifty", 50}, {"sixty", 60}, {"seventy", 70}, {"eighty", 80}, {"ninety", 90}});
constexpr auto kLots = std::to_array<NumberWord>({{"dozen", 12}, {"hundred", 100}, {"thousand", 1000}});
constexpr auto kPhrases = std::to_array<NumberWord>(
    {{"couple of", 2}, {"pair of", 2}, {"half a dozen", 6}, {"half dozen", 6}});
constexpr auto kLengths = std::to_array<NumberWord>(
    {{"m", 1}, {"metre", 1}, {"meter", 1}, {"km", 1000}, {"kilometre", 1000}, {"kilometer", 1000}, {"ft", kFoot}, {"foot", kFoot},
     {"feet", kFoot}, {"yd", kYard}, {"yard", kYard}, {"mi", kMile}, {"mile", kMile}});
constexpr auto kAreas = std::to_array<NumberWord>(
    {{"ha", 1e4}, {"hectare", 1e4}, {"acre", kAcre}, {"km2", 1e6}, {"sqkm", 1e6}, {"m2", 1}, {"sqm", 1}, {"ft2", kFoot * kFoot},
     {"sqft", kFoot * kFoot}, {"mi2", kMile * kMile}, {"sqmi", kMile * kMile}});
constexpr auto kBefore = std::to_array<LimitWords>(
    {{"at least", L::kAtLeast}, {"no fewer than", L::kAtLeast}, {"no less than", L::kAtLeast}, {"minimum", L::kAtLeast},
     {"a minimum of", L::kAtLeast}, {"minimum of", L::kAtLeast}, {"min", L::kAtLeast}, {"at most", L::kMost}, {"up to", L::kMost},
     {"maximum", L::kMost}, {"a maximum of", L::kMost}, {"maximum of", L::kMost}, {"max", L::kMost}, {"no more than", L::kMost},
     {"not more than", L::kMost}, {"no taller than", L::kMost}, {"no higher than", L::kMost}, {"over", L::kOver}, {"above", L::kOver},
     {"more than", L::kOver}, {"taller than", L::kOver}, {"higher than", L::kOver}, {">", L::kOver}, {"under", L::kUnder},
     {"below", L::kUnder}, {"less than", L::kUnder}, {"fewer than", L::kUnder}, {"lower than", L::kUnder}, {"<", L::kUnder},
     {"<=", L::kMost}, {">=", L::kAtLeast}});
constexpr auto kBehind = std::to_array<LimitWords>(
    {{"or more", L::kAtLeast}, {"and more", L::kAtLeast}, {"and up", L::kAtLeast}, {"or less", L::kMost}, {"or fewer", L::kMost},
     {"at most", L::kMost}, {"at least", L::kAtLeast}, {"maximum", L::kMost}, {"max", L::kMost}, {"minimum", L::kAtLeast},
     {"min", L::kAtLeast}, {"or so", L::kNone}});
constexpr auto kAbout = std::to_array<std::string_view>(
    {"about", "around", "approximately", "approx", "roughly", "circa", "ca", "nearly", "almost", "exactly", "some", "~"});
constexpr auto kStoreys = std::to_array<std::string_view>({"storey", "story", "floor", "level", "storeyed", "storied"});
// clang-format on

}  // namespace

std::span<const NumberWord> NumberUnits() { return kUnits; }
std::span<const NumberWord> NumberTeens() { return kTeens; }
std::span<const NumberWord> NumberTens() { return kTens; }
std::span<const NumberWord> NumberLots() { return kLots; }
std::span<const NumberWord> NumberPhrases() { return kPhrases; }
std::span<const NumberWord> LengthUnits() { return kLengths; }
std::span<const NumberWord> AreaUnits() { return kAreas; }
std::span<const LimitWords> LimitsBefore() { return kBefore; }
std::span<const LimitWords> LimitsBehind() { return kBehind; }
std::span<const std::string_view> AboutWords() { return kAbout; }
bool IsStoreyWord(std::string_view plain) { return std::find(kStoreys.begin(), kStoreys.end(), plain) != kStoreys.end(); }

}  // namespace airsim360::internal
