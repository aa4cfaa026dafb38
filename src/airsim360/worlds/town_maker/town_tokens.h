// The words of a description, with the numbers among them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360::internal {

struct TownToken {
  std::string text, plain;  ///< as written in lower case, without accents; the same, singular
  std::optional<double> number;
  bool breaks = false;  ///< a comma, colon or the like stands before it
};

/// "two hundred" is one token, "40ha" are two. A minus sign before a digit belongs to the number.
std::vector<TownToken> TownTokens(std::string_view description);

}  // namespace airsim360::internal
