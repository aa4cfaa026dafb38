// German, French, Spanish and Italian number words of more than one part.
#pragma once

#include <string>

namespace airsim360::internal {

/// Plain text with such numbers in digits: "zweieinhalb kilo" is "2.5 kilo", "mil quinientos gramos" is "1500 gramos", "quatre-vingt-dix"
/// is "90", "kilo y medio" is "1.5 kilo". Single words ("vier", "vingt") are the lexicon's, unless a half follows their unit.
std::string WithForeignNumbers(const std::string& plain);

}  // namespace airsim360::internal
