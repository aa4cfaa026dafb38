// Which nouns an adjective of the lexicon may be said of: "tall houses", not "tall trees".
#pragma once

#include <string>
#include <vector>

#include "airsim360/worlds/town_maker/town_lexicon.h"
#include "airsim360/worlds/words/word_tokens.h"

namespace airsim360::internal {

/// The noun that the words from `at` on speak of: the last of the nouns in a row, behind other adjectives; "" where no
/// noun follows.
struct TownNoun {
  unsigned kind = 0;
  size_t end = 0;  ///< token behind it
};
TownNoun NounAfter(const std::vector<WordToken>& tokens, size_t at);

/// Whether a word on `subject` suits the noun; true where there is none. `of`: what it suits, for an error.
bool Suits(std::string_view subject, const TownNoun& noun, std::string& of);

}  // namespace airsim360::internal
