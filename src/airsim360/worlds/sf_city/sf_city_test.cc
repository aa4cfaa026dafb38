#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "airsim360/worlds/sf_city/city.h"
#include "airsim360/worlds/town/street_markings.h"

namespace airsim360::internal {
namespace {

const StreetPlan& Plan() {
  static const StreetPlan plan = PlanSfCity();
  return plan;
}
const Hills& TheHills() {
  static const Hills hills(Plan());
  return hills;
}
const SfPlan& City() {
  static const SfPlan city = PlanSfBuildings(Plan(), TheHills(), 0);
  return city;
}

// Slope of the laid ground along a centre line, in W, over a metre.
float SlopeAt(Vec2f p, Vec2f along) {
  const Vec3f a = TheHills().drape().At({p.x - along.x / 2, p.y - along.y / 2, 0}),
              b = TheHills().drape().At({p.x + along.x / 2, p.y + along.y / 2, 0});
  return std::abs(b.z - a.z) / std::hypot(b.x - a.x, b.y - a.y);
}

template <class Visit>
void AlongStreets(const Visit& visit) {
  for (int i = 1; i <= 7; ++i) {
    for (float s = -270; s < 275; s += 1.7f) visit(Vec2f{Plan().north_south[static_cast<size_t>(i)].center, s}, Vec2f{0, 1});
    for (float s = -360; s < 370; s += 1.7f) visit(Vec2f{s, Plan().east_west[static_cast<size_t>(i)].center}, Vec2f{1, 0});
  }
}

TEST(SfHills, SteepestStreetIsAsSteepAsSanFranciscos) {
  float most = 0;
  int steep = 0, level = 0, all = 0;
  AlongStreets([&](Vec2f p, Vec2f along) {
    const float slope = SlopeAt(p, along);
    most = std::max(most, slope);
    steep += slope > 0.12f;
    level += slope < 0.02f;
    ++all;
  });
  EXPECT_GT(most, 0.28f);
  EXPECT_LT(most, 0.32f);
  EXPECT_GT(steep, all / 12) << "a hill town";
  EXPECT_GT(level, all / 4) << "downtown and crossings";
}

TEST(SfHills, StreetsAreLevelAcrossAndCrossingsLevel) {
  AlongStreets([&](Vec2f p, Vec2f along) {
    const Vec2f across{along.y, along.x};
    for (float d : {-5.0f, 5.0f}) EXPECT_LT(std::abs(TheHills().Height(p + across * d) - TheHills().Height(p)), 0.02f);
  });
  for (const StreetLine& ns : Plan().north_south)
    for (const StreetLine& ew : Plan().east_west)
      for (Vec2f d : {Vec2f{4, 4}, {-4, 4}, {4, -4}})
        EXPECT_NEAR(TheHills().Height({ns.center + d.x, ew.center + d.y}), TheHills().Height({ns.center, ew.center}), 0.01f);
}

TEST(SfHills, StreetsOfTheHillsBend) {
  // The street at x = -244 leaves the line between its ends by metres; the boulevard does not.
  const auto stray = [&](float x) {
    float most = 0;
    for (float y = -270; y < 275; y += 3) most = std::max(most, std::abs(TheHills().Ground({x, y}).x - x));
    return most;
  };
  EXPECT_GT(stray(-244), 6);
  EXPECT_LT(stray(0), 0.05f);
}

TEST(SfPlan, HasRoomToFlyOverTheAreaOfThePaper) { EXPECT_GE(FreeSfGround(Plan(), City()), 250000); }

TEST(SfPlan, HousesOfARowDoNotOverlapAndStepWithTheHill) {
  int stepped = 0, rows = 0;
  for (size_t i = 0; i + 1 < City().houses.size(); ++i) {
    const RowHouse &a = City().houses[i], &b = City().houses[i + 1];
    if (a.block != b.block || a.along != b.along) continue;
    ++rows;
    const Vec2f gap = b.origin - a.At(a.shape.width, 0);
    EXPECT_LT(std::hypot(gap.x, gap.y), 0.01f);
    stepped += std::abs(a.ground - b.ground) > 0.3f;
  }
  EXPECT_GT(stepped, rows / 4);
}

// No house floats, none is buried: its walls reach the ground everywhere, its door lies at it.
TEST(SfPlan, HousesStandOnTheirGround) {
  for (const RowHouse& house : City().houses) {
    const BayHouse& h = house.shape;
    for (Vec2f p : {house.At(0, 0), house.At(h.width, 0), house.At(0, h.depth), house.At(h.width, h.depth)})
      EXPECT_LT(house.ground - h.foot, TheHills().Height(p) - 0.3f);
    const float stoop = TheHills().Height(house.At(BayHouseStoop(h), 0));
    EXPECT_LE(stoop, house.ground + 0.3f);
    EXPECT_GE(stoop, house.ground - 1.6f);
    EXPECT_LT(house.rear, h.height()) << "a roof below the yard";
  }
  for (const PlacedBuilding& building : City().buildings) {
    if (building.plan.base > 0) continue;
    for (Vec2f p : building.plan.outline) {
      EXPECT_LE(TheHills().Height(p), building.ground + 1e-3f);
      EXPECT_GT(TheHills().Height(p), building.ground - building.foot);
    }
  }
}

TEST(SfPlan, NoTwoHousesOfOneSeed) {
  std::set<uint64_t> seeds;
  for (const RowHouse& house : City().houses) EXPECT_TRUE(seeds.insert(house.shape.seed).second);
  EXPECT_GT(seeds.size(), 500u);
}

// Props: fences follow the slope, cars lean with it, posts stay upright.
TEST(SlopeLay, LeansWhatRollsAndKeepsPostsUpright) {
  const SlopeLay lay(TheHills());
  Vec2f at{-244, 0};
  float most = 0;
  for (float y = 20; y < 270; y += 1)
    if (const float s = SlopeAt({-244, y}, {0, 1}); s > most) most = s, at.y = y;
  ASSERT_GT(most, 0.1f);
  const AffineTransform placed = PlaceUpright({at.x, at.y, 0.5f}, 0.4f), post = lay("hill_lamp", placed), car = lay("car", placed),
                        fence = lay("wood_fence", placed);
  const auto up = [](const AffineTransform& X) { return Vec3f{X.A.m[0][2], X.A.m[1][2], X.A.m[2][2]}; };
  EXPECT_LT(Norm(up(post) - Vec3f{0, 0, 1}), 1e-5f);
  EXPECT_LT(Norm(up(fence) - Vec3f{0, 0, 1}), 1e-5f);
  EXPECT_NEAR(std::acos(up(car).z), std::atan(most), 0.03f);
  EXPECT_NEAR(Norm(up(car)), 1, 1e-4f);
  EXPECT_NEAR(post.p.z, TheHills().drape().At({at.x, at.y, 0.5f}).z, 1e-4f);
}

}  // namespace
}  // namespace airsim360::internal
