#include "airsim360/people/crowd/crowd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/people/crowd/test_crowd_files.h"

namespace airsim360 {
namespace {

using internal::CrowdFiles;
using internal::Default;
using internal::Park;
using internal::ReserveOf;
using internal::TestCrowd;
using internal::TestGround;
using internal::WriteTestFile;

TEST(Crowd, SameSeedSameHashForOneThreadManyThreadsSnapshotsAndOtherSteps) {
  const auto scene = Park();
  const auto run = [&](int64_t dt, bool restore) {
    TestCrowd crowd(scene, Default(160));
    crowd.drones = {{{20, 10, 3}, {}, 0.3}};
    for (int64_t t = 0; t < 60'000'000'000; t += dt) {
      if (restore && t == 30'000'000'000) {
        CrowdState kept = crowd.state;
        crowd.Run(2);
        crowd.state = kept;
      }
      StepCrowd(*crowd.model, crowd.state, dt, crowd.drones);
    }
    return HashCrowd(crowd.state);
  };
  const uint64_t hash = run(kCrowdTickNs, false);
  EXPECT_EQ(run(kCrowdTickNs, true), hash);
  EXPECT_EQ(run(200'000'000, false), hash);
  const ThreadLimit one(1);
  EXPECT_EQ(run(10'000'000, false), hash);
}

TEST(Crowd, NobodyOverlapsOrIsStuckAndEverybodyIsOnTheGround) {
  TestCrowd crowd(Park(), Default(120, 5));
  double closest = 1e9;
  std::set<std::string> seen;
  crowd.Run(180, [&] {
    if (crowd.state.t_ns % 500'000'000 == 0) {
      for (size_t i = 0; i < crowd.state.people.size(); ++i) {
        const PersonState& p = crowd.state.people[i];
        EXPECT_NEAR(p.p_WP.z, 0, 0.01);
        EXPECT_TRUE(p.p_WP.x > 0 && p.p_WP.x < 50 && p.p_WP.y > 0 && p.p_WP.y < 30);
        seen.insert(std::string(PersonStateName(*crowd.model, crowd.state, static_cast<PersonIndex>(i))));
      }
      closest = std::min(closest, crowd.Closest());
    }
    return false;
  });
  EXPECT_GE(closest, 0.3);  // 0.4 on the mesh; feet of those who sit are a little off it
  EXPECT_EQ(crowd.Count(CrowdEvent::Kind::kStuck), 0u);
  for (const char* state : {"walking", "chatting", "sitting", "on_phone_call", "standing"}) EXPECT_TRUE(seen.contains(state)) << state;
  for (const CrowdEvent& event : crowd.events) EXPECT_TRUE(event.kind != CrowdEvent::Kind::kTransition || !event.text.empty());
}

constexpr const char* kSocialTree = R"(<root BTCPP_format="4" main_tree_to_execute="friendly">
 <BehaviorTree ID="friendly">
  <ReactiveFallback>
   <Sequence>
    <Fallback><AnswerGreeting chance="1" person="{other}"/><Meet distance="4" chance="1" cooldown_s="30" person="{other}"/></Fallback>
    <Chat min_s="10" max_s="12"/>
   </Sequence>
   <WanderTo/>
  </ReactiveFallback>
 </BehaviorTree>
</root>)";

TEST_F(CrowdFiles, WalkersWhoMeetChatFacingEachOtherInTurnsAndWalkOn) {
  TestCrowd crowd(
      Park(),
      File("trees: [trees.xml]\nareas:\n  - {name: yard, polygon: [[1, 1], [20, 1], [20, 12], [1, 12]], count: 8, mix: {friendly: 1}}\n",
           kSocialTree));
  std::map<uint32_t, std::set<PersonIndex>> groups;
  int facing = 0, pairs = 0, speakers_of_one = 0, talks = 0;
  crowd.Run(400, [&] {
    std::map<uint32_t, std::vector<PersonIndex>> now;
    for (PersonIndex i = 0; i < 8; ++i)
      if (crowd[i].group) now[crowd[i].group].push_back(i);
    for (const auto& [group, members] : now) {
      int speakers = 0, talking = 0;
      for (const PersonIndex i : members) {
        groups[group].insert(i);
        speakers += crowd[i].speaking;
        talking += crowd[i].upper == Behaviour::kTalk || crowd[i].upper == Behaviour::kListen;
      }
      EXPECT_LE(speakers, 1);
      if (members.size() != 2 || talking != 2) continue;
      ++talks;
      speakers_of_one += speakers;
      // Only those who have taken their places.
      const Vec3d d = crowd[members[1]].p_WP - crowd[members[0]].p_WP;
      if (Norm(crowd[members[0]].v_WP) + Norm(crowd[members[1]].v_WP) > 0.01) continue;
      if (crowd.state.t_ns - crowd[members[0]].upper_since_ns < 4'000'000'000) continue;
      ++pairs;
      const double yaw = std::atan2(d.y, d.x);
      facing +=
          std::cos(yaw - crowd[members[0]].yaw) > 0.94 && std::cos(yaw - crowd[members[1]].yaw) < -0.94 && Norm(d) > 0.75 && Norm(d) < 1.25;
    }
    return false;
  });
  EXPECT_GE(groups.size(), 3u);
  EXPECT_GT(pairs, 30);
  EXPECT_GT(facing, 0.9 * pairs);
  EXPECT_GT(speakers_of_one, 0.6 * talks);
  EXPECT_GE(crowd.Count(CrowdEvent::Kind::kTransition, "chatting", "tree: Chat with person"), 6u);
  // They walk on: as many ends as chats (less those that go on).
  EXPECT_GE(crowd.Count(CrowdEvent::Kind::kTransition, "walking", "message: bye") + 8,
            crowd.Count(CrowdEvent::Kind::kTransition, "chatting"));
  EXPECT_GE(crowd.Count(CrowdEvent::Kind::kTransition, "walking", "message: bye"), 4u);
}

TEST_F(CrowdFiles, AWalkerTakesACallAndKeepsWalking) {
  const char* tree =
      R"(<root BTCPP_format="4"><BehaviorTree ID="there"><Sequence><GoTo point="45;5"/><GoTo point="5;5"/></Sequence></BehaviorTree></root>)";
  TestCrowd crowd(Park(), File("trees: [trees.xml]\npeople:\n  - {name: ann, at: [5, 5], behaviour: there, age: 30}\n"
                               "transitions:\n  - {from: walking, to: on_phone_call, message: call}\n",
                               tree));
  const PersonIndex ann = PersonByName(*crowd.model, "ann");
  EXPECT_THROW(PersonByName(*crowd.model, "anne"), InputError);
  crowd.Run(5);
  EXPECT_EQ(crowd[ann].upper, Behaviour::kWalk);
  crowd.Do(ann, MessagePerson{"call"});
  crowd.Run(3);
  EXPECT_EQ(crowd[ann].upper, Behaviour::kPhoneCall);
  EXPECT_EQ(crowd[ann].lower, Behaviour::kWalk);
  EXPECT_NEAR(Norm(crowd[ann].v_WP), 0.85 * crowd.model->people[ann].free_speed, 0.05);
  ASSERT_EQ(crowd.Count(CrowdEvent::Kind::kTransition, "on_phone_call", "message: call"), 1u);
  crowd.Run(70);
  EXPECT_EQ(crowd[ann].upper, crowd[ann].lower);
  EXPECT_EQ(crowd.Count(CrowdEvent::Kind::kTransition, "walking", "time"), 1u);
}

TEST(Crowd, PeopleNoticeALowDroneAndStepAwayFromAVeryLowOne) {
  TestCrowd crowd(Park(), Default(60, 9));
  crowd.Run(10);
  const size_t before = crowd.Count(CrowdEvent::Kind::kTransition, "looking_up");
  EXPECT_EQ(before, 0u);
  crowd.drones = {{{15, 8, 6}, {}, 0.3}};
  int gazes = 0;
  crowd.Run(60, [&] {
    for (const PersonState& p : crowd.state.people) {
      if (!p.has_gaze || p.group) continue;
      ++gazes;
      EXPECT_EQ(p.p_W_gaze, crowd.drones[0].p_W);
    }
    return false;
  });
  EXPECT_GT(gazes, 100);
  EXPECT_GT(crowd.Count(CrowdEvent::Kind::kTransition, "looking_up", "LookAtDrone"), 2u);
  EXPECT_GT(
      crowd.Count(CrowdEvent::Kind::kTransition, "pointing") + crowd.Count(CrowdEvent::Kind::kTransition, "taking_photo", "LookAtDrone"),
      0u);
  EXPECT_EQ(crowd.Count(CrowdEvent::Kind::kNearPass), 0u);

  // At head height beside somebody: one event, and they go away.
  PersonIndex who = 0;
  while (crowd[who].lower != Behaviour::kWalk) ++who;
  crowd.drones[0].p_W = crowd[who].p_WP + Vec3d{1.2, 0, 1.6};
  crowd.Run(0.5);
  size_t passes = 0;
  for (const CrowdEvent& event : crowd.events) passes += event.kind == CrowdEvent::Kind::kNearPass && event.person == who;
  EXPECT_EQ(passes, 1u);
  crowd.Run(14);  // some take a picture of it first, for up to nine seconds
  EXPECT_GT(Norm(crowd[who].p_WP - crowd.drones[0].p_W), 2.5);
}

TEST_F(CrowdFiles, ASitterFindsABenchAndSitsWithTheBackToIt) {
  const char* tree =
      R"(<root BTCPP_format="4"><BehaviorTree ID="rest"><Sequence><GoToPlace kind="bench"/><SetState state="sitting" min_s="20" max_s="20"/><GoTo point="5;5"/></Sequence></BehaviorTree></root>)";
  TestCrowd crowd(Park(), File("trees: [trees.xml]\nseed: 4\npeople:\n  - {at: [12, 20], behaviour: rest, age: 40}\n", tree));
  crowd.Run(20);
  ASSERT_EQ(crowd[0].lower, Behaviour::kSit);
  EXPECT_LT(crowd[0].p_WP.y, 25.0);
  EXPECT_GT(crowd[0].p_WP.y, 24.6);
  EXPECT_NEAR(std::remainder(crowd[0].yaw + 1.5708, 6.28318), 0, 0.35);  // looks south
  const Vec3d seat = crowd[0].p_WP;
  crowd.Run(1);
  EXPECT_EQ(crowd[0].p_WP, seat);
  crowd.Run(30);
  EXPECT_GT(Norm(crowd[0].p_WP - seat), 3);
}

// A branch that is tried and fails gives up the bench that another one is on its way to.
TEST_F(CrowdFiles, WhoLosesTheirPlaceOnTheWayGoesNowhereInOneLeap) {
  const char* tree =
      R"(<root BTCPP_format="4"><BehaviorTree ID="rest"><ReactiveFallback><Sequence><DroneWithin distance="8"/><GoTo point="900;900"/></Sequence><Sequence><GoToPlace kind="bench"/><SetState state="sitting"/></Sequence></ReactiveFallback></BehaviorTree></root>)";
  TestCrowd crowd(Park(), File("trees: [trees.xml]\nseed: 4\npeople:\n  - {at: [12, 20], behaviour: rest, age: 40}\n", tree));
  Vec3d before = crowd[0].p_WP;
  for (int step = 0; step < 200; ++step) {
    // Near for half a second, every four.
    crowd.drones = {};
    if (step % 40 > 34) crowd.drones = {{crowd[0].p_WP + Vec3d{3, 0, 2}, {}, 0.3}};
    crowd.Run(0.1);
    ASSERT_LT(Norm(crowd[0].p_WP - before), 0.5) << "step " << step;
    before = crowd[0].p_WP;
  }
}

// The example of docs/guide/people_behaviour.md (tests run in the root of the sources), with trees in the file it names.
TEST_F(CrowdFiles, TheFileOfTheDocsWorks) {
  std::ifstream docs("docs/guide/people_behaviour.md");
  if (!docs) GTEST_SKIP() << "not in the root of the sources";
  std::string line, yaml;
  while (std::getline(docs, line) && line != "### people.yaml") {
  }
  while (std::getline(docs, line) && line.rfind("    ", 0) != 0) {
  }
  do yaml += line.substr(4) + "\n";
  while (std::getline(docs, line) && line.rfind("    ", 0) == 0);
  WriteTestFile(folder_, "my_trees.xml", kSocialTree);
  TestCrowd crowd(Park(), File(yaml));
  EXPECT_EQ(crowd.state.people.size(), 31u);
  const PersonIndex ann = PersonByName(*crowd.model, "ann");
  EXPECT_NEAR(crowd[ann].p_WP.x, 12, 0.01);
  crowd.Run(20);
  for (PersonIndex i = 0; i < 31; ++i) crowd.Do(i, MessagePerson{"goal"});
  crowd.Run(1);
  EXPECT_GT(crowd.Count(CrowdEvent::Kind::kTransition, "cheering", "message: goal"), 15u);
}

TEST_F(CrowdFiles, AShopperStopsBeforeADoorAndLooksAtIt) {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 20, 6);
  ground.Box("construction/building", {0, 6, 0}, {20, 12, 6});
  ground.Box("construction/door", {14, 5.9f, 0}, {15, 6, 2.2f});
  const char* tree =
      R"(<root BTCPP_format="4"><BehaviorTree ID="buys"><Sequence><GoToPlace kind="shop"/><SetState state="standing" min_s="20" max_s="20"/></Sequence></BehaviorTree></root>)";
  TestCrowd crowd(ground.Build(), File("trees: [trees.xml]\npeople:\n  - {at: [3, 2], behaviour: buys, age: 40}\n", tree));
  crowd.Run(18);
  EXPECT_NEAR(crowd[0].p_WP.x, 14.5, 0.3);
  EXPECT_GT(crowd[0].p_WP.y, 4.4);
  EXPECT_NEAR(std::remainder(crowd[0].yaw - 1.5708, 6.28318), 0, 0.35);
  EXPECT_EQ(PersonStateName(*crowd.model, crowd.state, 0), "standing");
  EXPECT_EQ(LastTransition(*crowd.model, crowd.state, 0).cause.substr(0, 4), "tree");
}

TEST(Crowd, WhoStandsInANarrowWayIsPassedOrMakesWay) {
  TestGround ground;
  ground.Floor("ground/floor", 0, 0, 20, 1.4f);
  TestCrowd crowd(ground.Build(), ReserveOf(2));
  crowd.Do(0, SpawnPerson{{10, 0.7, 0}, 0});
  crowd.Do(0, SetPersonState{"standing", 100});
  crowd.Do(1, SpawnPerson{{2, 0.7, 0}, 0});
  crowd.Do(1, SendPerson{{18, 0.7, 0}, 0});
  const double t = crowd.Run(60, [&] { return crowd[1].p_WP.x > 17; });
  EXPECT_LT(t, 30);
  EXPECT_GE(crowd.Closest(), 0.4 - 1e-6);
}

TEST(Crowd, PeopleWaitAtTheKerbUntilTheirLightIsGreen) {
  TestGround ground;
  ground.Floor("ground/sidewalk", 0, 0, 30, 8);
  ground.Floor("ground/road", 0, 8, 30, 16, -0.1f);
  ground.Floor("ground/sidewalk", 0, 16, 30, 24);
  ground.Floor("ground/crosswalk", 13, 8, 17, 16, -0.095f);
  ground.Box("traffic/control/traffic_light", {18, 7, 0}, {18.2f, 7.2f, 3});
  TestCrowd crowd(ground.Build(), ReserveOf(6));
  ASSERT_EQ(crowd.mesh->crossings().size(), 1u);
  ASSERT_TRUE(crowd.mesh->crossings()[0].signal);
  std::vector<double> entered(6, -1);
  int waiting = 0;
  for (PersonIndex i = 0; i < 6; ++i) crowd.Do(i, SpawnPerson{{5.0 + 3 * i, 2, 0}, 0});
  crowd.Run(100, [&] {
    for (PersonIndex i = 0; i < 6; ++i) {
      if (crowd.state.t_ns == static_cast<int64_t>(i) * 8'000'000'000) crowd.Do(i, SendPerson{{15, 20, 0}, 0});
      const double y = crowd[i].p_WP.y, t = static_cast<double>(crowd.state.t_ns) * 1e-9;
      if (y > 8.1 && entered[i] < 0) entered[i] = t;
      waiting += crowd[i].lower == Behaviour::kWait;
    }
    return false;
  });
  EXPECT_GT(waiting, 20);
  for (const double t : entered) {
    ASSERT_GT(t, 0);
    const double phase = std::fmod(t + (crowd.mesh->crossings()[0].phase ? 22 : 0), 44);
    EXPECT_LT(phase, 17.5) << t;  // green is 15 s; who stands at the kerb at its end still goes
  }
}

// A command that cannot be done must not be half done: before, somebody sent off the mesh had stopped
// walking.
TEST(Crowd, ARefusedCommandChangesNothingAndACheckNamesTheSameError) {
  TestCrowd crowd(Park(), ReserveOf(3));
  crowd.Do(0, SpawnPerson{{5, 5, 0}, 1});
  crowd.Do(1, SpawnPerson{{8, 5, 0}, 1});
  crowd.Do(0, SendPerson{{15, 5, 0}, 1.5});
  crowd.Run(1);
  const auto error_of = [](const auto& action) -> std::string {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  const std::pair<PersonIndex, PersonAction> wrong[] = {{0, SpawnPerson{{5, 9, 0}, 0}},
                                                        {2, MovePerson{{5, 9, 0}, 0}},
                                                        {0, MovePerson{{300, 5, 0}, 0}},
                                                        {0, MovePerson{crowd[1].p_WP, 0}},
                                                        {2, RemovePerson{}},
                                                        {0, SendPerson{{300, 5, 0}, 0}},
                                                        {0, SendPerson{{5, 9, 0}, 7}},
                                                        {0, SetPersonState{"dancing", 3}},
                                                        {0, SetPersonState{"waving", -1}},
                                                        {0, MessagePerson{"gossip"}},
                                                        {2, ReleasePerson{}},
                                                        {9, ReleasePerson{}}};
  for (const auto& [person, action] : wrong) {
    const uint64_t before = HashCrowd(crowd.state);
    const std::string said = error_of([&] { CheckPersonCommand(*crowd.model, crowd.state, person, action); });
    EXPECT_NE(said, "none") << action.index();
    EXPECT_EQ(error_of([&] { crowd.Do(person, action); }), said);
    EXPECT_EQ(HashCrowd(crowd.state), before) << said;
  }
  CheckPersonCommand(*crowd.model, crowd.state, 0, RemovePerson{});
  EXPECT_TRUE(crowd[0].visible);
  crowd.Run(12);
  EXPECT_NEAR(crowd[0].p_WP.x, 15, 0.5);
}

TEST(Crowd, SinglePeopleAreSpawnedSentSetAndRemoved) {
  TestCrowd crowd(Park(), ReserveOf(2));
  EXPECT_FALSE(crowd[0].visible);
  EXPECT_THROW(crowd.Do(0, MovePerson{{5, 5, 0}, 0}), InputError);
  crowd.Do(0, SpawnPerson{{5, 5, 0}, 1});
  EXPECT_TRUE(crowd[0].visible);
  EXPECT_THROW(crowd.Do(1, SpawnPerson{{5.1, 5, 0}, 1}), InputError);  // taken
  EXPECT_THROW(crowd.Do(1, SpawnPerson{{-20, 5, 0}, 1}), InputError);  // outside
  EXPECT_THROW(crowd.Do(0, SetPersonState{"dancing", 3}), InputError);
  EXPECT_THROW(crowd.Do(0, SetPersonState{"waving", -3}), InputError);
  EXPECT_THROW(crowd.Do(1, ReleasePerson{}), InputError);
  try {
    crowd.Do(0, SendPerson{{300, 5, 7}, 0});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the nearest place is (49."), std::string::npos) << error.what();
  }
  EXPECT_THROW(crowd.Do(7, RemovePerson{}), InputError);
  crowd.Do(0, SendPerson{{15, 5, 0}, 1.5});
  crowd.Run(12);
  EXPECT_NEAR(crowd[0].p_WP.x, 15, 0.5);
  crowd.Do(0, SetPersonState{"waving", 4});
  crowd.Run(1);
  EXPECT_EQ(crowd[0].upper, Behaviour::kWave);
  const PersonTransition last = LastTransition(*crowd.model, crowd.state, 0);
  EXPECT_EQ(last.to, "waving");
  EXPECT_EQ(last.cause, "command");
  crowd.Run(5);
  EXPECT_EQ(LastTransition(*crowd.model, crowd.state, 0).cause, "time");
  EXPECT_NE(crowd[0].upper, Behaviour::kWave);
  crowd.Do(0, MovePerson{{30, 5, 0}, 0});
  EXPECT_EQ(crowd[0].p_WP.x, 30);
  crowd.Do(0, ReleasePerson{});
  crowd.Run(10);
  EXPECT_GT(Norm(crowd[0].p_WP - Vec3d{30, 5, 0}), 0.3);
  crowd.Do(0, RemovePerson{});
  EXPECT_FALSE(crowd[0].visible);
}

TEST_F(CrowdFiles, AuthorsAddStatesMessagesAndTransitions) {
  const char* tree =
      R"(<root BTCPP_format="4"><BehaviorTree ID="crier"><Sequence><Sleep msec="2000"/><Send message="cheer_up" to="radius" distance="30"/><Sleep msec="100000"/></Sequence></BehaviorTree>
   <BehaviorTree ID="idler"><Sleep msec="1000"/></BehaviorTree></root>)";
  TestCrowd crowd(Park(), File("trees: [trees.xml]\nmessages: [cheer_up]\n"
                               "states:\n  - {name: happy, upper: wave, min_s: 3, max_s: 3, next: walking}\n"
                               "transitions:\n  - {from: any, to: happy, message: cheer_up}\n"
                               "areas:\n  - {name: a, count: 5, mix: {idler: 1}}\n"
                               "people:\n  - {at: [20, 5], behaviour: crier}\n",
                               tree));
  crowd.Run(3);
  EXPECT_EQ(crowd.Count(CrowdEvent::Kind::kTransition, "happy", "message: cheer_up from person 1"), 5u);
  crowd.Run(4);
  EXPECT_EQ(crowd.Count(CrowdEvent::Kind::kTransition, "walking", "time"), 5u);
}

// The mesh is 400 m wide, in whole tiles; what a file names beyond that is prepared too, and what is too far is refused by its line.
TEST_F(CrowdFiles, AreasFarFromTheSpawnArePrepared) {
  TestGround ground;
  ground.Floor("ground/pavement", -2000, 0, 12000, 40);
  ground.builder().SetSpawn({0, 20, 2});
  const auto scene = ground.Build();
  const auto model = BuildCrowd(*scene, nullptr,
                                File("areas:\n  - {name: near, polygon: [[0, 5], [60, 5], [60, 35], [0, 35]], count: 3}\n"
                                     "  - {name: far, polygon: [[900, 5], [960, 5], [960, 35], [900, 35]], count: 4}\n"
                                     "people:\n  - {at: [1200, 20], behaviour: walker}\n  - {at: [-600, 20], behaviour: walker}\n"));
  EXPECT_LT(model->navmesh->bounds().min.x, -620);  // not at the edge of the mesh
  const CrowdState state = StartCrowd(*model);
  const auto between = [&](double west, double east) {
    return std::ranges::count_if(state.people, [&](const PersonState& person) { return person.p_WP.x > west && person.p_WP.x < east; });
  };
  EXPECT_EQ(between(-1, 61), 3);
  EXPECT_EQ(between(899, 961), 4);
  EXPECT_EQ(between(1199.9, 1200.1), 1);
  EXPECT_EQ(between(-600.1, -599.9), 1);
  EXPECT_TRUE(model->navmesh->FindPath(model->navmesh->Nearest({30, 20, 0}), model->navmesh->Nearest({930, 20, 0})).complete);
  EXPECT_LE(BuildCrowd(*scene, nullptr, File("areas:\n  - {count: 3}\n"))->navmesh->bounds().max.x, 200 + 24);

  ground = TestGround();
  ground.Floor("ground/pavement", -5000, -5000, 5000, 5000);
  const auto wide = ground.Build();
  try {
    BuildCrowd(*wide, nullptr, File("areas:\n  - name: far\n    polygon: [[4000, 3000], [4010, 3000], [4010, 3010]]\n    count: 1\n"));
    ADD_FAILURE() << "13 km2 were prepared";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("people.yaml:3: people would walk over 4234 m x 3234 m of the world; 2.25 km2 is the most"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(CrowdFiles, BadInputNamesFileLineAndTheNearestChoice) {
  EXPECT_EQ(ErrorOf("areas:\n  - name: far\n    polygon: [[100, 100], [120, 100], [120, 120]]\n    count: 3\n").substr(0, 66),
            "people.yaml:3: area 'far' lies outside the world; people can walk ");
  EXPECT_NE(ErrorOf("areas:\n  - {name: pot, polygon: [[8.4, 14.2], [9.6, 14.2], [9.6, 14.8], [8.4, 14.8]], count: 1}\n")
                .find("people.yaml:2: nobody can walk in area 'pot'; the nearest walkable ground is at"),
            std::string::npos);
  EXPECT_NE(ErrorOf("areas:\n  - name: small\n    polygon: [[1, 1], [4, 1], [4, 4], [1, 4]]\n    count: 500\n")
                .find("people.yaml:4: 500 people do not fit area 'small' (9 m2); at most"),
            std::string::npos);
  EXPECT_NE(ErrorOf("areas:\n  - count: 3\n    mix: {walkr: 1}\n").find("people.yaml:3: unknown behaviour 'walkr'; did you mean 'walker'?"),
            std::string::npos);
  EXPECT_NE(ErrorOf("areas:\n  - {count: 2.5}\n").find("people.yaml:2: count: expected a whole number, found '2.5'"), std::string::npos);
  EXPECT_NE(ErrorOf("area: 3\n").find("people.yaml:1: people file: unknown key 'area'; did you mean 'areas'?"), std::string::npos);
  EXPECT_NE(ErrorOf("states:\n  - {name: x, upper: wawe}\n").find("people.yaml:2: unknown behaviour 'wawe'; did you mean 'wave'?"),
            std::string::npos);
  EXPECT_NE(ErrorOf("transitions:\n  - {to: walkin, message: call}\n").find("did you mean 'walking'?"), std::string::npos);
  EXPECT_NE(ErrorOf("people:\n  - {at: [-5, 3]}\n").find("people.yaml:2: nobody can stand there; the nearest place is ["),
            std::string::npos);
  EXPECT_NE(ErrorOf("trees: [none.xml]\n").find("people.yaml:1:"), std::string::npos);
  EXPECT_NE(
      ErrorOf("trees: [trees.xml]\n", "<root BTCPP_format=\"4\"><BehaviorTree ID=\"a\"><SetState state=\"waiving\"/></BehaviorTree></root>")
          .find("trees.xml:1: SetState state: unknown state 'waiving'; did you mean 'waving'?"),
      std::string::npos);
  const std::string pass =
      "<root BTCPP_format=\"4\"><BehaviorTree ID=\"a\">\n<SubTree ID=\"b\" what=\"WAVE\"/></BehaviorTree><BehaviorTree ID=\"b\">\n<SetState state=\"{what}\"/></BehaviorTree></root>";
  EXPECT_NE(ErrorOf("trees: [trees.xml]\n", pass).find("trees.xml:3: SetState state: unknown state 'WAVE'; did you mean"),
            std::string::npos);
  EXPECT_EQ(ErrorOf("trees: [trees.xml]\n", std::string(pass).replace(pass.find("WAVE"), 4, "waving")), "none");
  EXPECT_NE(ErrorOf("trees: [trees.xml]\n", "<root BTCPP_format=\"4\">\n<Behavior").find("trees.xml:2:"), std::string::npos);
  EXPECT_NE(ErrorOf("areas:\n  - {count: [1}\n").find("people.yaml:"), std::string::npos);
  CrowdRequest many = Default(100000);
  const auto scene = Park();
  EXPECT_THROW(BuildCrowd(*scene, NavMesh::Build(*scene), many), InputError);
}

}  // namespace
}  // namespace airsim360
