// Sets of episodes over many worlds by one name.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "airsim360/vln/episodes/make_episodes.h"

namespace airsim360 {

inline constexpr const char* kVlnRecipes[] = {"omni360-vln"};

/// What is to be made, world by world, in order; `open` is left to the caller. Of `known` worlds, those that are no towns or rooms for
/// tests. "omni360-vln": instructions `any` in all of them, the paper's 37 in its two cities; more than 10,000 episodes; two worlds are
/// in no other split than val_unseen. InputError naming --recipe.
std::vector<VlnMakeOptions> VlnRecipe(const std::string& name, std::span<const std::string> known);

}  // namespace airsim360
