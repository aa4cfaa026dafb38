// The recipes that come with the program: the paper's three sets, a million frames, and a small release.
#pragma once

#include <string>
#include <vector>

#include "airsim360/dataset/plan/recipe.h"

namespace airsim360::internal {

std::vector<std::string> BuiltInRecipeNames();
/// `name` is one of them.
Recipe BuiltInRecipe(const std::string& name);
/// The mixtures that recipes without their own have: `varied` (all weathers, by day and night) and `fair`.
std::vector<SkyMixture> BuiltInSkies();

}  // namespace airsim360::internal
