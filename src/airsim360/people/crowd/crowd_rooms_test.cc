// Crowds in buildings: rooms, seats, and who begins how.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/people/behaviour/seats.h"
#include "airsim360/people/crowd/agent.h"
#include "airsim360/people/crowd/test_crowd_files.h"

namespace airsim360 {
namespace {

using CrowdRooms = internal::CrowdFiles;

/// A room with one chair at a table with room for the legs.
std::shared_ptr<const Scene> OneDesk() {
  internal::TestGround ground;
  ground.Floor("ground/floor", 0, 0, 12, 10);
  ground.Box("furniture/table/dining_table", {4, 3.2f, 0.7f}, {7, 4, 0.75f});
  ground.Seat("furniture/seating/office_chair", 5, 4.1f, 0.5f);
  ground.Box("construction/ceiling", {0, 0, 2.7f}, {12, 10, 2.8f});
  return ground.Build();
}

/// A large room and a small one, of 6.8 square metres that people's middles reach.
std::shared_ptr<const Scene> TwoRooms() {
  internal::TestGround ground;
  ground.Floor("ground/floor", 0, 0, 12, 10);
  ground.Floor("ground/floor", 20, 0, 23, 3);
  ground.Box("construction/ceiling", {0, 0, 2.7f}, {23, 10, 2.8f});
  return ground.Build();
}

// In the open chairs belong to somebody; in rooms people sit at desks and tables.
TEST_F(CrowdRooms, ChairsAtTablesAreSatOnInBuildingsAndNotInTheOpen) {
  const char* tree =
      R"(<root BTCPP_format="4"><BehaviorTree ID="rest"><Sequence><GoToPlace kind="bench"/><SetState state="sitting" min_s="20" max_s="20"/></Sequence></BehaviorTree></root>)";
  for (const auto& [building, legroom] : {std::pair{true, true}, {true, false}, {false, true}}) {
    internal::TestGround ground;
    ground.Floor("ground/floor", 0, 0, 12, 10);
    ground.Box("furniture/table/dining_table", {4, 3.2f, legroom ? 0.7f : 0.0f}, {7, 4, 0.75f});
    ground.Seat("furniture/seating/office_chair", 5, 4.1f, 0.5f);
    if (building) ground.Box("construction/ceiling", {0, 0, 2.7f}, {12, 10, 2.8f});
    internal::TestCrowd crowd(ground.Build(),
                              File("trees: [trees.xml]\nseed: 4\npeople:\n  - {at: [6, 8], behaviour: rest, age: 40}\n", tree));
    crowd.Run(15);
    // Not in the open, and not where there is no room for the legs.
    ASSERT_EQ(crowd[0].lower == Behaviour::kSit, building && legroom);
    if (!building || !legroom) continue;
    EXPECT_NEAR(crowd[0].seating.height, 0.45, 0.02);
    EXPECT_NEAR(crowd[0].seating.desk, 0.75, 1e-6);
    // The feet before the chair, under the table; looks south.
    EXPECT_NEAR(crowd[0].p_WP.x, 5.25, 0.1);
    EXPECT_NEAR(crowd[0].p_WP.y, 4.0, 0.15);
    EXPECT_NEAR(std::remainder(crowd[0].yaw + 1.5708, 6.28318), 0, 0.35);
  }
}

// Who sat at a desk and sits down where nothing was measured has no desk there.
TEST_F(CrowdRooms, ASeatThatWasLeftIsForgottenByWhoSitsDownElsewhere) {
  const char* tree =
      R"(<root BTCPP_format="4"><BehaviorTree ID="rest"><Sequence><GoToPlace kind="bench"/><SetState state="sitting" min_s="3" max_s="3"/><GoTo point="2;8"/><SetState state="sitting" min_s="60" max_s="60"/></Sequence></BehaviorTree></root>)";
  internal::TestCrowd crowd(OneDesk(), File("trees: [trees.xml]\nseed: 4\npeople:\n  - {at: [6, 8], behaviour: rest, age: 40}\n", tree));
  crowd.Run(15, [&] { return crowd[0].lower == Behaviour::kSit && crowd[0].seating.desk > 0; });
  ASSERT_GT(crowd[0].seating.desk, 0);
  crowd.Run(30, [&] { return crowd[0].lower == Behaviour::kSit && crowd[0].p_WP.y > 7; });
  ASSERT_EQ(crowd[0].lower, Behaviour::kSit);
  ASSERT_GT(crowd[0].p_WP.y, 7);
  EXPECT_EQ(crowd[0].seating, Seating());
}

TEST_F(CrowdRooms, TheHashHoldsWhatDecidesWhatComesNext) {
  internal::TestCrowd crowd(OneDesk(), internal::Default(4));
  const uint64_t hash = HashCrowd(crowd.state);
  const auto other = [&](const auto& change) {
    CrowdState changed = crowd.state;
    change(*changed.internals);
    return HashCrowd(changed) != hash;
  };
  EXPECT_FALSE(other([](CrowdInternals&) {}));
  EXPECT_TRUE(other([](CrowdInternals& in) { ++in.agents[1].place; }));
  EXPECT_TRUE(other([](CrowdInternals& in) { in.agents[1].at_place = !in.agents[1].at_place; }));
  EXPECT_TRUE(other([](CrowdInternals& in) { in.agents[1].begins = !in.agents[1].begins; }));
  EXPECT_TRUE(other([](CrowdInternals& in) { ++in.agents[1].run.nodes[0].t_ns; }));
  EXPECT_TRUE(other([](CrowdInternals& in) { in.place_taken.at(0) = in.place_taken[0] == 3 ? 2 : 3; }));
}

// Models of glTF whose axes were not turned lie with their Y up.
TEST(PlacesInRooms, LinesStandBeforeCountersWhicheverAxisIsUp) {
  for (const bool y_up : {false, true}) {
    internal::TestGround ground;
    ground.Floor("ground/floor", 0, 0, 12, 10);
    ground.Box("construction/ceiling", {0, 0, 2.7f}, {12, 10, 2.8f});
    SceneBuilder& builder = ground.builder();
    Mesh mesh;  // 1 m wide, 0.6 m deep, 1 m high
    for (int i = 0; i < 8; ++i) {
      const float x = i & 1 ? 0.5f : -0.5f, depth = i & 2 ? 0.3f : -0.3f, z = i & 4 ? 1.0f : 0.0f;
      mesh.positions.push_back(y_up ? Vec3f{x, z, -depth} : Vec3f{x, depth, z});
    }
    for (const Vec3u t : {Vec3u{4, 5, 6}, Vec3u{5, 7, 6}, Vec3u{0, 1, 4}, Vec3u{1, 5, 4}, Vec3u{2, 6, 3}, Vec3u{3, 6, 7}, Vec3u{0, 4, 2},
                          Vec3u{2, 4, 6}, Vec3u{1, 3, 5}, Vec3u{3, 7, 5}})
      mesh.triangles.push_back(t);
    AffineTransform X_WM;
    X_WM.p = {6, 6, 0};
    if (y_up) X_WM.A.m[1][1] = 0, X_WM.A.m[1][2] = -1, X_WM.A.m[2][1] = 1, X_WM.A.m[2][2] = 0;
    const EntityId counter = builder.AddEntity("checkout 1", builder.tree().At("furniture/counter"));
    const MeshId id = builder.AddMesh(std::move(mesh));
    builder.AddInstance({.mesh = id, .X_WM = X_WM, .entity = counter});
    const auto scene = ground.Build();
    const std::vector<internal::Place> places = internal::FindPlaces(*scene, *NavMesh::Build(*scene), true);
    ASSERT_EQ(places.size(), 4u) << y_up;
    for (const internal::Place& place : places) {
      EXPECT_NEAR(place.p_W.x, 6, 0.25);
      EXPECT_NEAR(place.p_W.y, 6 - 0.3 - 0.45 - 0.75 * place.rank, 0.25);
      EXPECT_NEAR(std::remainder(place.yaw - kPi / 2, 2 * kPi), 0, 1e-6);  // looks at the counter
    }
  }
}

TEST(PlacesOutdoors, PeopleSitOnABenchHoweverItIsTurned) {
  for (const double yaw : {0.0, 0.3, 0.8, 1.6, 2.5, -0.7, -2.1}) {
    internal::TestGround ground;
    ground.Floor("ground/pavement", 0, 0, 12, 12);
    ground.Bench(6, 6, static_cast<float>(yaw));
    const auto scene = ground.Build();
    const std::vector<internal::Place> places = internal::FindPlaces(*scene, *NavMesh::Build(*scene), false);
    ASSERT_EQ(places.size(), 3u) << yaw;
    std::vector<double> along;
    for (const internal::Place& place : places) {
      EXPECT_NEAR(std::remainder(place.yaw - (yaw - kPi / 2), 2 * kPi), 0, 0.02) << yaw;
      // Hips over the seat, between the arms, as far behind the feet as the seating says.
      const double x = place.p_W.x - place.seating.reach * std::cos(place.yaw) - 6,
                   y = place.p_W.y - place.seating.reach * std::sin(place.yaw) - 6;
      along.push_back(std::cos(yaw) * x + std::sin(yaw) * y);
      const double back = -std::sin(yaw) * x + std::cos(yaw) * y;
      EXPECT_GT(back, -0.15) << yaw;
      EXPECT_LT(back, 0.17) << yaw;
      EXPECT_NEAR(place.seating.height, 0.45, 0.03);
    }
    std::ranges::sort(along);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(along[static_cast<size_t>(i)], 0.6 * (i - 1), 0.05) << yaw;
  }
}

TEST(PlacesInRooms, WhatIsLargerThanFurnitureHasNoSeats) {
  for (const float width : {2.0f, 3e9f}) {
    internal::TestGround ground;
    ground.Floor("ground/floor", 0, 0, 12, 10);
    const EntityId bench = ground.Seat("furniture/seating/bench", 4, 4, width);
    const auto scene = ground.Build();
    EXPECT_EQ(internal::SeatFinder(*scene).Seats(bench, {0, -1}).size(), width < 50 ? 3u : 0u) << width;
  }
}

TEST_F(CrowdRooms, WhoDoesNotFitASmallRoomLivesInALargeOne) {
  // The small room is full of single people.
  std::string single = "people:\n";
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      single += "  - {at: [" + std::to_string(20.5 + 0.5 * x) + ", " + std::to_string(0.5 + 0.5 * y) + "], age: 30}\n";
  const auto scene = TwoRooms();
  const auto model = BuildCrowd(*scene, nullptr, File("areas:\n  - {name: crowd, count: 40}\n" + single));
  ASSERT_EQ(model->areas.size(), 2u);
  EXPECT_EQ(model->people.size(), 65u);
  const auto in_small = std::ranges::count_if(model->plan->starts, [](const NavPoint& start) { return start.p_W.x > 15; });
  EXPECT_GE(in_small, 25);
  EXPECT_LE(in_small, 26);
  try {
    BuildCrowd(*scene, nullptr, File("areas:\n  - {name: crowd, count: 4000}\n"));
    ADD_FAILURE() << "4000 people fit";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("people.yaml:2: 4000 people do not fit area 'crowd' ("), std::string::npos) << error.what();
  }
}

TEST_F(CrowdRooms, RoomsGetNamesThatNobodyElseHas) {
  const auto model = BuildCrowd(*TwoRooms(), nullptr,
                                File("areas:\n  - {name: lobby, count: 4}\n"
                                     "  - {name: lobby 2, polygon: [[1, 1], [8, 1], [8, 4], [1, 4]], count: 1}\n  - {count: 3}\n"));
  std::vector<std::string> names;
  for (const CrowdArea& area : model->areas) names.push_back(area.name);
  EXPECT_EQ(names, (std::vector<std::string>{"lobby", "lobby 3", "lobby 2", "area 3", "area 3 2"}));
  // The first is the largest.
  EXPECT_GT(model->plan->ground[0].square_metres, 50);
  EXPECT_LT(model->plan->ground[1].square_metres, 10);
}

TEST_F(CrowdRooms, AStreetWithARoomBehindADoorIsLivedInOutdoors) {
  for (const bool begins_inside : {false, true}) {
    internal::TestGround ground;
    ground.Floor("ground/sidewalk", 0, 0, 60, 60);
    ground.Floor("ground/floor", 70, 0, 78, 8);
    ground.Box("construction/ceiling", {70, 0, 2.7f}, {78, 8, 2.8f});
    ground.builder().SetSpawn(begins_inside ? Vec3f{74, 4, 1.5f} : Vec3f{30, 30, 1.5f});
    const auto model = BuildCrowd(*ground.Build(), nullptr, internal::Default(20));
    ASSERT_EQ(model->areas.size(), 1u);
    int indoors = 0, tourists = 0;
    for (size_t i = 0; i < model->people.size(); ++i) {
      indoors += model->plan->starts[i].p_W.x > 65;
      const std::string& tree = model->plan->trees.trees[model->plan->tree_of_person[i]].name;
      tourists += tree == "tourist" || tree == "jogger" || tree == "parent";  // of the mix outdoors alone
    }
    EXPECT_EQ(indoors, begins_inside ? 20 : 0);
    EXPECT_EQ(tourists > 0, !begins_inside);
  }
}

TEST_F(CrowdRooms, WhoBeginsInATalkStandsInNobody) {
  internal::TestCrowd crowd(TwoRooms(), File("areas:\n  - {count: 160, mix: {walker: 1}}\n"));
  EXPECT_GE(crowd.Closest(), 0.4);
  int talks = 0;
  for (PersonIndex i = 0; i < crowd.state.people.size(); ++i) {
    const PersonIndex other = crowd.model->plan->start_partners[i];
    if (other == kNoPerson) continue;
    ++talks;
    EXPECT_NEAR(Norm(crowd[i].p_WP - crowd[other].p_WP), 1, 0.06);
  }
  EXPECT_GE(talks, 8);
}

}  // namespace
}  // namespace airsim360
