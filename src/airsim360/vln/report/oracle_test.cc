// The oracle in a made-up town where the straight line to the goal leads into a bay.
#include <gtest/gtest.h>

#include "airsim360/planning/routes/search.h"
#include "airsim360/vln/flights/run_episodes.h"
#include "airsim360/vln/predicates/test_town.h"

namespace airsim360 {
namespace {

// Three walls of 40 m, open towards the start.
std::shared_ptr<Stage> Bay() {
  TestTown town;
  town.Box("street", "ground/road", {0, 0, 0}, {300, 300, 1}, -1);
  town.Box("back", "construction/building", {0, 0, 0}, {4, 60, 40});
  for (const float y : {-28.0f, 28.0f}) town.Box("side", "construction/building", {-20, y, 0}, {40, 4, 40});
  return std::make_shared<Stage>(town.Build());
}

LanguageEpisode Around() {
  LanguageEpisode e;
  e.id = "bay/0";
  e.instruction = "Fly around the building.";
  e.world = "bay";
  e.ref = {{-45, 0, 5}, {-45, 40, 5}, {10, 40, 5}, {30, 0, 5}};
  e.start = {e.ref.front(), 0};
  e.goal = e.ref.back();
  e.geodesic_length = PolylineLength(e.ref);
  return e;
}

TEST(OracleAgent, GoesAroundABayThatLiesOnTheStraightLine) {
  const auto stage = Bay();
  for (const char* protocol : {"aerialvln", "openfly", "citynav", "uavon", "ours", "traveluav"}) {
    VlnRunOptions options;
    options.protocol = protocol;
    options.open = [&](const std::string&, uint64_t, int64_t) { return stage; };
    const VlnResult result = RunEpisodes({Around()}, options).front();
    EXPECT_TRUE(result.success) << protocol << ": " << result.explanation;
    EXPECT_FALSE(result.collided) << protocol;
  }
}

// 16 m flown where the episode says 4 m, and its reference, whose points files round, 4.0004 m.
TEST(ScoreOf, TakesTheShortestWayThatTheEpisodeSays) {
  VlnResult result;
  result.protocol = "ours";
  result.ref = {{0, 0, 5}, {4.0004, 0, 5}};
  result.pred = {{0, 0, 5}, {10, 0, 5}, {4, 0, 5}};
  result.goal = {4, 0, 5};
  result.radius = 1;
  result.stopped = true;
  result.geodesic_length = 4;
  EXPECT_DOUBLE_EQ(ScoreOf(result).spl, 0.25);
  result.geodesic_length = 0;  // not said
  EXPECT_DOUBLE_EQ(ScoreOf(result).spl, 4.0004 / 16);
}

TEST(OracleAgent, FliesALegThatTakesLongerThanOneDecisionMay) {
  TestTown town;
  town.Box("street", "ground/road", {0, 0, 0}, {800, 60, 1}, -1);
  const auto stage = std::make_shared<Stage>(town.Build());
  LanguageEpisode e = Around();
  e.ref.clear();
  for (int k = 0; k <= 140; ++k) e.ref.push_back({-175 + 2.5 * k, 0, 5});
  e.start = {e.ref.front(), 0};
  e.goal = e.ref.back();
  e.geodesic_length = PolylineLength(e.ref);
  VlnRunOptions options;
  options.open = [&](const std::string&, uint64_t, int64_t) { return stage; };
  const VlnResult result = RunEpisodes({e}, options).front();
  EXPECT_TRUE(result.success) << result.explanation;
  EXPECT_EQ(result.decisions, 2);
}

}  // namespace
}  // namespace airsim360
