// A prompt cut into words and numbers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "airsim360/flight/prompt/lexicon.h"

namespace airsim360::internal {

struct Token {
  enum class Kind { kWord, kNumber, kComma, kPropellerCode };
  Kind kind = Kind::kWord;
  std::string text;            ///< as written
  double value = 0;            ///< of a number
  const Word* word = nullptr;  ///< of a word
  double code[3] = {};         ///< "5x4.3x3": diameter and pitch in inches, blades (0 = not said)
};

/// InputError for a character or word that is not understood, a negative or a too large number.
std::vector<Token> Tokenize(std::string_view prompt);

}  // namespace airsim360::internal
