#include "airsim360/scene/road_network.h"

#include <gtest/gtest.h>

#include <functional>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// Two lanes in a circle.
RoadNetwork Loop() {
  RoadNetwork roads;
  roads.lanes = {{.points = {{0, 0, 0}, {9, 0, 0}}, .next = {1}},
                 {.points = {{9, 0, 0}, {9, 9, 0}, {0, 0, 0}}, .next = {0}, .junction = 0, .signal = 0}};
  roads.junctions = {{.center = {}, .phases = {{1}}}};
  return roads;
}

std::string ErrorOf(const RoadNetwork& roads) {
  try {
    CheckRoads(roads);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RoadNetwork, ASoundOnePasses) { EXPECT_EQ(ErrorOf(Loop()), ""); }

TEST(RoadNetwork, EveryBrokenRuleIsNamedWithItsLane) {
  const std::pair<std::function<void(RoadNetwork&)>, const char*> cases[] = {
      {[](RoadNetwork& r) { r.lanes[1].points.resize(1); }, "lane 1 has fewer than 2 points"},
      {[](RoadNetwork& r) { r.lanes[0].points[1].x = NAN; }, "lane 0 has a point that is not finite"},
      {[](RoadNetwork& r) {
         r.lanes[0].points.push_back({9, 0, 0});
       },
       "lane 0 has the same point twice"},
      {[](RoadNetwork& r) {
         r.lanes[0].points = {{0, 0, 0}, {0.5f, 0, 0}};
       },
       "lane 0 is shorter than a metre"},
      {[](RoadNetwork& r) { r.lanes[1].speed = 0; }, "lane 1 has a speed"},
      {[](RoadNetwork& r) { r.lanes[1].width = INFINITY; }, "lane 1 has a width"},
      {[](RoadNetwork& r) { r.lanes[1].next.clear(); }, "lane 1 leads nowhere"},
      {[](RoadNetwork& r) { r.lanes[1].next = {7}; }, "lane 1 leads to lane 7, which does not exist"},
      {[](RoadNetwork& r) { r.lanes[1].next = {1}; }, "lane 1 ends more than half a metre"},
      {[](RoadNetwork& r) { r.lanes[0].left = 0; }, "lane 0 has a neighbour that does not exist"},
      {[](RoadNetwork& r) { r.lanes[1].junction = 1; }, "lane 1 leads through junction 1"},
      {[](RoadNetwork& r) { r.lanes[1].signal = 32; }, "lane 1 has a signal outside"},
      {[](RoadNetwork& r) { r.lanes[0].signal = 0; }, "lane 0 has a signal but no junction"},
      {[](RoadNetwork& r) { r.junctions[0].phases[0].seconds = 0; }, "junction 0 has a phase"},
      {[](RoadNetwork& r) { r.junctions[0].offset = INFINITY; }, "junction 0 has a number that is not finite"},
  };
  for (const auto& [damage, said] : cases) {
    RoadNetwork roads = Loop();
    damage(roads);
    EXPECT_NE(ErrorOf(roads).find(said), std::string::npos) << said << " / " << ErrorOf(roads);
  }
}

}  // namespace
}  // namespace airsim360
