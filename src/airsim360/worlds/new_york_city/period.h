// What the time decides about new_york_city: its buildings, its paint, what stands in for what.
#pragma once

#include <array>
#include <span>
#include <string>
#include <utility>

#include "airsim360/worlds/new_york_city/manhattan.h"
#include "airsim360/worlds/texture/surfaces.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360::internal {

/// A hand-set lot around the crossing at the origin, or one that instructions name.
struct Role {
  int column, block_row, row, index;  ///< of its block, and as in Lot; index -1 = last of its row
  const char* name;
  LotUse use;
  FacadeStyle style;
  int palette;              ///< of the style's
  float height;             ///< metres, of the highest roof
  int tiers;                ///< 1 straight, 2 podium and tower, 3 set back twice
  const char* called = "";  ///< its buildings' name where that is not the lot's
};

/// What stands along every side of a block.
struct PavementRule {
  const char* kind;
  float spacing;   ///< metres
  float depth;     ///< metres from the kerb
  bool to_street;  ///< looks at the street
  int group;       ///< how many stand together
};

/// Kind by kind: what is made where the first is asked for.
using StandIn = std::pair<const char*, const char*>;

/// A surface that is made of another in a colour and finish of its own.
struct Coat {
  Surface surface, of;
  const char* name;
  Vec3f color;  ///< times that of the other
  float roughness = 0.8f;
  float glaze = 0;  ///< clear coat, 0 ... 1
};

struct Period {
  const char* world;  ///< the scene's name
  std::span<const Role> roles;
  std::array<FacadeStyle, 9> corner_towers;  ///< one is drawn
  std::array<FacadeStyle, 6> other_towers;
  std::array<Surface, 12> far_walls;
  std::span<const std::pair<Surface, Surface>> surfaces;  ///< the first is made of what the second is
  std::span<const Coat> coats;                            ///< after `surfaces`
  std::span<const StandIn> props;
  std::span<const PavementRule> pavement;  ///< beside what stands there at any time
  ShopSigns shop_signs = ShopSigns::kToday;
  RoadPaint paint = RoadPaint::kToday;
  float escape_wall = 8;       ///< metres: least length of walls with a fire escape
  bool coolers = true;         ///< air conditioners in windows
  bool aerials = false;        ///< of television, on the low roofs
  bool subway_stairs = false;  ///< on the pavements of the crossing
};
const Period& PeriodOf(CityStyle style);

}  // namespace airsim360::internal
