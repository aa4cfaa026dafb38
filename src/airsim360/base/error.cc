#include "airsim360/base/error.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace airsim360 {
namespace {

// Levenshtein distance, ignoring case; one row of the table at a time.
size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const bool same = std::tolower(static_cast<unsigned char>(a[i - 1])) ==
                        std::tolower(static_cast<unsigned char>(b[j - 1]));
      const size_t substitute = diagonal + (same ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string NearestChoice(std::string_view word, std::span<const std::string> choices) {
  const std::string_view bounded = word.substr(0, 256);
  const auto best = std::min_element(choices.begin(), choices.end(), [&](const auto& a, const auto& b) {
    return EditDistance(bounded, a) < EditDistance(bounded, b);
  });
  return best == choices.end() ? std::string() : *best;
}

std::string UnknownChoiceMessage(std::string_view what, std::string_view word,
                                 std::span<const std::string> choices) {
  std::string message = "unknown " + std::string(what) + " '" + std::string(word.substr(0, 256)) + "'";
  if (choices.empty()) return message;
  message += "; did you mean '" + NearestChoice(word, choices) + "'? (choices: ";
  for (size_t i = 0; i < choices.size(); ++i) message += (i ? ", " : "") + choices[i];
  return message + ")";
}

}  // namespace airsim360
