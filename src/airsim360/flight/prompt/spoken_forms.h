// Ways of writing that are spelt out before a description is cut into tokens.
#pragma once

#include <string>

namespace airsim360::internal {

/// `plain` (PlainText) without tolerances, with the symbols of papers and short forms spelt out: "l = 0.2 m"
/// as an arm length, "sub-250" as under 250 g, "props? 11 inch" as props 11 inch.
std::string SpeltOut(const std::string& plain);

}  // namespace airsim360::internal
