#include "airsim360/worlds/surface_recipes.h"

#include "airsim360/worlds/recipe_shapes.h"

namespace airsim360::internal {

TextureRecipe MakeRecipe(Recipe recipe) {
  switch (recipe) {
    case Recipe::kAsphalt:
      return {"asphalt", 3, 0.125f, Asphalt};
    case Recipe::kConcrete:
      return {"concrete", 3, 0.5f, Concrete};
    case Recipe::kSlabs:
      return {"slabs", 3, 0.32f, Slabs};
    case Recipe::kPavingBrick:
      return {"paving brick", 2, 0.165f, PavingBrick};
    case Recipe::kStoneSetts:
      return {"stone setts", 2, 0.36f, StoneSetts};
    case Recipe::kGravelPath:
      return {"gravel path", 3, 0.33f, GravelPath};
    case Recipe::kGrass:
      return {"grass", 4, 0.145f, Grass};
    case Recipe::kSoil:
      return {"soil", 3, 0.14f, Soil};
    case Recipe::kBrick:
      return {"brick", 2, 0.5f, Brick};
    case Recipe::kAshlar:
      return {"ashlar", 3, 0.5f, Ashlar};
    case Recipe::kPlaster:
      return {"plaster", 4, 0.5f, Plaster};
    case Recipe::kPlanks:
      return {"planks", 2, 0.5f, Planks};
    case Recipe::kRoofGravel:
      return {"roof gravel", 3, 0.2f, RoofGravel};
    case Recipe::kRoofTile:
      return {"roof tile", 2.4f, 0.26f, RoofTile};
    case Recipe::kStripes:
      return {"stripes", 1.6f, 0.5f, Stripes};
    case Recipe::kFarWalls:
      return {"far walls", 12, 0.42f, FarWalls};
    case Recipe::kRock:
      return {"rock", 900, 0.12f, Rock};
    case Recipe::kFields:
      return {"fields", 2400, 0.13f, Fields};
    case Recipe::kShop0:
      return {"shop 0", 1, 0.17f, [](float u, float v) { return Shop(u, v, 0); }};
    case Recipe::kShop1:
      return {"shop 1", 1, 0.17f, [](float u, float v) { return Shop(u, v, 1); }};
    case Recipe::kShop2:
      return {"shop 2", 1, 0.17f, [](float u, float v) { return Shop(u, v, 2); }};
    case Recipe::kSigns:
      return {"signs", 1, 0.22f, Sign};
    case Recipe::kPaintWorn:
      return {"road paint", 2, 0.5f, PaintWorn};
    default:
      return {"plain", 1, 0.5f, [](float, float) { return Texel{}; }};
  }
}

}  // namespace airsim360::internal
