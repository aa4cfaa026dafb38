// A town from words: each word is understood, is filler, or is an error.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/worlds/town_spec.h"

namespace airsim360 {

/// Some words of a description and what became of them: a setting as a world file has it, or "filler".
struct UnderstoodWords {
  std::string words, as;
};

struct TownRequest {
  TownSpec spec;
  uint64_t people = 0;                 ///< who walk outside
  std::string weather;                 ///< a preset of environment:, "" = the world's own
  std::vector<UnderstoodWords> words;  ///< in order; together all of the description
};

/// What a description of up to 1,000 characters says. InputError for a word that means nothing here (naming the nearest
/// that does), words that exclude each other (naming both), and numbers out of bounds.
TownRequest TownFromWords(std::string_view description);

}  // namespace airsim360
