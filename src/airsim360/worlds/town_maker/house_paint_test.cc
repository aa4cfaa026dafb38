// Paint of the houses of drawn towns, beside what photographs show.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "airsim360/worlds/osm/buildings/osm_facade.h"
#include "airsim360/worlds/osm/data/osm_data.h"
#include "airsim360/worlds/town_maker/town_styles.h"

namespace airsim360 {
namespace {

using namespace internal;

float Encoded(float c) { return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f; }
double SaturationOf(Vec3f c) {
  const float most = Encoded(std::max({c.x, c.y, c.z})), least = Encoded(std::min({c.x, c.y, c.z}));
  return (most - least) / static_cast<double>(most);
}
double LightOf(Vec3f c) {
  return 0.2126 * static_cast<double>(c.x) + 0.7152 * static_cast<double>(c.y) + 0.0722 * static_cast<double>(c.z);
}

// Warm pixels of fourteen photographs have saturations of 0.07 to 0.52 in the middle and up to 0.69 in the 95th hundredth
// (HSV of display values).
constexpr double kMiddleOfPhotographs[] = {0.07, 0.52}, kMostOfPhotographs = 0.69;

class EveryStyleOfHouses : public testing::TestWithParam<TownStyle> {};
INSTANTIATE_TEST_SUITE_P(Styles, EveryStyleOfHouses, testing::Values(TownStyle::kAzulejo, TownStyle::kOchre, TownStyle::kBrick));

TEST_P(EveryStyleOfHouses, PaintIsAsFaintAsInPhotographsAndNoTwoHousesAreAlike) {
  std::vector<double> saturation;
  std::set<std::tuple<int, int, int>> seen;
  uint64_t seed = 0;
  for (std::string_view name : StyleOf(GetParam()).colours) {
    const Vec3f paint = *ParseOsmColour(name);
    std::vector<double> light;
    for (int i = 0; i < 60; ++i) {
      const Vec3f c = WeatheredPaint(paint, MixBits(++seed));
      saturation.push_back(SaturationOf(c));
      light.push_back(LightOf(c) / LightOf(paint));
      EXPECT_LE(SaturationOf(c), SaturationOf(paint) + 0.08) << name;
      seen.insert({static_cast<int>(255 * Encoded(c.x)), static_cast<int>(255 * Encoded(c.y)), static_cast<int>(255 * Encoded(c.z))});
    }
    // Neighbours of one paint differ by a tenth.
    double mean = 0, square = 0;
    for (double l : light) mean += l / 60, square += l * l / 60;
    EXPECT_GT(std::sqrt(square - mean * mean) / mean, 0.06) << name;
    EXPECT_NEAR(mean, 0.94, 0.05) << name;
  }
  std::sort(saturation.begin(), saturation.end());
  const double middle = saturation[saturation.size() / 2], most = saturation[saturation.size() * 19 / 20];
  EXPECT_GT(middle, kMiddleOfPhotographs[0]);
  EXPECT_LT(middle, kMiddleOfPhotographs[1]);
  EXPECT_LT(most, kMostOfPhotographs);
  EXPECT_GT(seen.size(), 0.9 * static_cast<double>(saturation.size()));
}

}  // namespace
}  // namespace airsim360
