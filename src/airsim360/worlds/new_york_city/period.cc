#include "airsim360/worlds/new_york_city/period.h"

#include <array>
#include <string_view>

namespace airsim360::internal {
namespace {

using Style = FacadeStyle;
using S = Surface;

constexpr Role kRolesPresent[] = {
    {2, 2, 0, 0, "deco corner", LotUse::kBuilding, Style::kDeco, 0, 54, 1},
    {1, 2, 0, -1, "grid tower", LotUse::kBuilding, Style::kConcreteGrid, 2, 76, 2},
    {2, 1, 1, 0, "braced corner", LotUse::kBuilding, Style::kBracedGlass, 0, 31, 1},
    {1, 1, 1, -1, "brown tower", LotUse::kBuilding, Style::kDeco, 2, 62, 3},
    {1, 2, 1, -1, "blue tower", LotUse::kBuilding, Style::kCurtainWall, 1, 116, 2},
    {2, 2, 1, 0, "north deco", LotUse::kBuilding, Style::kDeco, 1, 66, 3},
    {2, 1, 0, 0, "glass slab", LotUse::kBuilding, Style::kCurtainWall, 0, 122, 2},
    {1, 1, 0, -1, "loft corner", LotUse::kBuilding, Style::kBrickLoft, 0, 36, 1},
    {2, 2, 0, 1, "ribbon low", LotUse::kBuilding, Style::kRibbon, 0, 22, 1},
    {2, 1, 1, 2, "plaza", LotUse::kPlaza, Style::kRibbon, 0, 0, 1},
    {1, 1, 1, 1, "building site", LotUse::kDirt, Style::kRibbon, 0, 0, 1},
    {1, 2, 0, 1, "bottle roof", LotUse::kBuilding, Style::kBrickLoft, 1, 24, 1},
    {2, 2, 0, -1, "bank", LotUse::kBuilding, Style::kClassicStone, 0, 27, 1},
    {3, 1, 1, 1, "similar tower 1", LotUse::kBuilding, Style::kRibbon, 0, 58, 2},
    {3, 1, 1, 2, "similar tower 2", LotUse::kBuilding, Style::kRibbon, 0, 58, 2},
    {3, 1, 1, 3, "similar tower 3", LotUse::kBuilding, Style::kRibbon, 0, 58, 2},
};

// Stone and brick where glass stands today, on the same lots and as high.
struct Rebuilt {
  std::string_view role;
  FacadeStyle style;
  int palette, tiers;
  const char* called = "";
};
constexpr Rebuilt kRebuilt1950s[] = {
    {"grid tower", Style::kDeco, 1, 2, "sandstone tower"},
    {"braced corner", Style::kTerracotta, 0, 1, "terracotta corner"},
    {"blue tower", Style::kGlazedDeco, 0, 3, "glazed brick tower"},
    {"glass slab", Style::kDeco, 0, 3, "limestone tower"},
    {"ribbon low", Style::kClassicStone, 1, 1, "theatre"},
    {"similar tower 1", Style::kDeco, 3, 3},
    {"similar tower 2", Style::kDeco, 3, 3},
    {"similar tower 3", Style::kDeco, 3, 3},
};
constexpr auto kRoles1950s = [] {
  auto roles = std::to_array(kRolesPresent);
  for (Role& role : roles) {
    for (const Rebuilt& then : kRebuilt1950s) {
      if (then.role != role.name) continue;
      role.style = then.style;
      role.palette = then.palette;
      role.tiers = then.tiers;
      role.called = then.called;
    }
  }
  return roles;
}();

// Panes of clear glass, slabs without studs for the blind, white brick and yellow brick between bands of windows.
constexpr std::pair<Surface, Surface> kSurfaces1950s[] = {
    {S::kGlassBlue, S::kGlassDark},   {S::kPaintYellow, S::kPaintWhite},   {S::kTactile, S::kSlabs},
    {S::kPanelWhite, S::kBrickWhite}, {S::kConcreteWarm, S::kBrickYellow}, {S::kFarWalls2, S::kFarWalls0}};

// What the two styles of the time's ornate towers are clad with.
constexpr Coat kCoats1950s[] = {
    {S::kStuccoOchre, S::kTrimStone, "terracotta", {0.96f, 0.74f, 0.52f}, 0.45f, 0.25f},
    {S::kShutterGreen, S::kTrimStone, "copper verdigris", {0.38f, 0.66f, 0.56f}, 0.65f},
    {S::kStuccoBlue, S::kBrickWhite, "glazed brick cream", {1.0f, 0.93f, 0.78f}, 0.4f, 0.5f},
    {S::kShutterBlue, S::kTrimStone, "glazed spandrel turquoise", {0.17f, 0.40f, 0.39f}, 0.35f, 0.5f},
    {S::kStuccoRose, S::kBrickWhite, "glazed brick black", {0.10f, 0.10f, 0.11f}, 0.35f, 0.5f},
};

constexpr StandIn kProps1950s[] = {
    {"ac_unit", "roof_cowl"},
    {"antenna", "antenna_1950s"},
    {"banner", "banner_1950s"},
    {"bicycle", "bicycle_1950s"},
    {"billboard", "billboard_1950s"},
    {"blue_barrier", "blue_barrier_1950s"},
    {"bus", "bus_1950s"},
    {"bus_stop", "bus_stop_1950s"},
    {"car", "car_1950s"},
    {"concrete_block", "concrete_block_1950s"},
    {"electric_box", "electric_box_1950s"},
    {"food_truck", "food_truck_1950s"},
    {"light_box", "light_box_1950s"},
    {"mural", "mural_1950s"},
    {"poster_stand", "poster_stand_1950s"},
    {"road_column", "road_column_1950s"},
    {"street_light", "street_light_1950s"},
    {"taxi", "taxi_1950s"},
    {"traffic_light", "traffic_light_1950s"},
    {"traffic_sign", "traffic_sign_1950s"},
    {"trash_bags", "trash_bags_1950s"},
    {"us_flag", "us_flag_1950s"},
    {"van", "van_1950s"},
};

constexpr PavementRule kPavement1950s[] = {{"fire_alarm_box", 90, 0.65f, true, 1}, {"police_box", 120, 0.65f, true, 1}};

constexpr Period kPresent{
    .world = "new_york_city",
    .roles = kRolesPresent,
    .corner_towers = {Style::kDeco, Style::kConcreteGrid, Style::kCurtainWall, Style::kDeco, Style::kRibbon, Style::kClassicStone,
                      Style::kDeco, Style::kBrickLoft, Style::kCurtainWall},
    .other_towers = {Style::kDeco, Style::kCurtainWall, Style::kRibbon, Style::kDeco, Style::kConcreteGrid, Style::kClassicStone},
    .far_walls = {S::kFarWalls0, S::kFarWalls0, S::kFarWalls1, S::kFarWalls3, S::kFarWalls2, S::kFarPiers0, S::kFarPiers0, S::kFarPiers1,
                  S::kFarPiers1, S::kFarRibbons0, S::kFarRibbons1, S::kGlassBlue},
    .surfaces = {},
    .coats = {},
    .props = {},
    .pavement = {}};

constexpr Period k1950s{
    .world = "new_york_city_1950s",
    .roles = kRoles1950s,
    .corner_towers = {Style::kDeco, Style::kGlazedDeco, Style::kClassicStone, Style::kDeco, Style::kRibbon, Style::kTerracotta,
                      Style::kGlazedDeco, Style::kBrickLoft, Style::kTerracotta},
    .other_towers = {Style::kDeco, Style::kTerracotta, Style::kRibbon, Style::kGlazedDeco, Style::kBrickLoft, Style::kClassicStone},
    .far_walls = {S::kFarWalls0, S::kFarWalls0, S::kFarWalls1, S::kFarWalls3, S::kFarWalls0, S::kFarPiers0, S::kFarPiers0, S::kFarPiers1,
                  S::kFarPiers1, S::kFarWalls3, S::kFarWalls1, S::kFarPiers0},
    .surfaces = kSurfaces1950s,
    .coats = kCoats1950s,
    .props = kProps1950s,
    .pavement = kPavement1950s,
    .shop_signs = ShopSigns::k1950s,
    .paint = RoadPaint::kWhiteLines,
    .escape_wall = 5.6f,
    .coolers = false,
    .aerials = true,
    .subway_stairs = true};

}  // namespace

const Period& PeriodOf(CityStyle style) { return style == CityStyle::k1950s ? k1950s : kPresent; }

}  // namespace airsim360::internal
