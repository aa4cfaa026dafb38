// The surfaces that ground and buildings are made of: procedural tiling textures and plain paints.
#pragma once

#include <array>
#include <cstddef>

#include "airsim360/scene/scene.h"

namespace airsim360 {

/// Every surface of the procedural cities. Wall surfaces come in palettes: kBrickRed … kPanelWhite.
enum class Surface {
  kAsphalt,
  kAsphaltPatch,
  kAsphaltOld,
  kTar,
  kGutter,
  kKerb,
  kSlabs,
  kSlabsWarm,
  kTactile,
  kPlazaBrick,
  kPlazaBrickDark,
  kPlazaStone,
  kPath,
  kLawn,
  kSoil,
  kWater,
  kPaintWhite,
  kPaintYellow,
  kBikeLane,
  kIron,
  kBrickRed,
  kBrickBrown,
  kBrickYellow,
  kBrickWhite,
  kLimestone,
  kSandstone,
  kGranite,
  kStuccoOchre,
  kStuccoWhite,
  kStuccoRose,
  kStuccoBlue,
  kConcrete,
  kConcreteWarm,
  kPanelWhite,
  kPanelDark,
  kTrimStone,
  kTrimWhite,
  kTrimDark,
  kFrameWhite,
  kFrameDark,
  kFrameGreen,
  kFrameWood,
  kShutterGreen,
  kShutterBlue,
  kGlassDark,
  kGlassBlue,
  kGlassBlind,
  kGlassCurtain,
  kGlassLit,
  kShopInside0,
  kShopInside1,
  kShopInside2,
  kSigns,
  kDoorRed,
  kDoorGreen,
  kDoorWood,
  kAwningRed,
  kAwningGreen,
  kAwningBlue,
  kAwningYellow,
  kRoofGravel,
  kRoofBitumen,
  kRoofTile,
  kRoofSlate,
  kCoping,
  kMetal,
  kFarWalls0,
  kFarWalls1,
  kFarWalls2,
  kFarRoof,
  kMountain,
  kMountainFar,
  kPlain,
  kBusLane,
  kDirt,
  kBrownstone,
  kBrownstoneTrim,
  kBronze,
  kGlassBlack,
  kGlassRedCurtain,
  kIronBlack,
  kCarriageway,  ///< its u runs across the street, 0 in the middle, so that the shader finds the wheel tracks
  kCarriagewayOld,
  kCarriagewayFresh,
  kCarriagewayPale,
  kAsphaltPale,
  kFarWalls3,
  kFarPiers0,
  kFarPiers1,
  kFarRibbons0,
  kFarRibbons1,
  kDoorGrey,
  kDoorBrown,
  kForestFloor,
  kCount
};

/// Whose names are on Surface::kSigns.
enum class ShopSigns { kToday, k1950s };

/// Material of every surface.
class Surfaces {
 public:
  MaterialId operator[](Surface surface) const { return materials_[static_cast<size_t>(surface)]; }
  /// The same but for one surface.
  Surfaces With(Surface surface, MaterialId material) const {
    Surfaces changed = *this;
    changed.materials_[static_cast<size_t>(surface)] = material;
    return changed;
  }

 private:
  friend Surfaces AddSurfaces(SceneBuilder& builder, ShopSigns signs);
  std::array<MaterialId, static_cast<size_t>(Surface::kCount)> materials_{};
};

/// Generates the textures (in parallel, a second or two) and adds all materials. Textures tile in metres.
Surfaces AddSurfaces(SceneBuilder& builder, ShopSigns signs = ShopSigns::kToday);

/// Number of different shop signs on Surface::kSigns, in columns on one sheet.
inline constexpr int kSignCount = 208, kSignColumns = 4;
/// Where sign i lies on the sheet: texture coordinates of its upper left and lower right corner.
struct SignBox {
  Vec2f uv0, uv1;
};
constexpr SignBox ShopSignBox(int i) {
  const float u = static_cast<float>(i % kSignColumns) / kSignColumns, v = static_cast<float>(i / kSignColumns) * kSignColumns / kSignCount;
  return {{u, v}, {u + 1.0f / kSignColumns, v + static_cast<float>(kSignColumns) / kSignCount}};
}

}  // namespace airsim360
