#include "airsim360/worlds/town_maker/town_styles.h"

#include <array>

namespace airsim360::internal {
namespace {

using Names = std::string_view;
constexpr Names kGlassMaterials[] = {"glass", "glass", "concrete", "metal", "stone"};
constexpr Names kGreys[] = {"#b9bcc0", "#8d949c", "#cfc8ba", "#a7a39a", "#6f7a86"};
constexpr Names kFlat[] = {"flat"};
constexpr Names kNoColour[] = {""};

constexpr Names kBricks[] = {"brick", "brick", "brick", "stone"};
constexpr Names kBrickColours[] = {"#8c4a36", "#7a4030", "#9c6148", "#6d4436", "#b08b68", "#a39684"};
constexpr Names kMostlyFlat[] = {"flat", "flat", "flat", "mansard"};

// Lisbon: tiled fronts between painted ones, hipped roofs of clay tiles.
constexpr Names kAzulejoMaterials[] = {"azulejo_blue", "azulejo_green", "plaster", "azulejo_yellow", "plaster", "plaster", "azulejo_white"};
constexpr Names kAzulejoColours[] = {"#e9d9a8", "#f0e6d2", "#e8b9a0", "#f2ede2", "#c9d8dd", "#efd27f", "#d99a86"};
constexpr Names kHipped[] = {"hipped", "gabled", "hipped"};

// Rome: ochres and earths, low roofs of old tiles, some terraces.
constexpr Names kPlaster[] = {"plaster", "plaster", "plaster", "stone"};
constexpr Names kOchres[] = {"#d6a873", "#d19a75", "#dcb98c", "#c08a6c", "#e2c9a2", "#cba17d", "#dccbac", "#b98068", "#e6d7ba"};
constexpr Names kLowHipped[] = {"hipped", "hipped", "flat", "gabled"};

constexpr Names kTimber[] = {"timber"};
constexpr Names kTimberColours[] = {"#7a5234", "#64422b", "#8a6242", "#4f3a2a", "#7d3327"};
constexpr Names kGabled[] = {"gabled"};
constexpr Names kShingles[] = {"#4c4a48", "#5d4a3c", "#3f4a44"};

constexpr Names kWhite[] = {"#f6f4ee", "#f3f1ea", "#faf8f3", "#eef0ee", "#f1e9dc"};
constexpr Names kPlasterOnly[] = {"plaster"};
constexpr Names kWhiteRoofs[] = {"flat", "flat", "dome", "flat", "gabled"};

constexpr Names kStones[] = {"stone", "stone", "sandstone", "plaster"};
constexpr Names kStoneColours[] = {"#b5a98f", "#a39883", "#c2b79e", "#928a7a", "#cfc3a6"};
constexpr Names kSlates[] = {"#55585c", "#6a5f58", "#4a4d52"};

constexpr Names kSuburb[] = {"timber", "brick", "plaster"};
constexpr Names kSuburbColours[] = {"#dfe3e2", "#c9d2d6", "#e8dfc8", "#9fb0b5", "#8c4a36", "#d8d0bd"};
constexpr Names kSuburbRoofs[] = {"gabled", "hipped", "gabled"};

constexpr Names kSheds[] = {"metal", "brick", "concrete", "brick"};
constexpr Names kShedColours[] = {"#9aa3a8", "#7a4030", "#b5b1a8", "#6d7f8c", "#8c4a36"};
constexpr Names kShedRoofs[] = {"sawtooth", "gabled", "flat", "flat", "skillion"};

constexpr Names kMixed[] = {"brick", "plaster", "stone", "brick", "concrete"};
constexpr Names kMixedColours[] = {"#8c4a36", "#e3d5b8", "#b9b2a3", "#9c6148", "#c8c2b6", "#d9b38c"};
constexpr Names kMixedRoofs[] = {"flat", "hipped", "flat", "gabled", "mansard"};

constexpr std::array<HouseStyle, 10> kStyles{{
    {"office", kGlassMaterials, kGreys, kFlat, "", kNoColour, 24, 46, 30, 0},
    {"apartments", kBricks, kBrickColours, kMostlyFlat, "", kNoColour, 7, 16, 15, 0.3},
    {"apartments", kAzulejoMaterials, kAzulejoColours, kHipped, "roof_tiles", kNoColour, 6.5, 12, 12, 0.26},
    {"apartments", kPlaster, kOchres, kLowHipped, "roof_tiles", kNoColour, 8, 17, 14, 0.2},
    {"house", kTimber, kTimberColours, kGabled, "", kShingles, 7.5, 11, 7.5, 0.62},
    {"house", kPlasterOnly, kWhite, kWhiteRoofs, "", kWhite, 6, 11, 8.5, 0.3},
    {"house", kStones, kStoneColours, kGabled, "", kSlates, 6, 12, 10, 0.45},
    {"house", kSuburb, kSuburbColours, kSuburbRoofs, "", kShingles, 10, 15, 9.5, 0.42},
    {"industrial", kSheds, kShedColours, kShedRoofs, "", kNoColour, 22, 48, 32, 0.18},
    {"apartments", kMixed, kMixedColours, kMixedRoofs, "", kNoColour, 8, 18, 14, 0.3},
}};

}  // namespace

std::span<const std::string_view> ColoursOf(TownColours colours) {
  static constexpr Names kBright[] = {"#c2452d", "#e0b23c", "#3f7fa6", "#7fa05a", "#d9d2c0", "#b9603b", "#e3c7a0", "#5f8f93"};
  static constexpr Names kReds[] = {"#8e3b2c", "#7d3327", "#9c4a38"};
  static constexpr Names kStoneGreys[] = {"#a4a29c", "#8d8f90", "#b7b4ac", "#77797b"};
  switch (colours) {
    case TownColours::kWhite:
      return kWhite;
    case TownColours::kOchre:
      return kOchres;
    case TownColours::kBright:
      return kBright;
    case TownColours::kRed:
      return kReds;
    case TownColours::kGrey:
      return kStoneGreys;
    case TownColours::kStyle:
      break;
  }
  return {};
}

const HouseStyle& StyleOf(TownStyle style) { return kStyles[static_cast<size_t>(style)]; }

}  // namespace airsim360::internal
