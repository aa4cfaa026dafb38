// Recipes of the tiling textures; albedo, roughness and slope follow measured scans of the same materials.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "airsim360/worlds/texture/texture_synth.h"

namespace airsim360::internal {

enum class Recipe {
  kAsphalt,
  kAsphaltFresh,
  kBitumen,
  kConcrete,
  kSlabs,
  kPavingBrick,
  kStoneSetts,
  kGravelPath,
  kGrass,
  kSoil,
  kForestFloor,
  kBrickRed,
  kBrickStock,
  kBrickPainted,
  kAshlar,
  kPlaster,
  kPlanks,
  kRoofGravel,
  kRoofTile,
  kSlate,
  kGalvanised,
  kPaintWorn,
  kStripes,
  kFarWalls,
  kFarPiers,
  kFarRibbons,
  kRock,
  kFields,
  kShop0,
  kShop1,
  kShop2,
  kCount,
  kNone
};

/// The recipe of a texture; kNone is not allowed.
TextureRecipe MakeRecipe(Recipe recipe);
/// What shines on the tile by night, for emission; nullopt for recipes of which nothing does but their own picture.
std::optional<Texture> MakeNightLights(Recipe recipe);
/// Texels a side that the worlds use: 2 to 6 mm a texel for grounds and walls.
int SizeOf(Recipe recipe);

/// What scans of the material show (docs/internals/materials.md, "Materials"): the means that the recipe is brought to,
/// and the bands within which the recipe itself must come out before that. `deviation` is of the luminance,
/// `spread` of roughness; the scans' own values where the table has them. Negative = not known.
struct MaterialTarget {
  Recipe recipe;
  float luminance, deviation, roughness, spread, slope;
};
std::span<const MaterialTarget> MaterialTargets();

}  // namespace airsim360::internal
