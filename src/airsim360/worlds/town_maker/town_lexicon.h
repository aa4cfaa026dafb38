// The words that describe towns.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>

#include "airsim360/worlds/town_maker/town_words.h"

namespace airsim360::internal {

/// A later level overrides an earlier one.
enum class WordLevel { kKind, kPlace, kSaid };

struct TownDraft {
  TownSpec spec;
  double scale = 1;         ///< of the sides, of "small" and the like
  double people_share = 0;  ///< of what a town of the size usually has; < 0: nobody
  bool hilly = false;
  std::string time;            ///< of day: a preset of environment:, "dawn" or "sunrise"
  std::set<std::string> airs;  ///< presets of which clouds, fog, rain and snow are taken
};

struct TownWord {
  std::string_view phrase;  ///< words in lower case and singular, parted by spaces
  WordLevel level;
  std::string_view subject;  ///< what it speaks about: two words of one subject and level must mean the same
  std::string_view means;    ///< as a world file says it; "" = filler
  void (*apply)(TownDraft&);
  /// Whether a draft is as the word says; nullptr: applying it changes nothing.
  bool (*holds)(const TownDraft&) = nullptr;
};
std::span<const TownWord> TownWords();

/// What can be few, many or none: trees, cars, people …; `amount` 0 none, 0.4 few, 1 usual, 1.5 many.
struct TownStuff {
  std::string_view noun, setting;
  void (*set)(TownDraft&, double amount);
};
std::span<const TownStuff> TownStuffs();

/// What is there or not, and may be denied ("no church").
struct TownThing {
  std::string_view noun, setting;
  bool TownSpec::*field;
};
std::span<const TownThing> TownThings();

}  // namespace airsim360::internal
