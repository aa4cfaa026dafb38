// The drawn town against real ones: Kolmogorov-Smirnov distances to the quantiles of data/osm/distributions.csv.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

#include "airsim360/base/file.h"
#include "airsim360/worlds/osm/osm_areas.h"
#include "airsim360/worlds/osm/town_map.h"

namespace airsim360::internal {
namespace {

using Quantiles = std::vector<double>;

std::map<std::string, Quantiles> RealTowns() {
  std::map<std::string, Quantiles> rows;
  std::istringstream lines(ReadTextFile("data/osm/distributions.csv"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#') || line.starts_with("name")) continue;
    std::istringstream fields(line);
    std::string name, field;
    std::getline(fields, name, ',');
    std::getline(fields, field, ',');  // count
    while (std::getline(fields, field, ',')) rows[name].push_back(std::stod(field));
  }
  return rows;
}

// Largest distance between the share of samples up to x and that of the reference, which is linear between its
// quantiles (and jumps where several are equal).
double KolmogorovSmirnov(std::vector<double> samples, const Quantiles& q) {
  std::sort(samples.begin(), samples.end());
  const auto n = static_cast<double>(samples.size());
  // Share of the reference below x and up to x.
  const auto share = [&](double x, bool upto) {
    const auto it = upto ? std::upper_bound(q.begin(), q.end(), x) : std::lower_bound(q.begin(), q.end(), x);
    if (it == q.begin()) return 0.0;
    if (it == q.end()) return 1.0;
    const double low = *(it - 1), high = *it;
    const double t = high > low ? (x - low) / (high - low) : 0;
    return (static_cast<double>(it - q.begin()) - 1 + t) / static_cast<double>(q.size() - 1);
  };
  double worst = 0;
  const auto look = [&](double x) {
    const auto below = static_cast<double>(std::lower_bound(samples.begin(), samples.end(), x) - samples.begin());
    const auto upto = static_cast<double>(std::upper_bound(samples.begin(), samples.end(), x) - samples.begin());
    worst = std::max({worst, std::abs(upto / n - share(x, true)), std::abs(below / n - share(x, false))});
  };
  for (double x : samples) look(x);
  for (double x : q) look(x);
  return worst;
}

std::vector<double> NearestDistances(const std::vector<Vec2d>& places) {
  std::vector<double> distances;
  for (size_t i = 0; i < places.size(); ++i) {
    double best = 1e18;
    for (size_t k = 0; k < places.size(); ++k)
      if (k != i) best = std::min(best, std::hypot(places[i].x - places[k].x, places[i].y - places[k].y));
    distances.push_back(best);
  }
  return distances;
}

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
  std::map<std::string, Quantiles> real = RealTowns();
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
