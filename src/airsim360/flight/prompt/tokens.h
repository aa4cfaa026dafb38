// A description cut into words, numbers and names of real drones.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/flight/prompt/known_models.h"
#include "airsim360/flight/prompt/lexicon.h"

namespace airsim360::internal {

struct Token {
  enum class Kind {
    kWord,           ///< of the lexicon
    kNumber,         ///< digits or number words, put together
    kPropellerCode,  ///< "5x4.3x3"
    kModel,
    kUnknown,
    kComma,  ///< any sign that ends a phrase
    kDash,
  };
  Kind kind = Kind::kUnknown;
  std::string text;                   ///< as written, in lower case
  double value = 0;                   ///< of a number
  double low = 0, high = 0;           ///< of a range of numbers, else both 0
  bool negative = false;              ///< a number with a minus before it
  bool glued = false;                 ///< written onto what is before it
  const Word* word = nullptr;         ///< of a word
  const KnownModel* model = nullptr;  ///< of a model
  double code[3] = {};                ///< of a propeller code: inches, inches, blades (0 = not said)
  std::string respelled;              ///< the word that a misspelt one is read as

  bool Is(WordKind word_kind) const { return kind == Kind::kWord && word->kind == word_kind; }
  /// Whether it counts several things: a whole number from 2 to `most`.
  bool Counts(double most) const { return kind == Kind::kNumber && value >= 2 && value <= most && value == std::floor(value); }
};

inline bool IsOneOf(std::string_view text, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return text == word; });
}
inline bool StartsAny(std::string_view text, std::initializer_list<const char*> stems) {
  return std::any_of(stems.begin(), stems.end(), [&](const char* stem) { return text.starts_with(stem); });
}
/// "incl", "including", "inkl"
inline bool MeansIncluding(std::string_view text) { return text.starts_with("incl") || text == "inkl"; }

/// InputError for a description of more than 1000 bytes and for a number beyond 1e9.
std::vector<Token> Tokenize(std::string_view prompt);

}  // namespace airsim360::internal
