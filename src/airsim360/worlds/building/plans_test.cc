// Plans of streets and buildings, from many seeds: what is built on them relies on these.
#include <gtest/gtest.h>

#include "airsim360/base/error.h"
#include "airsim360/worlds/building/massing.h"
#include "airsim360/worlds/kit/test_mesh.h"
#include "airsim360/worlds/worlds.h"

namespace airsim360 {
namespace {

using namespace internal;

struct Town {
  const char* name;
  StreetPlan (*plan)();
};
void PrintTo(const Town& town, std::ostream* out) { *out << town.name; }

class EveryTownPlan : public testing::TestWithParam<Town> {
 protected:
  StreetPlan plan = GetParam().plan();
};

INSTANTIATE_TEST_SUITE_P(Plans, EveryTownPlan,
                         testing::Values(Town{"downtown_west", PlanDowntownWest}, Town{"new_york_city", PlanNewYorkCity}),
                         [](const auto& info) { return info.param.name; });

TEST_P(EveryTownPlan, BlocksLieBetweenTheKerbsOfTheirStreets) {
  ASSERT_EQ(plan.blocks.size(), (plan.north_south.size() - 1) * (plan.east_west.size() - 1));
  for (const Block& block : plan.blocks) {
    const auto c = static_cast<size_t>(block.column), r = static_cast<size_t>(block.row);
    EXPECT_FLOAT_EQ(block.kerb.x0, plan.north_south[c].center + plan.north_south[c].half_width);
    EXPECT_FLOAT_EQ(block.kerb.x1, plan.north_south[c + 1].center - plan.north_south[c + 1].half_width);
    EXPECT_FLOAT_EQ(block.kerb.y0, plan.east_west[r].center + plan.east_west[r].half_width);
    EXPECT_FLOAT_EQ(block.kerb.y1, plan.east_west[r + 1].center - plan.east_west[r + 1].half_width);
    EXPECT_GT(block.inner().width(), 20);
    EXPECT_GT(block.inner().depth(), 20);
    EXPECT_GT(block.corner_radius, block.pavement);
  }
}

TEST_P(EveryTownPlan, BlocksAndStreetsTileTheGround) {
  double blocks = 0, streets = 0, crossings = 0;
  const double width = static_cast<double>(plan.north_south.back().center - plan.north_south.front().center);
  const double depth = static_cast<double>(plan.east_west.back().center - plan.east_west.front().center);
  for (const Block& block : plan.blocks) blocks += static_cast<double>(block.kerb.area());
  // Half of the outermost streets lies beyond their centre lines.
  const auto inside = [](const std::vector<StreetLine>& lines) {
    double sum = 0;
    for (size_t i = 0; i < lines.size(); ++i) sum += static_cast<double>(lines[i].half_width) * (i == 0 || i + 1 == lines.size() ? 1 : 2);
    return sum;
  };
  streets = inside(plan.north_south) * depth + inside(plan.east_west) * width;
  crossings = inside(plan.north_south) * inside(plan.east_west);
  EXPECT_NEAR(blocks + streets - crossings, width * depth, 1e-3 * width);
}

TEST_P(EveryTownPlan, ReachHoldsTheCoreAndNothingOfTheRing) {
  const GroundRect reach = plan.reach();
  for (const Block& block : plan.blocks) {
    const bool core =
        block.column >= plan.first_core && block.column < plan.last_core && block.row >= plan.first_core && block.row < plan.last_core;
    EXPECT_EQ(core, block.kind != BlockKind::kBackdrop);
    const GroundRect inner = block.inner().Inset(0.01f);
    EXPECT_EQ(core, reach.Contains(inner.center()));
    EXPECT_EQ(core, reach.Contains({inner.x0, inner.y0}) || reach.Contains({inner.x1, inner.y1}));
  }
  for (const auto* lines : {&plan.north_south, &plan.east_west})
    for (size_t i = 0; i + 1 < lines->size(); ++i) EXPECT_GT((*lines)[i + 1].center, (*lines)[i].center);
}

class EverySeedOfPlans : public testing::TestWithParam<int> {
 protected:
  uint64_t seed() const { return static_cast<uint64_t>(GetParam()); }
  StreetPlan plan = PlanDowntownWest();
  std::vector<BuildingPlan> buildings = PlanBuildings(plan, seed());
};

INSTANTIATE_TEST_SUITE_P(Plans, EverySeedOfPlans, testing::Range(0, 10));

TEST_P(EverySeedOfPlans, BuildingsAreAsHighAsTheirStoreys) {
  for (const BuildingPlan& b : buildings) {
    const StyleMetrics& metrics = MetricsOf(b.style);
    EXPECT_FLOAT_EQ(b.height(), metrics.ground_height + static_cast<float>(b.floors) * metrics.floor_height);
    EXPECT_GE(b.floors, 2);
    EXPECT_LE(b.floors, plan.blocks[b.block].kind == BlockKind::kBackdrop ? 17 : 12);
    EXPECT_LT(b.palette, metrics.palettes);
    EXPECT_LE(b.style, FacadeStyle::kRibbon);  // the others are New York's
    const bool hip = b.roof == RoofKind::kHipTile || b.roof == RoofKind::kHipSlate;
    EXPECT_TRUE(!hip || b.outline.size() == 4) << "hips need rectangles";
  }
}

TEST_P(EverySeedOfPlans, StreetWallsStandOnTheBuildingLineAndRearsDoNot) {
  for (const BuildingPlan& b : buildings) {
    const GroundRect inner = plan.blocks[b.block].inner();
    for (size_t e = 0; e < b.edges.size(); ++e) {
      const Vec2f p = b.outline[e], q = b.outline[(e + 1) % b.outline.size()], m = (p + q) * 0.5f;
      const float off = std::min({m.x - inner.x0, inner.x1 - m.x, m.y - inner.y0, inner.y1 - m.y});
      const bool diagonal = std::abs(p.x - q.x) > 0.01f && std::abs(p.y - q.y) > 0.01f;
      if (b.edges[e] == EdgeKind::kStreet) {
        EXPECT_LE(off, diagonal ? 2.01f : 0.001f);
      } else {
        EXPECT_GT(off, 0.5f);
      }
    }
  }
}

// Brute force: what is behind a party wall, asked of all buildings of the block.
TEST_P(EverySeedOfPlans, PartyWallsAreAsHighAsTheHouseBehindThem) {
  for (size_t i = 0; i < buildings.size(); ++i) {
    const BuildingPlan& b = buildings[i];
    for (size_t e = 0; e < b.edges.size(); ++e) {
      if (b.edges[e] != EdgeKind::kParty) continue;
      const Vec2f p = b.outline[e], v = b.outline[(e + 1) % b.outline.size()] - p;
      const Vec2f at = p + v * 0.5f + Vec2f{v.y, -v.x} * (0.4f / std::hypot(v.x, v.y));
      float behind = 0;
      for (const BuildingPlan& other : buildings)
        if (&other != &b && other.bounds().Contains(at)) behind = other.height();
      EXPECT_FLOAT_EQ(b.party_height[e], behind);
    }
  }
}

TEST_P(EverySeedOfPlans, FreeGroundIsWhatARasterFinds) {
  const GroundRect reach = plan.reach();
  double free = 0;
  constexpr float kCell = 2;
  std::vector<std::vector<const BuildingPlan*>> by_block(plan.blocks.size());
  for (const BuildingPlan& b : buildings) by_block[b.block].push_back(&b);
  for (float x = reach.x0 + kCell / 2; x < reach.x1; x += kCell) {
    for (float y = reach.y0 + kCell / 2; y < reach.y1; y += kCell) {
      bool built = false;
      for (size_t k = 0; k < plan.blocks.size() && !built; ++k) {
        if (!plan.blocks[k].kerb.Contains({x, y})) continue;
        for (const BuildingPlan* b : by_block[k]) {
          bool inside = true;
          for (size_t i = 0; i < b->outline.size(); ++i) {
            const Vec2f p = b->outline[i], q = b->outline[(i + 1) % b->outline.size()];
            inside = inside && (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x) >= 0;
          }
          built = built || inside;
        }
      }
      free += built ? 0 : kCell * kCell;
    }
  }
  EXPECT_NEAR(FreeGroundArea(plan, buildings), free, 0.01 * free);
}

TEST_P(EverySeedOfPlans, CourtyardsAreOpen) {
  for (const BuildingPlan& b : buildings) {
    const GroundRect court = CourtyardOf(plan.blocks[b.block]).Inset(0.01f), box = b.bounds();
    EXPECT_TRUE(box.x1 <= court.x0 || box.x0 >= court.x1 || box.y1 <= court.y0 || box.y0 >= court.y1);
  }
}

TEST_P(EverySeedOfPlans, FollowFromTheirSeed) {
  const auto same = [](const std::vector<BuildingPlan>& a, const std::vector<BuildingPlan>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const BuildingPlan& x, const BuildingPlan& y) {
      return x.outline == y.outline && x.edges == y.edges && x.party_height == y.party_height && x.floors == y.floors &&
             x.style == y.style && x.palette == y.palette && x.roof == y.roof && x.seed == y.seed;
    });
  };
  EXPECT_TRUE(same(buildings, PlanBuildings(plan, seed())));
  EXPECT_FALSE(same(buildings, PlanBuildings(plan, seed() + 1)));
}

TEST(StylesOf, AnUnknownNameIsAnInputErrorWithTheNearest) {
  EXPECT_EQ(StylesOf(FacadeStyleNames()).size(), static_cast<size_t>(FacadeStyle::kCount));
  try {
    StylesOf({"ribbon", "brownstne"});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("brownstone"), std::string::npos) << error.what();
  }
}

class EveryConvexOutline : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Plans, EveryConvexOutline, testing::Range(3, 12));

// Moved inwards by d, an outline loses perimeter times d and gains d^2 times the tangents of half its turns.
TEST_P(EveryConvexOutline, LosesItsRimWhenMovedInwards) {
  std::vector<Vec2f> outline;
  for (int i = 0; i < GetParam(); ++i) {
    const float a = 6.2831853f * (static_cast<float>(i) + 0.3f * std::sin(2.1f * static_cast<float>(i))) / static_cast<float>(GetParam());
    outline.push_back({9 * std::cos(a), 14 * std::sin(a)});
  }
  double perimeter = 0, tangents = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vec2f a = outline[i], b = outline[(i + 1) % outline.size()], c = outline[(i + 2) % outline.size()], u = b - a, v = c - b;
    perimeter += std::hypot(u.x, u.y);
    const double turn = std::atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y);
    ASSERT_GT(turn, 0);
    tangents += std::tan(turn / 2);
  }
  for (float d : {0.3f, 1.0f, -0.5f}) {
    const double expected = Shoelace(outline) - perimeter * static_cast<double>(d) + static_cast<double>(d * d) * tangents;
    EXPECT_NEAR(Shoelace(OffsetConvex(outline, d)), expected, 1e-3 * expected) << d;
  }
}

}  // namespace
}  // namespace airsim360
