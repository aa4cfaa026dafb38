// The drawn town against real ones: Kolmogorov-Smirnov distances to the quantiles of data/osm/distributions.csv.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/worlds/osm/buildings/osm_areas.h"
#include "airsim360/worlds/osm/test_real_towns.h"
#include "airsim360/worlds/osm/town_map.h"

namespace airsim360::internal {
namespace {

struct Figures {
  std::vector<double> areas, heights, trees, lamps;
};
Figures Measure(const OsmData& map) {
  Figures figures;
  for (const OsmArea& area : FindAreas(map)) {
    if (!area.tags->Has("building")) continue;
    figures.areas.push_back(area.area);
    figures.heights.push_back(*ParseOsmLength(area.tags->Get("height"), 1000));
  }
  std::vector<Vec2d> trees, lamps;
  for (const OsmNode& node : map.nodes) {
    if (node.tags.Is("natural", "tree")) trees.push_back(node.p);
    if (node.tags.Is("highway", "street_lamp")) lamps.push_back(node.p);
  }
  figures.trees = NearestDistances(trees);
  figures.lamps = NearestDistances(lamps);
  return figures;
}

TEST(TownMap, TheStatisticKnowsEqualAndDifferentDistributions) {
  Quantiles uniform;
  std::vector<double> same, half;
  for (int i = 0; i <= 40; ++i) uniform.push_back(i / 40.0);
  for (int i = 0; i < 400; ++i) same.push_back((i + 0.5) / 400), half.push_back((i + 0.5) / 800);
  EXPECT_LT(KolmogorovSmirnov(same, uniform), 0.005);
  EXPECT_NEAR(KolmogorovSmirnov(half, uniform), 0.5, 0.005);
}

TEST(TownMap, LotsHeightsTreesAndLampsAreDistributedAsInRealTowns) {
  const std::map<std::string, Quantiles> real = RealTowns();
  // Three towns together, as the figures of the real ones are of several streets.
  Figures all;
  const auto append = [](std::vector<double>& to, const std::vector<double>& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (uint64_t seed : {0u, 1u, 7u}) {
    const Figures figures = Measure(DrawTownMap(seed));
    append(all.areas, figures.areas);
    append(all.heights, figures.heights);
    append(all.trees, figures.trees);
    append(all.lamps, figures.lamps);
  }
  const double areas = KolmogorovSmirnov(all.areas, real.at("building_area_m2")),
               heights = KolmogorovSmirnov(all.heights, real.at("building_height_m")),
               trees = KolmogorovSmirnov(all.trees, real.at("tree_spacing_m")),
               lamps = KolmogorovSmirnov(all.lamps, real.at("lamp_spacing_m"));
  std::printf("%zu houses, %zu trees, %zu lamps; Kolmogorov-Smirnov: area %.3f height %.3f trees %.3f lamps %.3f\n", all.areas.size(),
              all.trees.size(), all.lamps.size(), areas, heights, trees, lamps);
  EXPECT_LE(areas, 0.25);
  EXPECT_LE(heights, 0.25);
  EXPECT_LE(trees, 0.25);
  EXPECT_LE(lamps, 0.25);
}

TEST(TownMap, HousesDoNotOverlap) {
  const OsmData map = DrawTownMap(3);
  Patches all;
  double sum = 0;
  for (const OsmArea& area : FindAreas(map)) {
    if (!area.tags->Has("building")) continue;
    all.insert(all.end(), area.patches.begin(), area.patches.end());
    sum += area.area;
  }
  EXPECT_NEAR(Area(Unite(all)) / sum, 1, 1e-4);
}

}  // namespace
}  // namespace airsim360::internal
