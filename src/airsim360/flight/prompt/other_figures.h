// Figures of other things than the drone that is described: of what its sensors measure, of the drone as it was, of
// another drone beside it, of cases and persons.
#pragma once

#include <vector>

#include "airsim360/flight/prompt/tokens.h"

namespace airsim360::internal {

/// The tokens with each such figure and its unit as one unknown word, which says nothing. What is left out are lengths,
/// times and speeds that belong to a sensor or a place by the words around them ("12 cm baseline", "every 0.8 s",
/// "1 m above the snow"), what was before a change ("used to run 4S"), what a case holds or a person weighs.
std::vector<Token> WithoutOtherFigures(std::vector<Token> tokens);

/// Units that stand apart from their numbers: "seventeen kg, no wait, eighteen", "one hour twenty", "wheelbase 17, props 9,
/// both in inches".
std::vector<Token> WithBorrowedUnits(std::vector<Token> tokens);

}  // namespace airsim360::internal
