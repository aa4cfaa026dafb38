// What floors, walls, ceilings and fittings of buildings are made of: own textures at real sizes, and paints.
#pragma once

#include <array>
#include <cstddef>

#include "airsim360/scene/scene.h"

namespace airsim360::internal {

enum class Finish {
  kOak,
  kWalnut,
  kCarpetGrey,
  kCarpetBlue,
  kTileWhite,
  kTileGrey,
  kTerrazzo,
  kStone,
  kEpoxy,
  kConcreteFloor,
  kDeck,
  kPlasterWhite,
  kPlasterWarm,
  kPlasterSage,
  kPlasterBlue,
  kPlasterGrey,
  kPlasterRose,
  kBathTiles,
  kConcreteWall,
  kBlockWall,
  kRibbedWhite,
  kCeilingPlaster,
  kCeilingTiles,
  kCeilingConcrete,
  kSteelDeck,
  kFacadeRender,
  kFacadePanel,
  kFacadeRibbed,
  kGlass,
  kGlassTinted,
  kFrosted,
  kFrameDark,
  kFrameWhite,
  kFrameSteel,
  kDoorOak,
  kDoorWhite,
  kDoorGrey,
  kDoorSteel,
  kSkirting,
  kSill,
  kChrome,
  kRubber,
  kSteelBlue,
  kSteelGrey,
  kPaintYellow,
  kPaintWhite,
  kPaintRed,
  kPaintGreen,
  kPaintBlack,
  kTread,
  kRadiator,
  kPlastic,
  kCount
};

/// Material of every finish.
class Finishes {
 public:
  explicit Finishes(SceneBuilder& builder);
  MaterialId operator[](Finish finish) const { return materials_[static_cast<size_t>(finish)]; }

 private:
  std::array<MaterialId, static_cast<size_t>(Finish::kCount)> materials_{};
};

}  // namespace airsim360::internal
