// Numbers in digits and in words.
#pragma once

#include <string_view>
#include <vector>

#include "airsim360/flight/prompt/tokens.h"

namespace airsim360::internal {

/// A plain decimal number at the start ("16,000", "1,2" and "1.2" alike); its length, 0 if there is none.
/// InputError beyond 1e9.
size_t ReadNumber(std::string_view text, double& value);

/// "5x4.3x3" or "10x4.5" at the start, of a propeller's size.
bool ReadPropellerCode(std::string_view text, double (&code)[3], size_t& length);

/// How many characters at the start are the sides of a box ("60x40x30 cm", "3 m x 3 m", "30.5x30.5mm"), which
/// is no figure of a drone; 0: none.
size_t BoxLength(std::string_view text);

/// "9450", "1045", "51466" as diameter and pitch in inches; false where the figures are no propeller's.
bool ReadPropellerFigures(std::string_view digits, double (&code)[3]);

/// Puts number words ("two and a half", "half a"), ranges ("25-30", "4 to 5") and fractions together.
std::vector<Token> JoinNumbers(std::vector<Token> tokens);

/// How many more characters of `text` belong to the number of `length` characters that it begins with, for thousands
/// set apart by a space, an apostrophe or a point before a small unit: "1 500 g", "22'000 mAh", "1.500 g". Makes
/// `value` that number; "2,500 kg" is two and a half, for no drone has tonnes.
size_t ReadThousands(std::string_view text, size_t length, double& value);

inline bool IsDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace airsim360::internal
