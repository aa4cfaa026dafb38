// The words of a description, with the numbers among them: one reader for towns and buildings.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace airsim360::internal {

/// What stands before or behind a number: "at least 3", "3 or more", "< 3".
enum class NumberLimit { kNone, kAtLeast, kMost, kOver, kUnder };

struct WordToken {
  std::string text, plain;              ///< as written in lower case, without accents; the same, singular
  std::optional<double> number, upper;  ///< upper: of a range, "3 to 5"
  NumberLimit limit = NumberLimit::kNone;
  bool breaks = false;  ///< a comma, colon or the like stands before it
};

/// A number is one token with all that belongs to it: "two hundred", "about 40", "at least three", "3-5", "between 3 and 5",
/// "a couple of dozen", "1/2". "40ha" is two. A minus sign before a digit belongs to the number; signs that mean nothing in words
/// are tokens of their own.
std::vector<WordToken> WordTokens(std::string_view description);

/// The texts (or the plain ones) of n tokens from i on, with blanks between.
std::string JoinedTokens(const std::vector<WordToken>& tokens, size_t i, size_t n, bool plain = false);

/// Metres that a unit of length has; 0: no unit.
double MetresOf(std::string_view plain);
/// Square metres that the unit of area at i has, and its words; 0 words: no unit.
std::pair<double, size_t> SquareMetresAt(const std::vector<WordToken>& tokens, size_t i);

}  // namespace airsim360::internal
