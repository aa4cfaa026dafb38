// A word out of a few.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360 {

/// Index of `word` among `choices`. InputError "unknown WHAT 'WORD'; did you mean …" for any other, after
/// "WHERE: " if a flag or a field is named.
inline size_t ParseChoice(std::string_view what, std::string_view word, std::span<const std::string> choices, std::string_view where = {}) {
  for (size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == word) return i;
  }
  const std::string prefix = where.empty() ? "" : std::string(where) + ": ";
  throw InputError(prefix + UnknownChoiceMessage(what, word, choices));
}

/// The same for names that stand in the source.
inline size_t ParseChoice(std::string_view what, std::string_view word, std::span<const char* const> names, std::string_view where = {}) {
  return ParseChoice(what, word, std::vector<std::string>(names.begin(), names.end()), where);
}

/// The same for the enumerators of `Enum`, which are named in their order.
template <class Enum, size_t kCount>
Enum ParseChoice(std::string_view what, std::string_view word, const char* const (&names)[kCount], std::string_view where = {}) {
  return static_cast<Enum>(ParseChoice(what, word, std::span<const char* const>(names), where));
}

}  // namespace airsim360
