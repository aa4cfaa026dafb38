#include "airsim360/vln/episodes/recipe.h"

#include <algorithm>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// Rooms and towns for tests, and the town of one's own measures.
constexpr const char* kNoWorlds[] = {"box_room", "sunlit_room", "town", "building"};
constexpr const char* kUnseen[] = {"rome", "warehouse"};
constexpr const char* kCities[] = {"downtown_west", "new_york_city", "new_york_city_1950s"};

template <size_t kCount>
bool IsOneOf(const std::string& name, const char* const (&names)[kCount]) {
  return std::ranges::find(names, name) != std::end(names);
}

}  // namespace

std::vector<VlnMakeOptions> VlnRecipe(const std::string& name, std::span<const std::string> known) {
  const std::vector<std::string> recipes(std::begin(kVlnRecipes), std::end(kVlnRecipes));
  if (std::ranges::find(recipes, name) == recipes.end()) throw InputError("--recipe: " + UnknownChoiceMessage("recipe", name, recipes));
  std::vector<VlnMakeOptions> all;
  for (const std::string& world : known) {
    if (IsOneOf(world, kNoWorlds)) continue;
    const std::string split = IsOneOf(world, kUnseen) ? "val_unseen" : "";
    all.push_back({.world = world, .templates = "any", .starts = 3, .seeds = 1, .weather = "mix", .split = split});
    if (IsOneOf(world, kCities))
      all.push_back({.world = world, .templates = "paper37", .starts = 3, .seeds = 3, .weather = "mix", .split = split});
  }
  return all;
}

}  // namespace airsim360
