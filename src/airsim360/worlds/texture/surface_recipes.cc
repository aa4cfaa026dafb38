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
    {R::kAsphalt, 0.120f, 0.035f, 0.66f, 0.06f, 0.55f},     {R::kAsphaltFresh, 0.052f, 0.010f, 0.65f, 0.05f, 0.55f},
    {R::kBitumen, 0.120f, 0.035f, 0.65f, 0.07f, 0.40f},     {R::kConcrete, 0.480f, 0.033f, 0.52f, 0.02f, 0.13f},
    {R::kSlabs, 0.360f, 0.055f, 0.58f, 0.05f, 0.27f},       {R::kPavingBrick, 0.165f, 0.040f, 0.60f, 0.06f, 0.40f},
    {R::kStoneSetts, 0.330f, 0.090f, 0.58f, 0.08f, 0.50f},  {R::kGravelPath, 0.260f, 0.075f, 0.53f, 0.08f, 0.75f},
    {R::kGrass, 0.145f, 0.050f, 0.62f, 0.06f, 0.48f},       {R::kSoil, 0.140f, 0.035f, 0.67f, 0.05f, 0.45f},
    {R::kForestFloor, 0.100f, 0.045f, 0.70f, 0.07f, 0.40f}, {R::kBrickRed, 0.200f, 0.080f, 0.58f, 0.06f, 0.44f},
    {R::kBrickStock, 0.250f, 0.060f, 0.58f, 0.06f, 0.44f},  {R::kBrickPainted, 0.520f, 0.120f, 0.56f, 0.06f, 0.36f},
    {R::kAshlar, 0.500f, 0.055f, 0.60f, 0.06f, 0.30f},      {R::kPlaster, 0.500f, 0.035f, 0.55f, 0.05f, 0.17f},
    {R::kPlanks, 0.500f, 0.120f, 0.62f, 0.06f, 0.40f},      {R::kRoofGravel, 0.180f, 0.055f, 0.52f, 0.08f, 0.85f},
    {R::kRoofTile, 0.260f, 0.090f, 0.52f, 0.06f, 1.00f},    {R::kSlate, 0.048f, 0.012f, 0.65f, 0.10f, 0.80f},
    {R::kGalvanised, 0.420f, 0.035f, 0.36f, 0.06f, 0.03f},  {R::kPaintWorn, 0.500f, 0.130f, 0.58f, 0.06f, 0.40f},
};

// Recipes of albedo, roughness and height.
struct PaintedRow {
  Recipe recipe;
  const char* name;
  float tile;  // metres
  void (*paint)(SurfaceMaps&);
};
constexpr PaintedRow kPainted[] = {
    {R::kAsphalt, "asphalt", 2, AsphaltAged},
    {R::kAsphaltFresh, "asphalt fresh", 1.5f, AsphaltFresh},
    {R::kBitumen, "bitumen", 1, Bitumen},
    {R::kConcrete, "concrete", 2.4f, Concrete},
    {R::kSlabs, "slabs", 3, Slabs},
    {R::kPavingBrick, "paving brick", 2, PavingBrick},
    {R::kStoneSetts, "stone setts", 2, StoneSetts},
    {R::kGravelPath, "gravel path", 1.6f, GravelPath},
    {R::kGrass, "grass", 1.6f, Grass},
    {R::kSoil, "soil", 2, Soil},
    {R::kForestFloor, "forest floor", 2, ForestFloor},
    {R::kBrickRed, "brick red", 2, BrickRed},
    {R::kBrickStock, "brick stock", 2, BrickStock},
    {R::kBrickPainted, "brick painted", 2, BrickPainted},
    {R::kAshlar, "ashlar", 3, Ashlar},
    {R::kPlaster, "plaster", 2.5f, Plaster},
    {R::kPlanks, "planks", 2, Planks},
    {R::kRoofGravel, "roof gravel", 2, RoofGravel},
    {R::kRoofTile, "roof tile", 2.4f, RoofTile},
    {R::kSlate, "slate", 2, Slate},
    {R::kGalvanised, "galvanised", 0.7f, Galvanised},
    {R::kPaintWorn, "road paint", 1.5f, PaintWorn},
};

// Recipes of a colour a point.
struct TexelRow {
  Recipe recipe;
  const char* name;
  float tile, luminance;  // metres; mean
  Texel (*texel)(float u, float v);
};
constexpr TexelRow kTexels[] = {
    {R::kStripes, "stripes", 1.6f, 0.5f, Stripes},
    {R::kFarWalls, "far walls", 24, 0.42f, FarWalls},
    {R::kFarPiers, "far piers", 24, 0.40f, FarPiers},
    {R::kFarRibbons, "far ribbons", 24, 0.36f, FarRibbons},
    {R::kRock, "rock", 900, 0.12f, Rock},
    {R::kFields, "fields", 2400, 0.13f, Fields},
    {R::kShop0, "shop 0", 1, 0.17f, [](float u, float v) { return Shop(u, v, 0); }},
    {R::kShop1, "shop 1", 1, 0.17f, [](float u, float v) { return Shop(u, v, 1); }},
    {R::kShop2, "shop 2", 1, 0.17f, [](float u, float v) { return Shop(u, v, 2); }},
};

TextureRecipe Painted(const PaintedRow& row) {
  for (const MaterialTarget& t : kTargets)
    if (t.recipe == row.recipe) return {row.name, row.tile, t.luminance, nullptr, row.paint, t.roughness, t.slope};
  return {row.name, row.tile, 0.5f, nullptr, row.paint};
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
      const Vec3f c =
          FarLights(wall->texel, wall->columns, wall->rows, (static_cast<float>(x) + 0.5f) / kSize, (static_cast<float>(y) + 0.5f) / kSize);
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
  for (const PaintedRow& row : kPainted)
    if (row.recipe == recipe) return Painted(row);
  for (const TexelRow& row : kTexels)
    if (row.recipe == recipe) return {row.name, row.tile, row.luminance, row.texel};
  return {"plain", 1, 0.5f, [](float, float) { return Texel{}; }};
}

}  // namespace airsim360::internal
