#include "airsim360/worlds/texture/surfaces.h"

#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "airsim360/base/disk_cache.h"
#include "airsim360/base/parallel.h"
#include "airsim360/worlds/texture/kept_textures.h"
#include "airsim360/worlds/texture/recipe_shapes.h"
#include "airsim360/worlds/texture/shop_signs.h"
#include "airsim360/worlds/texture/surface_recipes.h"

namespace airsim360 {
namespace {

using internal::Recipe;

// One material: the texture's mean luminance is replaced by that of `color`, hue multiplied.
struct Row {
  Surface surface;
  const char* name;
  Recipe recipe;
  Vec3f color;             // albedo (linear); with a texture: multiplies it
  float roughness = 0.8f;  // of untextured ones
  float macro = 0;
  float metallic = 0;
  SurfaceKind kind = SurfaceKind::kStandard;
  GroundWear ground = GroundWear::kNone;
};

constexpr Vec3f Gray(float y) { return {y, y, y}; }
constexpr SurfaceKind kPane = SurfaceKind::kGlass;

using S = Surface;
using R = Recipe;
using G = GroundWear;
constexpr SurfaceKind kSolid = SurfaceKind::kStandard;
constexpr Row kRows[] = {
    {S::kAsphalt, "asphalt", R::kAsphalt, {0.75f, 0.765f, 0.785f}, 0.8f, 0.14f, 0, kSolid, G::kAsphalt},
    {S::kAsphaltPatch, "asphalt patch", R::kAsphaltFresh, Gray(1.15f), 0.8f, 0.08f, 0, kSolid, G::kAsphalt},
    {S::kAsphaltOld, "asphalt old", R::kAsphalt, {0.90f, 0.905f, 0.91f}, 0.8f, 0.14f, 0, kSolid, G::kAsphalt},
    {S::kTar, "tar", R::kNone, Gray(0.035f), 0.5f},
    {S::kGutter, "gutter", R::kConcrete, Gray(0.50f), 0.7f, 0.16f, 0, kSolid, G::kPaving},
    {S::kKerb, "kerb stone", R::kConcrete, {0.72f, 0.71f, 0.69f}, 0.7f, 0.14f, 0, kSolid, G::kPaving},
    {S::kSlabs, "slabs", R::kSlabs, {0.78f, 0.77f, 0.74f}, 0.7f, 0.17f, 0, kSolid, G::kPaving},
    {S::kSlabsWarm, "slabs warm", R::kSlabs, {0.9f, 0.81f, 0.70f}, 0.7f, 0.17f, 0, kSolid, G::kPaving},
    {S::kTactile, "tactile slabs", R::kSlabs, {1.20f, 0.90f, 0.38f}, 0.7f, 0.06f, 0, kSolid, G::kPaving},
    {S::kPlazaBrick, "plaza brick", R::kPavingBrick, {0.88f, 0.90f, 0.95f}, 0.7f, 0.20f, 0, kSolid, G::kPaving},
    {S::kPlazaBrickDark, "plaza brick dark", R::kPavingBrick, {0.68f, 0.70f, 0.76f}, 0.7f, 0.20f, 0, kSolid, G::kPaving},
    {S::kPlazaStone, "plaza stone", R::kStoneSetts, Gray(1.0f), 0.6f, 0.17f, 0, kSolid, G::kPaving},
    {S::kPath, "park path", R::kGravelPath, Gray(1.0f), 0.85f, 0.10f, 0, kSolid, G::kGravel},
    {S::kLawn, "lawn", R::kGrass, {1.0f, 1.0f, 1.0f}, 0.8f, 0.14f, 0, kSolid, G::kLawn},
    {S::kSoil, "soil", R::kSoil, Gray(1.0f), 0.9f, 0.10f, 0, kSolid, G::kSoil},
    {S::kWater, "water", R::kNone, {0.020f, 0.036f, 0.034f}, 0.08f, 0, 0, SurfaceKind::kWater},
    // Cracks, oil and dirt of the road go through its paint.
    {S::kPaintWhite, "road paint white", R::kPaintWorn, Gray(1.00f), 0.65f, 0.08f, 0, kSolid, G::kAsphalt},
    {S::kPaintYellow, "road paint yellow", R::kPaintWorn, {1.02f, 0.66f, 0.13f}, 0.65f, 0.08f, 0, kSolid, G::kAsphalt},
    {S::kBikeLane, "bike lane", R::kAsphalt, {0.54f, 1.08f, 0.66f}, 0.75f, 0.14f, 0, kSolid, G::kAsphalt},
    {S::kIron, "cast iron", R::kNone, Gray(0.075f), 0.5f, 0, 0.6f},
    {S::kBrickRed, "brick red", R::kBrickRed, Gray(1.0f), 0.7f, 0.15f},
    {S::kBrickBrown, "brick brown", R::kBrickRed, {0.74f, 0.80f, 0.84f}, 0.7f, 0.15f},
    {S::kBrickYellow, "brick yellow", R::kBrickStock, Gray(1.05f), 0.7f, 0.15f},
    {S::kBrickWhite, "brick painted", R::kBrickPainted, {1.0f, 0.97f, 0.90f}, 0.7f, 0.15f},
    {S::kLimestone, "limestone", R::kAshlar, {1.02f, 0.92f, 0.76f}, 0.7f, 0.15f},
    {S::kSandstone, "sandstone", R::kAshlar, {0.86f, 0.66f, 0.46f}, 0.7f, 0.15f},
    {S::kGranite, "granite", R::kAshlar, {0.50f, 0.49f, 0.48f}, 0.5f, 0.15f},
    {S::kStuccoOchre, "stucco ochre", R::kPlaster, {1.02f, 0.78f, 0.50f}, 0.8f, 0.15f},
    {S::kStuccoWhite, "stucco white", R::kPlaster, {1.16f, 1.10f, 0.98f}, 0.8f, 0.15f},
    {S::kStuccoRose, "stucco rose", R::kPlaster, {0.98f, 0.72f, 0.62f}, 0.8f, 0.15f},
    {S::kStuccoBlue, "stucco blue", R::kPlaster, {0.68f, 0.78f, 0.86f}, 0.8f, 0.15f},
    {S::kConcrete, "facade concrete", R::kConcrete, {0.92f, 0.90f, 0.86f}, 0.7f, 0.15f},
    {S::kConcreteWarm, "facade concrete warm", R::kConcrete, {0.86f, 0.76f, 0.62f}, 0.7f, 0.15f},
    {S::kPanelWhite, "panel white", R::kPlaster, {1.10f, 1.09f, 1.06f}, 0.5f, 0.10f},
    {S::kPanelDark, "panel dark", R::kNone, {0.07f, 0.075f, 0.085f}, 0.45f, 0.03f},
    {S::kTrimStone, "trim stone", R::kConcrete, {1.08f, 1.0f, 0.86f}, 0.7f, 0.10f},
    {S::kTrimWhite, "trim white", R::kPlaster, {1.36f, 1.34f, 1.28f}, 0.7f, 0.10f},
    {S::kTrimDark, "trim dark", R::kNone, {0.085f, 0.080f, 0.078f}, 0.6f},
    {S::kFrameWhite, "frame white", R::kNone, Gray(0.66f), 0.5f},
    {S::kFrameDark, "frame dark", R::kNone, Gray(0.045f), 0.45f},
    {S::kFrameGreen, "frame green", R::kNone, {0.045f, 0.095f, 0.065f}, 0.5f},
    {S::kFrameWood, "frame wood", R::kPlanks, {0.42f, 0.32f, 0.24f}, 0.6f},
    {S::kShutterGreen, "shutter green", R::kNone, {0.066f, 0.098f, 0.076f}, 0.6f},
    {S::kShutterBlue, "shutter blue", R::kNone, {0.13f, 0.175f, 0.22f}, 0.6f},
    {S::kGlassDark, "glass dark", R::kNone, {0.035f, 0.042f, 0.046f}, 0.05f, 0, 0, kPane},
    {S::kGlassBlue, "glass blue", R::kNone, {0.030f, 0.060f, 0.085f}, 0.05f, 0, 0, kPane},
    {S::kGlassBlind, "glass with blind", R::kNone, {0.40f, 0.385f, 0.35f}, 0.05f, 0, 0, kPane},
    {S::kGlassCurtain, "glass with curtain", R::kNone, {0.26f, 0.19f, 0.13f}, 0.05f, 0, 0, kPane},
    {S::kGlassLit, "glass lit", R::kNone, {0.34f, 0.26f, 0.15f}, 0.05f, 0, 0, kPane},
    {S::kShopInside0, "shop window 0", R::kShop0, Gray(1), 0.05f, 0, 0, kPane},
    {S::kShopInside1, "shop window 1", R::kShop1, Gray(1), 0.05f, 0, 0, kPane},
    {S::kShopInside2, "shop window 2", R::kShop2, Gray(1), 0.05f, 0, 0, kPane},
    {S::kSigns, "shop signs", R::kNone, Gray(1), 0.5f},
    {S::kDoorRed, "door red", R::kNone, {0.30f, 0.035f, 0.03f}, 0.4f},
    {S::kDoorGreen, "door green", R::kNone, {0.03f, 0.11f, 0.07f}, 0.4f},
    {S::kDoorWood, "door wood", R::kPlanks, {0.5f, 0.36f, 0.24f}, 0.55f},
    {S::kAwningRed, "awning red", R::kStripes, {0.98f, 0.26f, 0.21f}, 0.85f},
    {S::kAwningGreen, "awning green", R::kStripes, {0.34f, 0.60f, 0.40f}, 0.85f},
    {S::kAwningBlue, "awning blue", R::kStripes, {0.36f, 0.48f, 0.76f}, 0.85f},
    {S::kAwningYellow, "awning yellow", R::kStripes, {1.02f, 0.82f, 0.46f}, 0.85f},
    {S::kRoofGravel, "roof gravel", R::kRoofGravel, Gray(1.1f), 0.85f, 0.14f, 0, kSolid, G::kRoof},
    {S::kRoofBitumen, "roof bitumen", R::kBitumen, Gray(0.95f), 0.8f, 0.16f, 0, kSolid, G::kRoofRolls},
    {S::kRoofTile, "roof tile", R::kRoofTile, Gray(1), 0.8f, 0.1f},
    {S::kRoofSlate, "roof slate", R::kSlate, Gray(1.15f), 0.7f, 0.08f},
    {S::kCoping, "coping", R::kConcrete, {0.82f, 0.80f, 0.77f}, 0.7f, 0.10f},
    {S::kMetal, "galvanised metal", R::kGalvanised, Gray(1.0f), 0.4f, 0.04f, 0.85f},
    {S::kFarWalls0, "far walls brick", R::kFarWalls, {0.74f, 0.46f, 0.34f}, 0.8f, 0.06f},
    {S::kFarWalls1, "far walls stone", R::kFarWalls, {1.05f, 0.95f, 0.80f}, 0.8f, 0.06f},
    {S::kFarWalls2, "far walls concrete", R::kFarWalls, {0.80f, 0.82f, 0.85f}, 0.8f, 0.06f},
    {S::kFarRoof, "far roof", R::kRoofGravel, Gray(0.9f), 0.85f, 0.2f},
    {S::kMountain, "mountain", R::kRock, Gray(1), 0.9f},
    {S::kMountainFar, "mountain far", R::kRock, {0.9f, 0.95f, 1.1f}, 0.9f},
    {S::kPlain, "plain", R::kFields, Gray(1), 0.9f},
    {S::kBusLane, "bus lane", R::kAsphalt, {1.38f, 0.54f, 0.50f}, 0.75f, 0.14f, 0, kSolid, G::kAsphalt},
    {S::kDirt, "dirt", R::kSoil, {0.94f, 0.92f, 0.90f}, 0.9f, 0.12f, 0, kSolid, G::kSoil},
    {S::kBrownstone, "brownstone", R::kAshlar, {0.44f, 0.29f, 0.21f}, 0.75f, 0.15f},
    {S::kBrownstoneTrim, "brownstone trim", R::kConcrete, {0.42f, 0.27f, 0.19f}, 0.75f, 0.10f},
    {S::kBronze, "bronze spandrel", R::kNone, {0.13f, 0.105f, 0.075f}, 0.5f, 0.03f},
    {S::kGlassBlack, "glass black", R::kNone, {0.012f, 0.014f, 0.017f}, 0.04f, 0, 0, kPane},
    {S::kGlassRedCurtain, "glass with red curtain", R::kNone, {0.42f, 0.012f, 0.015f}, 0.05f, 0, 0, kPane},
    {S::kIronBlack, "iron black", R::kNone, {0.022f, 0.022f, 0.024f}, 0.55f},
    {S::kCarriageway, "carriageway", R::kAsphalt, {0.73f, 0.745f, 0.765f}, 0.8f, 0.14f, 0, kSolid, G::kCarriageway},
    {S::kCarriagewayOld, "carriageway old", R::kAsphalt, {0.89f, 0.895f, 0.90f}, 0.8f, 0.14f, 0, kSolid, G::kCarriageway},
    {S::kCarriagewayFresh, "carriageway fresh", R::kAsphaltFresh, Gray(1.45f), 0.8f, 0.10f, 0, kSolid, G::kCarriageway},
    {S::kCarriagewayPale, "carriageway pale", R::kAsphalt, {1.12f, 1.11f, 1.09f}, 0.8f, 0.14f, 0, kSolid, G::kCarriageway},
    {S::kAsphaltPale, "asphalt pale", R::kAsphalt, {1.14f, 1.13f, 1.11f}, 0.8f, 0.10f, 0, kSolid, G::kAsphalt},
    {S::kFarWalls3, "far walls brown", R::kFarWalls, {0.54f, 0.39f, 0.31f}, 0.8f, 0.06f},
    {S::kFarPiers0, "far piers stone", R::kFarPiers, {1.06f, 0.94f, 0.78f}, 0.8f, 0.06f},
    {S::kFarPiers1, "far piers brick", R::kFarPiers, {0.78f, 0.52f, 0.40f}, 0.8f, 0.06f},
    {S::kFarRibbons0, "far ribbons white", R::kFarRibbons, {1.12f, 1.11f, 1.07f}, 0.8f, 0.06f},
    {S::kFarRibbons1, "far ribbons grey", R::kFarRibbons, {0.52f, 0.57f, 0.62f}, 0.6f, 0.06f},
    {S::kDoorGrey, "door grey", R::kNone, {0.165f, 0.17f, 0.172f}, 0.5f, 0.05f},
    {S::kDoorBrown, "door brown", R::kNone, {0.080f, 0.048f, 0.030f}, 0.45f, 0.05f},
    {S::kForestFloor, "forest floor", R::kForestFloor, Gray(1.0f), 0.9f, 0.14f, 0, kSolid, G::kSoil},
};
static_assert(std::size(kRows) == static_cast<size_t>(S::kCount));

struct TextureIds {
  TextureId color = kNoTexture, normal = kNoTexture, roughness = kNoTexture, lights = kNoTexture;
  float tile = 1;
};

bool IsPicture(Recipe recipe) { return recipe >= R::kShop0 && recipe <= R::kShop2; }

// Textures without a lattice are mixed from patches of themselves; bricks and slabs are tinted one by one.
bool IsShapeless(Recipe recipe) {
  return recipe == R::kAsphalt || recipe == R::kAsphaltFresh || recipe == R::kBitumen || recipe == R::kConcrete ||
         recipe == R::kGravelPath || recipe == R::kGrass || recipe == R::kSoil || recipe == R::kForestFloor || recipe == R::kPlaster ||
         recipe == R::kRoofGravel;
}

Vec2f UnitsOf(Recipe recipe) {
  using internal::Lattice;
  const auto units = [](Lattice l) { return Vec2f{static_cast<float>(l.columns), static_cast<float>(l.rows)}; };
  switch (recipe) {
    case R::kSlabs:
      return units(internal::kSlabUnits);
    case R::kBrickRed:
    case R::kBrickStock:
      return units(internal::kBrickUnits);
    case R::kAshlar:
      return units(internal::kAshlarUnits);
    case R::kStoneSetts:
      return units(internal::kSettUnits);
    case R::kSlate:
      return units(internal::kSlateUnits);
    case R::kFarWalls:
    case R::kFarPiers:
    case R::kFarRibbons:
      return {1, 0.1f};  // each far building a tone of its own
    default:
      return {};
  }
}

// Of each Recipe in turn: colour, normal, roughness and lit windows, which most have not (no level).
enum Layer { kColor, kNormal, kRoughness, kLights, kLayers };

std::vector<Texture> MakeSurfaces() {
  std::vector<Texture> made(static_cast<size_t>(R::kCount) * kLayers);
  ParallelFor(static_cast<int64_t>(R::kCount), [&](int64_t i) {
    const auto recipe = static_cast<Recipe>(i);
    TextureSet set = SynthesizeTextures(internal::MakeRecipe(recipe), internal::SizeOf(recipe));
    Texture* const of = &made[static_cast<size_t>(i) * kLayers];
    of[kColor] = std::move(set.color), of[kNormal] = std::move(set.normal), of[kRoughness] = std::move(set.roughness);
    if (std::optional<Texture> lights = internal::MakeNightLights(recipe)) of[kLights] = *std::move(lights);
  });
  return made;
}

// What is the same in all worlds, and most of the work of a small one. A process that makes one world does not keep it for another;
// one that makes a second has it for all that follow.
template <class Made>
class OnceMade {
 public:
  template <class Make>
  Made Get(const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      if (kept_) return *kept_;
    }
    Made made = make();  // not under the lock: it runs on all threads, which may be making other worlds
    const std::lock_guard lock(mutex_);
    if (asked_) kept_ = made;
    asked_ = true;
    return made;
  }

 private:
  std::mutex mutex_;
  bool asked_ = false;
  std::optional<Made> kept_;
};

std::vector<TextureIds> AddTextures(SceneBuilder& builder) {
  static OnceMade<std::vector<Texture>> surfaces;
  std::vector<Texture> all = surfaces.Get([] { return internal::KeptTextures(DiskCache::OfUser(), "surfaces", MakeSurfaces); });
  std::vector<TextureIds> ids(static_cast<size_t>(R::kCount));
  for (size_t i = 0; i < ids.size(); ++i) {
    const auto recipe = static_cast<Recipe>(i);
    Texture* const of = &all[i * kLayers];
    ids[i].tile = internal::MakeRecipe(recipe).tile;
    ids[i].color = builder.AddTexture(std::move(of[kColor]));
    if (IsPicture(recipe)) continue;
    ids[i].normal = builder.AddTexture(std::move(of[kNormal]));
    ids[i].roughness = builder.AddTexture(std::move(of[kRoughness]));
    if (!of[kLights].levels.empty()) ids[i].lights = builder.AddTexture(std::move(of[kLights]));
  }
  return ids;
}

}  // namespace

Surfaces AddSurfaces(SceneBuilder& builder, ShopSigns shop_signs) {
  const std::vector<TextureIds> textures = AddTextures(builder);
  static std::array<OnceMade<std::vector<Texture>>, 2> sheets;
  const auto kind = static_cast<size_t>(shop_signs);
  const TextureId signs = builder.AddTexture(std::move(sheets.at(kind).Get([&] {
    return internal::KeptTextures(DiskCache::OfUser(), "shop signs " + std::to_string(kind),
                                  [&] { return std::vector{internal::MakeShopSigns(shop_signs)}; });
  })[0]));
  Surfaces surfaces;
  for (const Row& row : kRows) {
    Material material;
    material.name = row.name;
    material.kind = row.kind;
    material.base_color = row.color;
    material.roughness = row.roughness;
    material.metallic = row.metallic;
    material.macro_variation = row.macro;
    material.ground = row.ground;
    material.blend_tiles = IsShapeless(row.recipe);
    material.units = UnitsOf(row.recipe);
    // Dark panes show the room behind them; blinds and curtains hide it.
    material.interior = row.surface == S::kGlassDark || row.surface == S::kGlassBlue || row.surface == S::kGlassLit ||
                        (row.recipe >= R::kShop0 && row.recipe <= R::kShop2);
    if (row.recipe != R::kNone) {
      const TextureIds& ids = textures[static_cast<size_t>(row.recipe)];
      material.base_color_texture = ids.color;
      material.normal_texture = ids.normal;
      material.metallic_roughness_texture = ids.roughness;
      if (ids.roughness != kNoTexture) material.roughness = 1;
      material.uv_scale = {1 / ids.tile, 1 / ids.tile};
      // Shops shine in the evening.
      if (IsPicture(row.recipe)) {
        material.emission = Vec3f{1.0f, 0.88f, 0.70f} * (120 * kNit);
        material.emission_texture = ids.color;
        material.lamp = true;
      }
      if (ids.lights != kNoTexture) {
        material.emission = Vec3f{1, 1, 1} * (90 * kNit);
        material.emission_texture = ids.lights;
        material.lamp = true;
      }
    }
    // So do their signs.
    if (row.surface == S::kSigns) {
      material.base_color_texture = material.emission_texture = signs;
      material.emission = Vec3f{1.0f, 0.88f, 0.70f} * (45 * kNit);
      material.lamp = true;
    }
    // Somebody is at home behind these; through a curtain or a blind less of it comes out. In the mean over all panes.
    if (row.surface == S::kGlassLit || row.surface == S::kGlassCurtain || row.surface == S::kGlassBlind) {
      const Vec3f lamps{1.43f, 0.94f, 0.50f};
      material.emission = lamps * ((row.surface == S::kGlassLit ? 22 : row.surface == S::kGlassCurtain ? 10 : 7) * kNit);
      material.lamp = true;
    }
    surfaces.materials_[static_cast<size_t>(row.surface)] = builder.AddMaterial(std::move(material));
  }
  return surfaces;
}

}  // namespace airsim360
