#include "airsim360/mission/mission.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/mission/mission_nodes.h"
#include "airsim360/sim/drone_bodies.h"
#include "airsim360/sim/people/populate.h"
#include "airsim360/sim/test_flights.h"

namespace airsim360 {
namespace {

using internal::HummingbirdAt;
using internal::RoomModel;
using Result = MissionProgress::Result;

std::string Xml(const std::string& body) {
  return "<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"m\">\n" + body + "\n</BehaviorTree>\n</root>\n";
}

/// A mission flown in the room, which is x, y = ±5 and z = 0 … 6 with a cube of 1 m at (3, 0, 0.5), called "box".
struct Flown {
  explicit Flown(const std::string& body, Vec3d start = {-2, 0, 0.5}, bool airborne = false, double longest = 120)
      : model(RoomModel({HummingbirdAt(start, airborne)})), loop(model) {
    pilot = std::make_shared<MissionPilot>(ReadMission(Xml(body), "m.xml", {model, {}}));
    loop.Attach(pilot);
    const auto steps = static_cast<int64_t>(longest * 1e9) / model->dt_ns;
    loop.AdvanceWhile(steps, [&](const SimState& state, std::span<const SimEvent>) {
      if (state.step % 10 == 0) path.push_back(state.vehicles[0].motion.X_WB);
      return !pilot->done();
    });
  }
  Vec3d p() const { return loop.state().vehicles[0].motion.X_WB.p; }
  std::string Log() const {
    std::string all;
    for (const std::string& line : pilot->progress().log) all += line + "\n";
    return all;
  }
  std::shared_ptr<SimModel> model;
  SimLoop loop;
  std::shared_ptr<MissionPilot> pilot;
  std::vector<RigidTransform> path;
};

std::string ErrorOf(const std::string& body) {
  try {
    ReadMission(Xml(body), "m.xml", {RoomModel({HummingbirdAt({})}), {}});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Mission, TakesOffFliesToAPointAndLandsThere) {
  const Flown flown("<Sequence><Takeoff height=\"1.5\"/><Goto to=\"-2;3;2\"/><Land/></Sequence>");
  EXPECT_EQ(flown.pilot->progress().result, Result::kSuccess) << flown.Log();
  EXPECT_NEAR(flown.p().x, -2, 0.1);
  EXPECT_NEAR(flown.p().y, 3, 0.1);
  EXPECT_LT(flown.p().z, 0.2);
  EXPECT_TRUE(flown.pilot->progress().active.empty());
}

TEST(Mission, GotoAThingKeepsItsDistanceFromTheBox) {
  const Flown flown("<Goto to=\"box\" distance=\"1\" height=\"1\"/>", {-2, 0, 1.5}, true);
  ASSERT_EQ(flown.pilot->progress().result, Result::kSuccess) << flown.Log();
  // The circle around the middle: half a diagonal of the square of 1 m, and 1 m.
  EXPECT_NEAR(std::hypot(flown.p().x - 3, flown.p().y), std::sqrt(0.5) + 1, 0.1);
  EXPECT_NEAR(flown.p().z, 1.5, 0.1);
}

TEST(Mission, AnOrbitHasTheRadiusThatItWasGivenAndLooksAtItsMiddle) {
  const Flown flown("<Orbit around=\"0;0;1\" radius=\"3\" height=\"1.5\" turns=\"1\" speed=\"2\"/>", {-1, 0, 2.5}, true);
  ASSERT_EQ(flown.pilot->progress().result, Result::kSuccess) << flown.Log();
  // From the first to the last place that is on the circle: one turn of that radius at that height.
  size_t first = 0;
  while (std::hypot(flown.path[first].p.x, flown.path[first].p.y) < 2.95) ++first;
  double turned = 0, farthest = 0;
  for (size_t i = first + 1; i < flown.path.size(); ++i) {
    const Vec3d a = flown.path[i - 1].p, b = flown.path[i].p;
    turned += std::remainder(std::atan2(b.y, b.x) - std::atan2(a.y, a.x), 2 * M_PI);
    farthest = std::max(farthest, std::abs(std::hypot(b.x, b.y) - 3));
    EXPECT_NEAR(b.z, 2.5, 0.1);
    // Turned to the middle before the circle begins.
    if (std::abs(turned) < 0.05) continue;
    const double heading = std::atan2(flown.path[i].R.m[1][0], flown.path[i].R.m[0][0]);
    EXPECT_LT(std::abs(std::remainder(heading - std::atan2(-b.y, -b.x), 2 * M_PI)), 0.2);
  }
  EXPECT_NEAR(turned, 2 * M_PI, 0.05);
  EXPECT_LT(farthest, 0.1);
}

TEST(Mission, CapturesAreAsManyAndAsFarApartAsAskedFor) {
  const Flown flown(
      "<Parallel><Goto to=\"-2;3;2\"/><Sequence><Capture count=\"5\" every_s=\"0.4\"/><Capture to=\"more\" products=\"normal,flow\"/></Sequence></Parallel>",
      {-2, -3, 2}, true);
  ASSERT_EQ(flown.pilot->progress().result, Result::kSuccess) << flown.Log();
  const std::vector<MissionCapture> captures = flown.pilot->CapturesFrom(0);
  ASSERT_EQ(captures.size(), 6u);
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(captures[i].shot.t_ns, static_cast<int64_t>(i) * 400'000'000);
    EXPECT_EQ(captures[i].to, "captures");
    EXPECT_TRUE(captures[i].products.empty());
  }
  EXPECT_EQ(captures[5].to, "more");
  EXPECT_EQ(captures[5].products, (std::vector<std::string>{"normal", "flow"}));
  EXPECT_EQ(flown.pilot->CapturesFrom(5).size(), 1u);
  EXPECT_TRUE(flown.pilot->CapturesFrom(100).empty());
}

TEST(Mission, ConditionsAskTheWorld) {
  const auto result = [](const std::string& body) { return Flown(body, {-2, 0, 1.5}, true, 5).pilot->progress().result; };
  EXPECT_EQ(result("<Near what=\"box\" distance=\"4.7\"/>"), Result::kSuccess);  // 4.5 m beside and 0.5 m above it: 4.53 m
  EXPECT_EQ(result("<Near what=\"box\" distance=\"4.4\"/>"), Result::kFailure);
  EXPECT_EQ(result("<BatteryAbove share=\"0.5\"/>"), Result::kSuccess);
  EXPECT_EQ(result("<BatteryAbove share=\"1\"/>"), Result::kFailure);
  EXPECT_EQ(result("<TimeAfter seconds=\"1\"/>"), Result::kFailure);
  EXPECT_EQ(result("<Sequence><Wait seconds=\"1\"/><TimeAfter seconds=\"1\"/></Sequence>"), Result::kSuccess);
  EXPECT_EQ(result("<Sees what=\"box\"/>"), Result::kSuccess);
  EXPECT_EQ(result("<Sees what=\"box\" distance=\"3\"/>"), Result::kFailure);
  EXPECT_EQ(result("<Sees what=\"bench\"/>"), Result::kFailure);  // a category that this world has nothing of
}

TEST(Mission, WhatIsNeitherAThingNorACategoryIsNotLookedFor) {
  const auto error = [](const std::string& what) -> std::string {
    try {
      Flown("<Sees what=\"" + what + "\"/>", {-2, 0, 1.5}, true, 5);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_NE(error("furnture").find("did you mean 'furniture'"), std::string::npos) << error("furnture");
  EXPECT_NE(error("wal north").find("did you mean 'wall north'"), std::string::npos) << error("wal north");
  EXPECT_NE(error("3;4;2").find("no thing, person, vehicle or category '3;4;2'"), std::string::npos);
  EXPECT_EQ(error("furniture"), "no error");
  EXPECT_EQ(error("wall north"), "no error");
  EXPECT_EQ(error("person"), "no error");
}

TEST(Mission, WhatIsSeenCanBeFlownTo) {
  const Flown flown(
      "<Sequence><Sees what=\"box\" thing=\"{it}\"/><Goto to=\"{it}\" distance=\"1\" height=\"1\"/><Near what=\"{it}\" distance=\"1.6\"/></Sequence>",
      {-2, 0, 1.5}, true);
  EXPECT_EQ(flown.pilot->progress().result, Result::kSuccess) << flown.Log();
}

TEST(Mission, AFailureSaysWhereAndWhyAndFallbackGoesOn) {
  const Flown flown("<Fallback>\n<Goto to=\"0;0;9\"/>\n<Goto to=\"-1;0;2\"/></Fallback>", {-2, 0, 1.5}, true);
  EXPECT_EQ(flown.pilot->progress().result, Result::kSuccess);
  EXPECT_NE(flown.Log().find("line 4, Goto: "), std::string::npos) << flown.Log();
  const Flown standing("<Goto to=\"0;0;2\"/>");
  EXPECT_EQ(standing.pilot->progress().result, Result::kFailure);
  EXPECT_NE(standing.Log().find("Takeoff comes first"), std::string::npos);
}

TEST(Mission, TwoNodesCannotHaveTheDroneAtOnce) {
  const Flown flown("<Parallel success_count=\"2\" failure_count=\"1\"><Goto to=\"-2;3;2\"/><Goto to=\"-2;-3;2\"/></Parallel>",
                    {-2, 0, 1.5}, true);
  EXPECT_EQ(flown.pilot->progress().result, Result::kFailure);
  EXPECT_NE(flown.Log().find("another node has taken the drone"), std::string::npos);
}

TEST(Mission, AHaltedNodeLeavesTheDroneHovering) {
  Flown flown("<Timeout msec=\"1500\"><Goto to=\"-2;4;2\" speed=\"1\"/></Timeout>", {-2, -4, 2}, true);
  EXPECT_EQ(flown.pilot->progress().result, Result::kFailure);
  flown.loop.Advance(3000);
  EXPECT_LT(Norm(flown.loop.state().vehicles[0].motion.v_WB), 0.05);
  EXPECT_LT(flown.p().y, -1);
}

TEST(Mission, TheBlackboardIsToldWithTheNamesOfThings) {
  const Flown flown(
      "<Sequence><SetBlackboard value=\"7\" output_key=\"{n}\"/><Sees what=\"box\" distance=\"50\" thing=\"{seen}\"/></Sequence>",
      {-2, 0, 2}, true);
  EXPECT_EQ(flown.pilot->progress().result, Result::kSuccess);
  std::string board;
  for (const auto& [key, value] : flown.pilot->progress().board) board += key + "=" + value + ";";
  EXPECT_EQ(board, "n=7;seen=box;");
}

TEST(Mission, ACommandFromOutsideTakesTheDrone) {
  const auto model = RoomModel({HummingbirdAt({-2, -4, 2}, true)});
  SimLoop loop(model);
  const auto pilot = std::make_shared<MissionPilot>(ReadMission(Xml("<Goto to=\"-2;4;2\" speed=\"1\"/>"), "m.xml", {model, {}}));
  loop.Attach(pilot);
  loop.Advance(1000);
  EXPECT_FALSE(pilot->done());
  ASSERT_EQ(pilot->progress().active.size(), 1u);
  EXPECT_EQ(pilot->progress().active[0].label, "Goto");
  loop.Post({0, FlightCommand{HoverCommand{}}});
  loop.Advance(100);
  EXPECT_EQ(pilot->progress().result, Result::kFailure);
}

TEST(Mission, TheSameMissionGivesTheSameBytesAndItsRecordingReplays) {
  const std::string body = "<Sequence><Goto to=\"-2;3;2\"/><Orbit around=\"0;0;2\" radius=\"2\" height=\"1\"/></Sequence>";
  const auto model = RoomModel({HummingbirdAt({-2, -3, 2}, true)});
  uint64_t hashes[2];
  for (uint64_t& hash : hashes) {
    SimLoop loop(model);
    loop.StartRecording("mission");
    loop.Attach(std::make_shared<MissionPilot>(ReadMission(Xml(body), "m.xml", {model, {}})));
    // Cut into steps in two ways.
    for (int i = 0; i < 20; ++i) &hash == hashes ? loop.Advance(1000) : (loop.Advance(700), loop.Advance(300));
    hash = HashState(loop.state());
    SimState state = StartState(*model);
    const ReplayResult replay = Replay(*model, DecodeRecording(EncodeRecording(*loop.StopRecording()), "r"), state);
    EXPECT_TRUE(replay.same);
    EXPECT_EQ(replay.hash, hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Mission, ErrorsNameLineValueAndNearestChoice) {
  EXPECT_EQ(ErrorOf("<Sequence>\n<Takeof/></Sequence>").substr(0, 54), "m.xml:4: unknown node 'Takeof'; did you mean 'Takeoff'");
  EXPECT_NE(ErrorOf("<Goto too=\"1;2;3\"/>").find("m.xml:3: Goto: unknown attribute 'too'; did you mean 'to'?"), std::string::npos);
  EXPECT_NE(ErrorOf("<Goto to=\"bux\"/>").find("m.xml:3: Goto to: no thing, person or vehicle 'bux' in the world; did you mean 'box'?"),
            std::string::npos)
      << ErrorOf("<Goto to=\"bux\"/>");
  EXPECT_NE(ErrorOf("<Goto to=\"60.17N;24.94E\"/>").find("no place on the Earth"), std::string::npos);
  EXPECT_NE(ErrorOf("<Goto to=\"60.17N;24.94\"/>").find("latitude"), std::string::npos);
  EXPECT_NE(ErrorOf("<Goto to=\"1;2;2e18\"/>").find("2e+18 is not in"), std::string::npos);
  for (const char* speed : {"-1", "0", "nan", "1e308", "inf", "x", ""})
    EXPECT_NE(ErrorOf("<Goto to=\"1;2;3\" speed=\"" + std::string(speed) + "\"/>").find("m.xml:3: Goto speed: "), std::string::npos)
        << speed;
  EXPECT_NE(ErrorOf("<Capture count=\"1.5\"/>").find("1.5 is not a whole number"), std::string::npos);
  EXPECT_NE(ErrorOf("<Capture count=\"200000\"/>").find("is not in 1 … 100000"), std::string::npos);
  EXPECT_NE(ErrorOf("<Capture to=\"../x\"/>").find("no name of a folder"), std::string::npos);
  EXPECT_NE(ErrorOf("<Capture products=\"normals\"/>").find("did you mean 'normal'?"), std::string::npos);
  EXPECT_NE(ErrorOf("<Sequence><Capture/><Capture products=\"normal\"/></Sequence>").find("products 'normal' of the dataset 'captures'"),
            std::string::npos);
  EXPECT_NE(ErrorOf("<Gimbal/>").find("the drone has no gimbal"), std::string::npos);
  EXPECT_THROW(ReadMission("", "m.xml", {RoomModel({HummingbirdAt({})}), {}}), InputError);
  EXPECT_THROW(ReadMission("<root BTCPP_format=\"4\"/>", "m.xml", {RoomModel({HummingbirdAt({})}), {}}), InputError);
  // Names are looked up only where there is a world.
  EXPECT_NO_THROW(CheckMission(Xml("<Goto to=\"bux\"/>"), "m.xml"));
}

TEST(Mission, AMissionDoesNotTravelWithASnapshot) {
  const auto model = RoomModel({HummingbirdAt({-2, -4, 2}, true)});
  SimLoop loop(model);
  const auto start = loop.Snapshot();
  const auto pilot = std::make_shared<MissionPilot>(ReadMission(Xml("<Goto to=\"-2;4;2\" speed=\"1\"/>"), "m.xml", {model, {}}));
  loop.Attach(pilot);
  loop.Advance(1000);
  loop.Restore(*start);
  loop.Advance(1000);
  EXPECT_NEAR(Norm(loop.state().vehicles[0].motion.X_WB.p - Vec3d{-2, -4, 2}), 0, 0.05);
  EXPECT_FALSE(pilot->done());
}

TEST(Mission, PlacesOnTheEarthAreMetresOfTheWorld) {
  const auto model = RoomModel({HummingbirdAt({})});
  const MissionWorld world{model, GeoPoint{60, 25, 0}};
  const behaviour::Value north = ParseThing("60.001N;25E;12", &world);
  // A minute of latitude is about a sea mile: 0.001 degrees are 111.4 m at 60 degrees north.
  EXPECT_NEAR(north.point.y, 111.4, 0.2);
  EXPECT_NEAR(north.point.x, 0, 1e-6);
  EXPECT_EQ(north.point.z, 12);
  EXPECT_FALSE(ParseThing("60N,25E", &world).has_height);
  EXPECT_THROW(ParseThing("10N,25E", &world), InputError);
}

TEST(Mission, LooksAtWhatItIsToldTo) {
  const Flown flown("<Look at=\"box\"/>", {3, -3, 1.5}, true);
  ASSERT_EQ(flown.pilot->progress().result, Result::kSuccess) << flown.Log();
  const Mat3d R = flown.loop.state().vehicles[0].motion.X_WB.R;
  EXPECT_NEAR(std::atan2(R.m[1][0], R.m[0][0]), M_PI / 2, 0.06);
}

TEST(Mission, FollowsAPersonAtTheDistanceAndLooksAtThem) {
  PeopleRequest request;
  request.count = 1;
  request.seed = 4;
  const PopulatedScene populated = Populate(BuildWorld("box_room", {}), request);
  auto model = RoomModel({HummingbirdAt({-2, 0, 2}, true)});
  model->people = populated.people;
  model->tracer = WithoutBodies(std::make_shared<const RayTracer>(populated.scene), {}, populated.people.get(), nullptr);
  const std::string name = populated.people->cast[0].name;
  SimLoop loop(model);
  const auto pilot = std::make_shared<MissionPilot>(
      ReadMission(Xml("<Follow who=\"" + name + "\" distance=\"1.5\" height=\"1\" seconds=\"12\"/>"), "m.xml", {model, {}}));
  loop.Attach(pilot);
  double walked = 0;
  Vec3d before = FindThing(*model, loop.state(), ParseThing(name, &pilot->mission().world))->p_W;
  for (int i = 0; i < 115; ++i) {
    loop.Advance(100);
    const ThingNow person = *FindThing(*model, loop.state(), ParseThing(name, &pilot->mission().world));
    walked += Norm(person.p_W - before);
    before = person.p_W;
    if (i < 40) continue;  // it has come near by then
    const RigidTransform X_WB = loop.state().vehicles[0].motion.X_WB;
    const Vec3d way = person.p_W - X_WB.p;
    EXPECT_NEAR(std::hypot(way.x, way.y), 1.5, 0.7) << i;
    EXPECT_NEAR(way.z, -1, 0.4) << i;
    EXPECT_LT(std::abs(std::remainder(std::atan2(way.y, way.x) - std::atan2(X_WB.R.m[1][0], X_WB.R.m[0][0]), 2 * M_PI)), 0.5) << i;
  }
  EXPECT_GT(walked, 1);  // they do not stand still
  loop.Advance(1000);
  EXPECT_EQ(pilot->progress().result, Result::kSuccess);
  EXPECT_EQ(loop.state().vehicles[0].collision.count, 0u);
}

TEST(Mission, AGimbalTurnsWhereItIsTold) {
  DroneSetup setup = HummingbirdAt({-2, 0, 2}, true);
  setup.sensors.gimbals.push_back({"gimbal", {}});
  const auto model = RoomModel({setup});
  SimLoop loop(model);
  const auto pilot = std::make_shared<MissionPilot>(ReadMission(Xml("<Gimbal pitch_deg=\"-60\"/>"), "m.xml", {model, {}}));
  loop.Attach(pilot);
  loop.Advance(2000);
  EXPECT_EQ(pilot->progress().result, Result::kSuccess);
  EXPECT_NEAR(loop.state().vehicles[0].sensors.gimbals[0].joints.pitch, -M_PI / 3, 0.05);
}

TEST(Mission, ThePaletteNamesEveryLeafOnce) {
  int last = static_cast<int>(MissionNode::kTakeoff) - 1;
  for (const behaviour::NodeInfo& info : MissionPalette().nodes()) {
    if (info.node < behaviour::Node::kFirstLeaf) continue;
    EXPECT_EQ(static_cast<int>(info.node), ++last) << info.name;
  }
  EXPECT_EQ(last, static_cast<int>(MissionNode::kTimeAfter));
}

}  // namespace
}  // namespace airsim360
