// The name that a user meant: by letters, by parts of the name and by meaning.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace airsim360 {

/// "; did you mean 'x'?" for the nearest choice (NearestChoice of base/error.h), or "" where nothing is near.
std::string DidYouMean(std::string_view word, std::span<const std::string> choices);

namespace internal {

/// Edits (a letter more, less, other, or two neighbours swapped) from `a` to `b`.
size_t EditDistance(std::string_view a, std::string_view b);

/// Whether both mean the same thing here: words of one row of the table of synonyms, as NearestChoice
/// compares them (lower case, letters and digits only, singular).
bool SameMeaning(std::string_view a, std::string_view b);

}  // namespace internal
}  // namespace airsim360
