#include "airsim360/worlds/town_maker/town_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/worlds/osm/buildings/osm_areas.h"
#include "airsim360/worlds/osm/data/line_index.h"
#include "airsim360/worlds/osm/osm_relief.h"
#include "airsim360/worlds/town_maker/town_build.h"

namespace airsim360::internal {
namespace {

constexpr const char* kNames[] = {"downtown_city", "lisbon_downtown", "rome", "roof", "rural_cabins", "town"};

std::vector<OsmArea> HousesOf(const std::vector<OsmArea>& areas) {
  std::vector<OsmArea> houses;
  for (const OsmArea& area : areas)
    if (area.tags->Has("building")) houses.push_back(area);
  return houses;
}

// Every plan with every water, small; islands at the end.
std::vector<TownSpec> Variety() {
  std::vector<TownSpec> specs;
  for (int i = 0; i < 30; ++i) {
    const int plan = i < 25 ? i / 5 : i - 25, water = i < 25 ? i % 5 : 5;
    TownSpec spec{.plan = static_cast<TownPlan>(plan),
                  .style = static_cast<TownStyle>((2 * plan + water) % 10),
                  .relief = static_cast<TownRelief>((plan + water) % 5),
                  .water = static_cast<TownWater>(water)};
    spec.width = 260 + 20 * water;
    spec.depth = 240;
    spec.street = 6.0 + 3 * plan;
    spec.setback = water == 2 ? 4 : 0;
    spec.church = spec.castle = spec.windmill = spec.ruins = spec.arches = spec.wires = plan % 2 == 0;
    spec.harbour = water == 1 || water == 3 || water == 5;
    specs.push_back(spec);
  }
  return specs;
}

void ExpectSound(const TownMap& map, const std::string& which) {
  const std::vector<OsmArea> areas = FindAreas(map.data), houses = HousesOf(areas);
  EXPECT_GE(houses.size(), 8u) << which;
  BoxIndex boxes;
  for (size_t i = 0; i < houses.size(); ++i) boxes.Add(houses[i].bounds, static_cast<uint32_t>(i));
  double overlap = 0, wet = 0, road = 0;
  for (size_t i = 0; i < houses.size(); ++i) {
    EXPECT_FALSE(houses[i].patches.empty()) << which << " " << houses[i].id;
    for (uint32_t k : boxes.Find(houses[i].bounds))
      if (k > i) overlap += Area(Intersect(houses[i].patches, houses[k].patches));
    wet += Area(Intersect(houses[i].patches, map.wet));
  }
  for (const TownStreet& street : map.streets) {
    const Patches band = Band(street.line, street.half, street.half);
    Bounds2d box;
    for (const Patch& patch : band)
      for (Vec2d p : patch.outer) box.Add(p);
    for (uint32_t k : boxes.Find(box)) road += Area(Intersect(houses[k].patches, band));
  }
  EXPECT_LT(overlap, 1) << which;
  EXPECT_EQ(wet, 0) << which;
  EXPECT_LT(road, 2) << which;
}

TEST(TownMap, HousesStandNeitherInEachOtherNorInStreetsNorInWater) {
  for (const char* name : kNames)
    for (uint64_t seed : {0u, 5u}) ExpectSound(DrawTown(NamedTown(name), seed), std::string(name) + " " + std::to_string(seed));
  int i = 0;
  for (const TownSpec& spec : Variety()) ExpectSound(DrawTown(spec, static_cast<uint64_t>(i)), "variety " + std::to_string(i)), ++i;
}

// Halls are deeper than their fronts are wide: many seeds, for a house in a street is rare.
TEST(TownMap, ScatteredHallsKeepOffStreets) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    const TownSpec spec{.plan = TownPlan::kScattered, .style = static_cast<TownStyle>(seed % 10)};
    ExpectSound(DrawTown(spec, seed), "scattered " + std::to_string(seed));
  }
}

TEST(TownMap, SquaresHaveRoomForTheLargestAreaOfTheHumanTable) {
  // 50 x 30 m in Rome, 30 x 50 m in Lisbon, 30 x 30 m downtown (the paper's table of human scenes).
  for (const char* name : {"downtown_city", "lisbon_downtown", "rome"}) {
    const TownMap map = DrawTown(NamedTown(name), 0);
    ASSERT_FALSE(map.squares.empty());
    double largest = 0;
    for (const Patch& square : map.squares) largest = std::max(largest, Area(square));
    EXPECT_GT(largest, 1500) << name;
  }
}

TEST(TownMap, TheSameSeedDrawsTheSameTownAndAnotherSeedAnother) {
  const TownSpec& spec = NamedTown("rome");
  const TownMap a = DrawTown(spec, 3), b = DrawTown(spec, 3), c = DrawTown(spec, 4);
  ASSERT_EQ(a.data.ways.size(), b.data.ways.size());
  for (size_t i = 0; i < a.data.ways.size(); ++i) EXPECT_EQ(a.data.ways[i].line, b.data.ways[i].line);
  EXPECT_EQ(a.heights.heights, b.heights.heights);
  bool differs = a.data.ways.size() != c.data.ways.size();
  for (size_t i = 0; !differs && i < a.data.ways.size(); ++i) differs = !(a.data.ways[i].line == c.data.ways[i].line);
  EXPECT_TRUE(differs);
}

TEST(TownMap, TheGroundIsAsSteepAsAskedAndLevelAtTheWater) {
  TownSpec spec{.relief = TownRelief::kSlope};
  spec.climb = 40;
  const TownMap map = DrawTown(spec, 0);
  const Relief relief(map.heights, map.data.origin, spec.width * spec.depth);
  EXPECT_NEAR(relief.At({0, spec.depth / 2}) - relief.At({0, -spec.depth / 2}), 40, 9);
  spec.water = TownWater::kSea;
  const TownMap coast = DrawTown(spec, 0);
  const Relief shore(coast.heights, coast.data.origin, spec.width * spec.depth);
  double low = 1e9, high = -1e9;
  for (Vec2d p : coast.wet[0].outer)
    if (std::abs(p.x) < spec.width / 2 && std::abs(p.y) < spec.depth / 2)
      low = std::min(low, shore.At(p)), high = std::max(high, shore.At(p));
  EXPECT_LT(high - low, 0.3);
  spec.relief = TownRelief::kFlat;
  EXPECT_TRUE(DrawTown(spec, 0).heights.heights.empty());
}

bool WetAt(const TownMap& map, Vec2d p) {
  return std::any_of(map.wet.begin(), map.wet.end(), [&](const Patch& patch) { return Inside(patch, p); });
}

// Seen from above the town a valley has sides: 500 m beyond its edges the ground stands far over its own.
TEST(TownMap, TheSidesOfAValleyGoOnRisingOutside) {
  TownSpec spec{.relief = TownRelief::kValley};
  spec.climb = 36;
  const TownMap map = DrawTown(spec, 1);
  const Relief relief(map.heights, map.data.origin, spec.width * spec.depth);
  for (double x : {-150.0, 0.0, 150.0})
    for (double hand : {-1.0, 1.0}) {
      const double middle = relief.At({x, 0}), edge = relief.At({x, hand * spec.depth / 2});
      EXPECT_GT(edge - middle, 20) << x;
      EXPECT_GT(relief.At({x, hand * (spec.depth / 2 + 500)}) - edge, 70) << x;
    }
}

TEST(TownMap, TheSeaSurroundsAnIsland) {
  TownSpec spec{.relief = TownRelief::kHill, .water = TownWater::kIsland};
  for (uint64_t seed : {0u, 1u, 2u}) {
    const TownMap map = DrawTown(spec, seed);
    for (int i = 0; i < 72; ++i) {
      const double a = 6.2831853 * i / 72;
      EXPECT_TRUE(WetAt(map, {0.78 * spec.width * std::cos(a), 0.78 * spec.depth * std::sin(a)})) << i;
      EXPECT_FALSE(WetAt(map, {0.4 * spec.width * std::cos(a), 0.4 * spec.depth * std::sin(a)})) << i;
      EXPECT_TRUE(WetAt(map, {1200 * std::cos(a), 1200 * std::sin(a)})) << i;
    }
    for (const TownStreet& street : map.streets)
      for (Vec2d p : street.line) EXPECT_FALSE(WetAt(map, p));
    const Relief relief(map.heights, map.data.origin, spec.width * spec.depth);
    const double shore = relief.At({0, -0.49 * spec.depth});
    EXPECT_NEAR(relief.At({0.49 * spec.width, 0}), shore, 0.5);
    EXPECT_GT(relief.At({0, 0.17 * spec.depth}) - shore, 8);
  }
}

TEST(TownMap, ARiverThroughTheMiddleIsThere) {
  for (const TownWater water : {TownWater::kRiver, TownWater::kCanal, TownWater::kLake})
    for (const bool central : {false, true}) {
      TownSpec spec{.water = water};
      spec.central_water = central;
      const TownMap map = DrawTown(spec, 4);
      bool middle = false;
      for (double y = -0.1 * spec.depth; y <= 0.1 * spec.depth; y += 1) middle = middle || WetAt(map, {0, y});
      EXPECT_EQ(middle, central) << static_cast<int>(water);
    }
}

// In open country a river goes on to the hills of the horizon, which begin 2,400 m from the middle.
TEST(TownMap, RiversRunToTheHorizon) {
  for (const TownWater water : {TownWater::kRiver, TownWater::kCanal}) {
    const TownSpec spec{.water = water, .country = TownCountry::kFields};
    const TownMap map = DrawTown(spec, 3);
    ASSERT_GE(map.river.size(), 2u);
    EXPECT_LT(map.river.front().x, -2500);
    EXPECT_GT(map.river.back().x, 2500);
    for (size_t i = 0; i + 1 < map.river.size(); ++i)
      for (double hand : {-0.9, 0.1, 0.9})
        EXPECT_TRUE(WetAt(map, (map.river[i] + map.river[i + 1]) * 0.5 + Vec2d{0, hand * map.river_half})) << i;
  }
}

TEST(TownMap, BusStopsStandAtMainStreetsNearCorners) {
  TownSpec spec;
  spec.street = 15;
  spec.bus_stops = true;
  const TownMap map = DrawTown(spec, 0);
  int stops = 0;
  for (const OsmNode& node : map.data.nodes) {
    if (!node.tags.Is("highway", "bus_stop")) continue;
    ++stops;
    double street = 1e9, corner = 1e9;
    for (const TownStreet& s : map.streets) {
      street = std::min(street, DistanceToLine(s.line, node.p) - s.half);
      corner = std::min(corner, std::hypot(s.line[0].x - node.p.x, s.line[0].y - node.p.y));
    }
    EXPECT_NEAR(street, 0.4, 0.2);
    EXPECT_LT(corner, 30);
  }
  EXPECT_GE(stops, 2);
}

TEST(TownMap, ForestsAreAsDenseAsTreesSay) {
  size_t before = 0;
  for (double trees : {0.0, 0.4, 1.0, 1.4}) {
    TownSpec spec{.country = TownCountry::kForest};
    spec.trees = trees;
    const TownMap map = DrawTown(spec, 0);
    const auto count = static_cast<size_t>(
        std::count_if(map.data.nodes.begin(), map.data.nodes.end(), [](const OsmNode& node) { return node.tags.Is("natural", "tree"); }));
    EXPECT_GE(static_cast<double>(count), 1.2 * static_cast<double>(before)) << trees;
    EXPECT_EQ(count == 0, trees == 0);
    before = count;
  }
}

TEST(TownMap, HousesAreAsManyAndAsHighAsSaid) {
  TownSpec spec;
  spec.houses = 17;
  spec.least_floors = spec.most_floors = 3;
  const TownMap map = DrawTown(spec, 1);
  const std::vector<OsmArea> areas = FindAreas(map.data), houses = HousesOf(areas);
  EXPECT_EQ(houses.size(), 17u);
  for (const OsmArea& house : houses) {
    const double height = ParseOsmLength(house.tags->Get("height"), 100).value_or(0);
    EXPECT_GT(height, 8);
    EXPECT_LT(height, 18.5);
  }
}

TEST(TownMap, ParksWithoutTreesSayThatTheyHaveNone) {
  for (double trees : {0.0, 1.0}) {
    TownSpec spec;
    spec.trees = trees;
    spec.parks = 2;
    const TownMap map = DrawTown(spec, 0);
    int parks = 0;
    for (const OsmWay& way : map.data.ways)
      if (way.tags.Is("leisure", "park")) {
        ++parks;
        EXPECT_EQ(way.tags.Is("trees", "none"), trees == 0);
      }
    EXPECT_EQ(parks, 2);
  }
}

TEST(TownSpec, FieldsThatExcludeEachOtherAreRefused) {
  const auto refused = [](const auto& change) {
    TownSpec spec;
    change(spec);
    EXPECT_THROW(spec.Check("town: "), InputError);
  };
  refused([](TownSpec& s) { s.least_floors = 9; });
  refused([](TownSpec& s) { s.harbour = true; });
  refused([](TownSpec& s) { s.squares = 5; });
  refused([](TownSpec& s) { s.houses = 5000; });
  refused([](TownSpec& s) { s.market = true, s.squares = 0; });
  refused([](TownSpec& s) { s.terrace = true; });
  refused([](TownSpec& s) { s.relief = TownRelief::kHill, s.climb = 119; });
  for (const char* name : kNames) EXPECT_NO_THROW(NamedTown(name).Check(""));
}

}  // namespace
}  // namespace airsim360::internal
