// People as part of the simulation: stepped, copied, hashed, recorded, seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/sim/capture.h"
#include "airsim360/sim/fly_route.h"
#include "airsim360/sim/people/populate.h"
#include "airsim360/sim/recording.h"
#include "airsim360/sim/test_flights.h"

namespace airsim360 {
namespace {

using internal::HummingbirdAt;

/// Four people in the room, and a drone that hovers among them.
struct Peopled {
  PopulatedScene populated;
  std::shared_ptr<const RayTracer> base;
  std::shared_ptr<SimModel> model = std::make_shared<SimModel>();

  explicit Peopled(Vec3d p_drone = {0, 0, 3}, uint64_t seed = 3) {
    populated = Populate(BuildWorld("box_room", {}), {.count = 4, .warm_up = 2, .level = 2, .seed = seed});
    base = std::make_shared<const RayTracer>(populated.scene);
    model->tracer = WithoutBodies(base, {}, populated.people.get());
    model->people = populated.people;
    DroneSetup setup = HummingbirdAt(p_drone);
    CameraSpec panorama;
    panorama.width = 256, panorama.height = 128;
    panorama.tier = Tier::kLabels;
    setup.sensors.cameras = {{"panorama", panorama}};
    model->drones.push_back(std::make_shared<const SimDrone>(setup, model->dt_ns));
  }
};

const Peopled& Room() {
  static const Peopled room;
  return room;
}

TEST(SimPeople, AreEntitiesAfterThoseOfTheWorld) {
  const Scene& scene = *Room().populated.scene;
  EXPECT_EQ(scene.entity(1).name, "floor");
  const auto& refs = Room().populated.people->refs;
  ASSERT_EQ(refs.size(), 4u);
  EXPECT_EQ(refs[0].entity, 8u);
  EXPECT_EQ(scene.entity(refs[3].entity).name, "person/003");
  EXPECT_EQ(scene.tree[scene.entity(refs[3].entity).category].path, "human/person");
  // A second time, the same.
  const Peopled again;
  EXPECT_EQ(HashPeople(*again.populated.people->start), HashPeople(*Room().populated.people->start));
}

TEST(SimPeople, AreBroughtToEveryTickThatAStepReaches) {
  const SimModel& model = *Room().model;
  SimState state = StartState(model);
  const int64_t start = state.people->crowd.t_ns;
  EXPECT_EQ(start, 2'000'000'000);
  for (int i = 0; i < 49; ++i) Step(model, {}, state);
  EXPECT_EQ(state.people->crowd.t_ns, start);
  Step(model, {}, state);
  EXPECT_EQ(state.people->crowd.t_ns, start + kCrowdTickNs);
  EXPECT_EQ(state.t_ns, kCrowdTickNs);
}

TEST(SimPeople, ASnapshotContinuesWithTheSameBytesAndIsNotChanged) {
  const SimModel& model = *Room().model;
  SimState state = StartState(model);
  for (int i = 0; i < 500; ++i) Step(model, {}, state);
  const SimState snapshot = state;
  const uint64_t then = HashState(snapshot);
  for (int i = 0; i < 700; ++i) Step(model, {}, state);
  EXPECT_EQ(HashState(snapshot), then);
  SimState again = snapshot;
  for (int i = 0; i < 700; ++i) Step(model, {}, again);
  EXPECT_EQ(HashState(again), HashState(state));
  EXPECT_NE(HashState(again), then);
}

TEST(SimPeople, TheHashDoesNotDependOnThreads) {
  const auto run = [](int threads) {
    const ThreadLimit limit(threads);
    const Peopled room({0, 0, 3}, 9);
    SimState state = StartState(*room.model);
    for (int i = 0; i < 1000; ++i) Step(*room.model, {}, state);
    return HashState(state);
  };
  EXPECT_EQ(run(1), run(4));
}

TEST(SimPeople, ARecordedRunWithCommandsToPeopleIsRepeated) {
  const SimModel& model = *Room().model;
  SimState state = StartState(model);
  Recorder recorder(model, state, "people", 100);
  for (int i = 0; i < 400; ++i) {
    std::vector<SimCommand> commands;
    const Vec3d p = state.people->crowd.people[0].p_WP;
    if (i == 120) commands.push_back({0, PersonCommand{0, MovePerson{p, 1.5}}});
    recorder.Before(state, commands);
    Step(model, commands, state);
    recorder.After(state);
  }
  const Recording recording = DecodeRecording(EncodeRecording(recorder.Finish(state)), "test");
  ASSERT_EQ(recording.commands.size(), 1u);
  SimState again = StartState(model);
  const ReplayResult result = Replay(model, recording, again);
  EXPECT_TRUE(result.same);
  EXPECT_EQ(result.hash, HashState(state));
}

TEST(SimPeople, CommandsToNobodyAreRefused) {
  const SimModel& model = *Room().model;
  SimState state = StartState(model);
  const std::vector<SimCommand> wrong = {{0, PersonCommand{99, MovePerson{}}}};
  EXPECT_THROW(Step(model, wrong, state), InputError);
  SimModel empty = model;
  empty.people = nullptr;
  SimState nobody = StartState(empty);
  EXPECT_THROW(CheckCommand(empty, nobody, {0, PersonCommand{0, RemovePerson{}}}), InputError);
}

TEST(SimPeople, AreSeenWhereTheyAreAtTheInstantOfTheCapture) {
  const Peopled& room = Room();
  SimState state = StartState(*room.model);
  for (int i = 0; i < 1234; ++i) Step(*room.model, {}, state);
  const PeoplePoses poses = PosesAt(*room.populated.people, *state.people, state.t_ns + room.populated.people->epoch_ns);
  const auto scene_state = SceneStateOf(*room.model, state, kNobody);
  ASSERT_EQ(scene_state->deformed.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    const PersonState &now = poses.states[i], &tick = state.people->crowd.people[i];
    // 34 ms after the tick they have moved on, at most at a run.
    EXPECT_LT(Norm(now.p_WP - tick.p_WP), 0.034 * 3 + 1e-6);
    EXPECT_LT(Norm(VecCast<double>(scene_state->moved[i].X_WM.p) - now.p_WP), 1e-3);
  }
  SnapshotSensors sensors(room.model, room.base);
  const auto renderer = MakeCpuRenderer(room.base, {.tier = Tier::kLabels});
  Capture capture;
  sensors.Camera(state, 0, 0, {.rgb = false}, *renderer, capture);
  size_t seen = 0;
  for (const PersonRef& ref : room.populated.people->refs) seen += std::ranges::count(capture.frame.entity.pixels(), ref.entity) > 0;
  EXPECT_GE(seen, 2u);
}

TEST(SimPeople, GoOnWalkingInTheStateThatFlowLeadsTo) {
  const Peopled& room = Room();
  const SimPeople& people = *room.populated.people;
  SimState state = StartState(*room.model);
  for (int i = 0; i < 1234; ++i) Step(*room.model, {}, state);
  const auto now = SceneStateOf(*room.model, state, 0), later = InstantAfter(*room.model, state, 0, 0.3).state;
  EXPECT_EQ(later->t_ns, state.t_ns + 300'000'000);
  ASSERT_EQ(now->moved.size(), later->moved.size());
  double moved = 0;
  for (size_t i = 0; i < now->moved.size(); ++i) {
    EXPECT_EQ(now->moved[i].instance, later->moved[i].instance);
    EXPECT_EQ(now->moved[i].hidden, later->moved[i].hidden);
    const double way = Norm(later->moved[i].X_WM.p - now->moved[i].X_WM.p);
    EXPECT_LT(way, 0.3 * 3);
    moved += way;
  }
  EXPECT_GT(moved, 0.05);
  // As they are after the ticks in between, nobody disturbing them.
  PeopleState stepped = *state.people;
  const int64_t t_ns = later->t_ns + people.epoch_ns;
  while (stepped.crowd.t_ns + kCrowdTickNs <= t_ns) TickPeople(people, {}, stepped);
  EXPECT_EQ(PosesAt(people, stepped, t_ns).poses[0].X_WJ[9].p, PosesLater(people, *state.people, t_ns).poses[0].X_WJ[9].p);
}

TEST(SimPeople, DetailFollowsTheDistance) {
  const SimPeople& people = *Room().populated.people;
  std::vector<PersonState> states(4);
  for (size_t i = 0; i < 4; ++i) states[i].p_WP = {std::array{3.0, 12.0, 40.0, 90.0}[i], 0, 0};
  EXPECT_EQ(LevelsFor(people, states, {0, 0, 1.5}), (std::vector<uint8_t>{0, 1, 2, 3}));
  // Whatever the number of people: levels that fit are there for everybody.
  const PopulatedScene populated = Populate(BuildWorld("box_room", {}), {.count = 2, .warm_up = 0, .seed = 3});
  for (const PersonRef& ref : populated.people->refs) {
    EXPECT_EQ(ref.level, 0);
    EXPECT_EQ(ref.level_count, 4);
    EXPECT_EQ(populated.scene->instances[ref.InstanceOf(3)].mesh, ref.MeshOf(3));
  }
}

TEST(SimPeople, TheBoxOfWhoSitsHoldsTheirPelvis) {
  const SimPeople& people = *Room().populated.people;
  PeopleState state = *people.start;
  PersonState& person = state.crowd.people[0];
  person.v_WP = {};
  person.lower = person.upper = Behaviour::kSit;
  person.seating = {.height = 0.45, .reach = 0.43, .desk = 0};
  for (const double yaw : {0.0, 2.0}) {
    person.yaw = yaw;
    const Body& body = *people.cast[0].body;
    MotionState motion = StartMotion(body, person, 1, state.crowd.t_ns);
    for (int k = 1; k <= 60; ++k) StepMotion(body, person, state.crowd.t_ns + k * 50'000'000ll, nullptr, motion);
    const Vec3d pelvis = PoseOf(body, motion, person)[Joint::kPelvis].p;
    const std::vector<PersonBox> boxes = PeopleNear(people, state, state.crowd.t_ns, person.p_WP, 0.1);
    ASSERT_FALSE(boxes.empty());
    ASSERT_EQ(boxes[0].entity, people.refs[0].entity);
    const Vec3d p = boxes[0].X_WB.inverse() * pelvis;
    for (int k = 0; k < 3; ++k) EXPECT_LT(std::abs(p[k]), boxes[0].half_size_B[k]) << "axis " << k;
    EXPECT_GT(Norm(pelvis - Vec3d{person.p_WP.x, person.p_WP.y, pelvis.z}), 0.3);  // well behind the feet
  }
}

TEST(SimPeople, ADroneThatComesNearIsToldOfIt) {
  const Peopled& probe = Room();
  const Vec3d p = probe.populated.people->start->crowd.people[0].p_WP;
  const Peopled room({p.x, p.y, p.z + 2.2});
  SimState state = StartState(*room.model);
  std::vector<SimEvent> events = internal::Wait(*room.model, state, 1.0);
  const SimEvent* near = internal::FindEvent(events, SimEvent::Kind::kNearPerson);
  ASSERT_NE(near, nullptr);
  EXPECT_EQ(near->vehicle, 0u);
  EXPECT_LT(near->person, 4u);
  EXPECT_NE(near->text.find("person"), std::string::npos);
}

TEST(SimPeople, ADroneThatFliesIntoSomeoneCollidesWithThem) {
  const Vec3d p = Room().populated.people->start->crowd.people[0].p_WP;
  const Peopled room({p.x, p.y, p.z + 1.0});
  SimState state = StartState(*room.model);
  const std::vector<SimEvent> events = internal::Wait(*room.model, state, 0.5);
  const SimEvent* hit = internal::FindEvent(events, SimEvent::Kind::kCollision);
  ASSERT_NE(hit, nullptr);
  EXPECT_TRUE(IsPerson(*room.populated.people, hit->collision.entity));
}

TEST(SimPeople, ARoutesShotsHoldThePeopleOfTheirTime) {
  const Peopled& room = Room();
  SimModel model = *room.model;
  model.dt_ns = kRouteStepNs;
  model.drones.clear();
  const auto route = std::make_shared<const Route>(RouteThrough(std::vector<Waypoint>{{.p = {-1, 0, 3}}, {.p = {1, 0, 3}}}, 1));
  const std::vector<int64_t> times = EvenTimes(*route, 3);
  const Flight flight = FlyRoute(model, route, times);
  ASSERT_EQ(flight.shots.size(), 3u);
  for (const Shot& shot : flight.shots) {
    ASSERT_NE(shot.people, nullptr);
    const int64_t behind = shot.t_ns + room.populated.people->epoch_ns - shot.people->crowd.t_ns;
    EXPECT_GE(behind, 0);
    EXPECT_LT(behind, kCrowdTickNs);
  }
}

}  // namespace
}  // namespace airsim360
