// Recipes of the tiling textures; albedo and roughness follow measured scans of the same materials.
#pragma once

#include <vector>

#include "airsim360/worlds/texture_synth.h"

namespace airsim360::internal {

enum class Recipe {
  kAsphalt,
  kConcrete,
  kSlabs,
  kPavingBrick,
  kStoneSetts,
  kGravelPath,
  kGrass,
  kSoil,
  kBrick,
  kAshlar,
  kPlaster,
  kPlanks,
  kRoofGravel,
  kRoofTile,
  kStripes,
  kFarWalls,
  kRock,
  kFields,
  kShop0,
  kShop1,
  kShop2,
  kSigns,
  kPaintWorn,
  kCount,
  kNone
};

/// The recipe of a texture; kNone is not allowed.
TextureRecipe MakeRecipe(Recipe recipe);

}  // namespace airsim360::internal
