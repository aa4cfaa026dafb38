// The words of numbers, limits and units.
#pragma once

#include <span>
#include <string_view>
#include <utility>

#include "airsim360/worlds/words/word_tokens.h"

namespace airsim360::internal {

using NumberWord = std::pair<std::string_view, double>;

std::span<const NumberWord> NumberUnits();  ///< one … nine
std::span<const NumberWord> NumberTeens();  ///< zero, ten … nineteen
std::span<const NumberWord> NumberTens();   ///< twenty … ninety
std::span<const NumberWord> NumberLots();   ///< dozen, hundred, thousand: they multiply
/// "couple of": 2. Phrases.
std::span<const NumberWord> NumberPhrases();
std::span<const NumberWord> LengthUnits();
std::span<const NumberWord> AreaUnits();

using LimitWords = std::pair<std::string_view, NumberLimit>;
std::span<const LimitWords> LimitsBefore();
std::span<const LimitWords> LimitsBehind();
/// "about", "roughly": they change nothing.
std::span<const std::string_view> AboutWords();
/// Whether "twenty two" before it is 20 two-storey ones.
bool IsStoreyWord(std::string_view plain);

}  // namespace airsim360::internal
