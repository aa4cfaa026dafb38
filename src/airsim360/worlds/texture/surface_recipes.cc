#include "airsim360/worlds/texture/surface_recipes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "airsim360/image/color.h"
#include "airsim360/worlds/texture/recipe_shapes.h"

namespace airsim360::internal {
namespace {

using R = Recipe;

// Luminance 0.5 marks wall textures that are multiplied by the colour of a paint or stone.
constexpr MaterialTarget kTargets[] = {
    {R::kAsphalt, 0.120f, 0.035f, 0.66f, 0.06f, 0.55f},
    {R::kAsphaltFresh, 0.052f, 0.010f, 0.65f, 0.05f, 0.55f},
    {R::kBitumen, 0.120f, 0.035f, 0.65f, 0.07f, 0.40f},
    {R::kConcrete, 0.480f, 0.033f, 0.52f, 0.02f, 0.13f},
    {R::kSlabs, 0.360f, 0.055f, 0.58f, 0.05f, 0.27f},
    {R::kPavingBrick, 0.165f, 0.040f, 0.60f, 0.06f, 0.40f},
    {R::kStoneSetts, 0.330f, 0.090f, 0.58f, 0.08f, 0.50f},
    {R::kGravelPath, 0.260f, 0.075f, 0.53f, 0.08f, 0.75f},
    {R::kGrass, 0.145f, 0.050f, 0.62f, 0.06f, 0.48f},
    {R::kSoil, 0.140f, 0.035f, 0.67f, 0.05f, 0.45f},
    {R::kBrickRed, 0.200f, 0.080f, 0.58f, 0.06f, 0.44f},
    {R::kBrickStock, 0.250f, 0.060f, 0.58f, 0.06f, 0.44f},
    {R::kBrickPainted, 0.520f, 0.120f, 0.56f, 0.06f, 0.36f},
    {R::kAshlar, 0.500f, 0.055f, 0.60f, 0.06f, 0.30f},
    {R::kPlaster, 0.500f, 0.035f, 0.55f, 0.05f, 0.17f},
    {R::kPlanks, 0.500f, 0.120f, 0.62f, 0.06f, 0.40f},
    {R::kRoofGravel, 0.180f, 0.055f, 0.52f, 0.08f, 0.85f},
    {R::kRoofTile, 0.260f, 0.090f, 0.52f, 0.06f, 1.00f},
    {R::kSlate, 0.048f, 0.012f, 0.65f, 0.10f, 0.80f},
    {R::kGalvanised, 0.420f, 0.035f, 0.36f, 0.06f, 0.03f},
    {R::kPaintWorn, 0.500f, 0.130f, 0.58f, 0.06f, 0.40f},
};

TextureRecipe Painted(const char* name, float tile, Recipe recipe, void (*paint)(SurfaceMaps&)) {
  for (const MaterialTarget& t : kTargets) {
    if (t.recipe == recipe) return {name, tile, t.luminance, nullptr, paint, t.roughness, t.slope};
  }
  return {name, tile, 0.5f, nullptr, paint};
}

}  // namespace

std::span<const MaterialTarget> MaterialTargets() { return kTargets; }

std::optional<Texture> MakeNightLights(Recipe recipe) {
  struct Wall {
    Recipe recipe;
    Texel (*texel)(float u, float v);
    int columns, rows;
  };
  static constexpr Wall kWalls[] = {{R::kFarWalls, FarWalls, 8, 8}, {R::kFarPiers, FarPiers, 12, 7}, {R::kFarRibbons, FarRibbons, 16, 7}};
  const auto* wall = std::find_if(std::begin(kWalls), std::end(kWalls), [&](const Wall& w) { return w.recipe == recipe; });
  if (wall == std::end(kWalls)) return std::nullopt;
  constexpr int kSize = 512;
  Image<Rgba8> lights(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Vec3f c = FarLights(wall->texel, wall->columns, wall->rows, (static_cast<float>(x) + 0.5f) / kSize, (static_cast<float>(y) + 0.5f) / kSize);
      lights(x, y) = {LinearToSrgb8(c.x), LinearToSrgb8(c.y), LinearToSrgb8(c.z), 255};
    }
  }
  return Texture::FromImage("night lights", std::move(lights), true);
}

int SizeOf(Recipe recipe) {
  switch (recipe) {
    case R::kAsphalt:
    case R::kSlabs:
      return 1024;
    case R::kShop0:
    case R::kShop1:
    case R::kShop2:
    case R::kStripes:
    case R::kGalvanised:
      return 256;
    default:
      return 512;
  }
}

TextureRecipe MakeRecipe(Recipe recipe) {
  switch (recipe) {
    case R::kAsphalt:
      return Painted("asphalt", 2, recipe, AsphaltAged);
    case R::kAsphaltFresh:
      return Painted("asphalt fresh", 1.5f, recipe, AsphaltFresh);
    case R::kBitumen:
      return Painted("bitumen", 1, recipe, Bitumen);
    case R::kConcrete:
      return Painted("concrete", 2.4f, recipe, Concrete);
    case R::kSlabs:
      return Painted("slabs", 3, recipe, Slabs);
    case R::kPavingBrick:
      return Painted("paving brick", 2, recipe, PavingBrick);
    case R::kStoneSetts:
      return Painted("stone setts", 2, recipe, StoneSetts);
    case R::kGravelPath:
      return Painted("gravel path", 1.6f, recipe, GravelPath);
    case R::kGrass:
      return Painted("grass", 1.6f, recipe, Grass);
    case R::kSoil:
      return Painted("soil", 2, recipe, Soil);
    case R::kBrickRed:
      return Painted("brick red", 2, recipe, BrickRed);
    case R::kBrickStock:
      return Painted("brick stock", 2, recipe, BrickStock);
    case R::kBrickPainted:
      return Painted("brick painted", 2, recipe, BrickPainted);
    case R::kAshlar:
      return Painted("ashlar", 3, recipe, Ashlar);
    case R::kPlaster:
      return Painted("plaster", 2.5f, recipe, Plaster);
    case R::kPlanks:
      return Painted("planks", 2, recipe, Planks);
    case R::kRoofGravel:
      return Painted("roof gravel", 2, recipe, RoofGravel);
    case R::kRoofTile:
      return Painted("roof tile", 2.4f, recipe, RoofTile);
    case R::kSlate:
      return Painted("slate", 2, recipe, Slate);
    case R::kGalvanised:
      return Painted("galvanised", 0.7f, recipe, Galvanised);
    case R::kPaintWorn:
      return Painted("road paint", 1.5f, recipe, PaintWorn);
    case R::kStripes:
      return {"stripes", 1.6f, 0.5f, Stripes};
    case R::kFarWalls:
      return {"far walls", 24, 0.42f, FarWalls};
    case R::kFarPiers:
      return {"far piers", 24, 0.40f, FarPiers};
    case R::kFarRibbons:
      return {"far ribbons", 24, 0.36f, FarRibbons};
    case R::kRock:
      return {"rock", 900, 0.12f, Rock};
    case R::kFields:
      return {"fields", 2400, 0.13f, Fields};
    case R::kShop0:
      return {"shop 0", 1, 0.17f, [](float u, float v) { return Shop(u, v, 0); }};
    case R::kShop1:
      return {"shop 1", 1, 0.17f, [](float u, float v) { return Shop(u, v, 1); }};
    case R::kShop2:
      return {"shop 2", 1, 0.17f, [](float u, float v) { return Shop(u, v, 2); }};
    default:
      return {"plain", 1, 0.5f, [](float, float) { return Texel{}; }};
  }
}

}  // namespace airsim360::internal
