#include "airsim360/worlds/building/massing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

namespace airsim360 {
namespace {

TEST(Massing, BuildingsOfABlockDoNotOverlapAndKeepOffThePavement) {
  const StreetPlan plan = PlanDowntownWest();
  for (uint64_t seed : {0u, 1u, 7u}) {
    const std::vector<BuildingPlan> buildings = PlanBuildings(plan, seed);
    for (size_t i = 0; i < buildings.size(); ++i) {
      const GroundRect a = buildings[i].bounds(), inner = plan.blocks[buildings[i].block].inner().Inset(-0.001f);
      EXPECT_TRUE(inner.Contains({a.x0, a.y0}) && inner.Contains({a.x1, a.y1}));
      for (size_t k = i + 1; k < buildings.size() && buildings[k].block == buildings[i].block; ++k) {
        const GroundRect b = buildings[k].bounds();
        const bool apart = a.x1 <= b.x0 + 0.01f || b.x1 <= a.x0 + 0.01f || a.y1 <= b.y0 + 0.01f || b.y1 <= a.y0 + 0.01f;
        EXPECT_TRUE(apart) << "seed " << seed << " buildings " << i << " and " << k;
      }
    }
  }
}

TEST(Massing, OutlinesAreConvexCounterClockwiseWithAnEdgeKindEach) {
  for (const BuildingPlan& building : PlanBuildings(PlanDowntownWest(), 3)) {
    const size_t n = building.outline.size();
    ASSERT_EQ(building.edges.size(), n);
    ASSERT_EQ(building.party_height.size(), n);
    for (size_t i = 0; i < n; ++i) {
      const Vec2f a = building.outline[i], b = building.outline[(i + 1) % n], c = building.outline[(i + 2) % n];
      EXPECT_GT((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x), 0);
    }
  }
}

TEST(Massing, EveryPartyWallHasANeighbour) {
  for (const BuildingPlan& building : PlanBuildings(PlanDowntownWest(), 0)) {
    for (size_t e = 0; e < building.edges.size(); ++e) {
      EXPECT_EQ(building.edges[e] == EdgeKind::kParty, building.party_height[e] > 0);
    }
  }
}

TEST(Massing, NoTwoBuildingsAreTwins) {
  std::set<std::pair<uint64_t, float>> seen;
  for (const BuildingPlan& building : PlanBuildings(PlanDowntownWest(), 0)) {
    EXPECT_TRUE(seen.insert({building.seed, building.bounds().area()}).second);
  }
}

TEST(Massing, OffsettingAConvexOutlineInAndOutGivesItBack) {
  const std::vector<Vec2f> outline = {{0, 0}, {8, 0}, {10, 3}, {9, 9}, {1, 7}};
  const std::vector<Vec2f> back = OffsetConvex(OffsetConvex(outline, 0.7f), -0.7f);
  for (size_t i = 0; i < outline.size(); ++i) {
    EXPECT_NEAR(back[i].x, outline[i].x, 1e-4);
    EXPECT_NEAR(back[i].y, outline[i].y, 1e-4);
  }
}

}  // namespace
}  // namespace airsim360
