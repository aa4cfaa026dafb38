// A town from words: each word is understood, is filler, or is an error.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "airsim360/worlds/town_spec.h"

namespace airsim360 {

/// Some words of a description and what became of them: a setting as a world file has it, or "filler".
struct UnderstoodWords {
  std::string words, as;
};

/// Something that words asked for and a town may turn out to have no room for.
struct TownPromise {
  std::string words, setting;
  uint64_t count = 1;  ///< at least
};

struct TownRequest {
  TownSpec spec;
  uint64_t people = 0;                                      ///< who walk outside
  std::string weather;                                      ///< a preset of environment:, "" = the world's own
  std::vector<std::pair<std::string, double>> environment;  ///< keys of environment: over the preset
  std::vector<UnderstoodWords> words;                       ///< in order; together all of the description
  std::vector<TownPromise> promises;
  bool sized = false;  ///< numbers gave the sides
};

/// What a description of up to 1,000 characters says. InputError for a word that means nothing here (naming the nearest
/// that does), words that exclude each other (naming both), and numbers out of bounds.
TownRequest TownFromWords(std::string_view description);

/// Draws the town of a seed and sees that it has what the words asked for. A castle gets wider blocks and houses a larger
/// town where they had no room; both are added to the words. InputError, naming the words, for what is still missing.
void SettleTown(TownRequest& request, uint64_t seed);

}  // namespace airsim360
