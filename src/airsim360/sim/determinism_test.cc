// The same bytes with any number of threads, from a snapshot, and from a recording.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/sim/pacer.h"
#include "airsim360/sim/test_flights.h"
#include "airsim360/sim/trajectory_reference.h"

namespace airsim360 {
namespace {

using internal::HummingbirdAt;
using internal::RoomModel;
using internal::Wait;

// Many drones in the room, close enough to meet, in gusty commands.
std::shared_ptr<SimModel> Crowd() {
  std::vector<DroneSetup> setups;
  for (int i = 0; i < 20; ++i) setups.push_back(HummingbirdAt({-3.2 + 1.6 * (i % 5), -3.0 + 1.6 * (i / 5), 2.0 + 0.1 * i}));
  return RoomModel(setups);
}

std::vector<SimCommand> RandomCommands(RngStream& random, size_t vehicles) {
  std::vector<SimCommand> commands;
  for (size_t i = 0; i < vehicles; ++i) {
    const Vec3d v{random.Uniform(-3, 3), random.Uniform(-3, 3), random.Uniform(-1, 1)};
    commands.push_back({i, FlightCommand{VelocityCommand{.v = v}}});
  }
  return commands;
}

uint64_t RunCrowd(const SimModel& model, int steps) {
  SimState state = StartState(model);
  RngStream random(1, "commands");
  for (int i = 0; i < steps; ++i) {
    Step(model, i % 250 == 0 ? RandomCommands(random, state.vehicles.size()) : std::vector<SimCommand>(), state);
  }
  return HashState(state);
}

TEST(Determinism, OneAndManyThreadsGiveTheSameHash) {
  const auto model = Crowd();
  const uint64_t many = RunCrowd(*model, 1500);
  const ThreadLimit one(1);
  EXPECT_EQ(RunCrowd(*model, 1500), many);
}

TEST(Determinism, ARestoredSnapshotOfFlyingDronesContinuesWithTheSameBytes) {
  const auto model = Crowd();
  SimState state = StartState(*model);
  RngStream random(2, "commands");
  Step(*model, RandomCommands(random, 20), state);
  Wait(*model, state, 1);
  const SimState snapshot = state;
  Wait(*model, state, 0.5);
  const uint64_t hash = HashState(state);
  state = snapshot;
  Wait(*model, state, 0.5);
  EXPECT_EQ(HashState(state), hash);
}

TEST(Determinism, HashSeesEveryPartOfADrone) {
  const auto model = RoomModel({HummingbirdAt({0, 0, 2})});
  SimState state = StartState(*model);
  Wait(*model, state, 0.3);
  std::vector<SimState> changed(14, state);
  const auto drone = [&](size_t i) -> Vehicle& { return changed[i].vehicles[0]; };
  drone(0).drone.rotor_speeds[3] += 1e-9;
  drone(1).drone.charge -= 1e-12;
  drone(2).autopilot.reference_v.y += 1e-12;
  drone(3).command.id += 1;
  drone(4).contact.free_distance += 1e-9;
  drone(5).collision.count += 1;
  drone(6).sensors.imus[0].gyro.walk.x += 1e-15;
  drone(7).sensors.gnss[0].pending.pop_back();
  drone(8).rotor_commands[0] += 1;
  drone(9).health[1] = 0;
  drone(10).gusts.turbulence.u += 1e-9;
  drone(11).alpha_WB_B.z += 1e-9;
  drone(12).sensors.magnetometers[0].last.field.x += 1e-12;
  changed[13].wind_W.x = 1;
  for (const SimState& other : changed) EXPECT_NE(HashState(other), HashState(state));
}

// A run with a command of every kind.
Recording RecordedRun(SimLoop& loop) {
  loop.StartRecording("box_room, two hummingbirds", 500);
  const auto polynomial =
      std::make_shared<const PolynomialTrajectory>(PolynomialOf(RouteThrough({{.p = {-1, 0, 2}}, {.p = {1, 1, 3}}, {.p = {-1, 0, 2}}}, 2)));
  const auto path = std::make_shared<const std::vector<Vec3d>>(std::vector<Vec3d>{{1, 1, 2}, {2, -1, 2}});
  const std::vector<std::vector<SimCommand>> script = {
      {{1, FlightCommand{TakeoffCommand{}}}, {0, GimbalCommand{0, {0, -0.5, 0}}}},
      {{0, FlightCommand{TrajectoryCommand{std::make_shared<const PlannedReference>(polynomial, std::nullopt)}}}},
      {{1, FlightCommand{PathCommand{.waypoints = path, .speed = 1}}}},
      {{0, FlightCommand{AttitudeCommand{.roll = 0.1, .vertical = {VerticalTarget::Mode::kAltitude, 2.5}}, 300'000'000}}},
      {{0, WindCommand{{1, 2, 0}}}, {1, FlightCommand{RateCommand{.w_B = {0, 0, 1}, .vertical = {VerticalTarget::Mode::kThrottle, 0.3}}}}},
      {{1, FlightCommand{ReturnCommand{}}}, {0, RotorHealthCommand{{1, 1, 0.9, 1, 1, 1, 1, 1}}}},
      {{0, std::make_shared<const Route>(RouteThrough({{.p = {0, 0, 2}}, {.p = {2, 0, 2}}}, 2))}},
      {{0, FlightCommand{HoverCommand{}}}, {1, ResetCommand{.X_WB = BodyPose({1, 1, 3}, 0, 0, 0), .airborne = true}}},
  };
  for (const auto& commands : script) {
    for (const SimCommand& command : commands) loop.Post(command);
    loop.Advance(300);
  }
  return *loop.StopRecording();
}

std::shared_ptr<SimModel> TwoDrones() {
  DroneSetup first = HummingbirdAt({-1, 0, 2}), second = HummingbirdAt({2, 2, 1}, false);
  first.sensors.gimbals = {{"nose", {}}};
  return RoomModel({first, second});
}

TEST(Recording, OfEveryKindOfCommandReplaysBitForBitFromItsFile) {
  const auto model = TwoDrones();
  SimLoop loop(model);
  const Recording recording = RecordedRun(loop);
  EXPECT_EQ(recording.steps, 8 * 300);
  ASSERT_EQ(recording.commands.size(), 8u);

  const Bytes bytes = EncodeRecording(recording);
  const Recording read = DecodeRecording(bytes, "run");
  EXPECT_EQ(EncodeRecording(read), bytes);
  SimState state = StartState(*model);
  const ReplayResult result = Replay(*model, read, state);
  EXPECT_TRUE(result.same) << "differs at step " << result.differs_at;
  EXPECT_EQ(result.steps, recording.steps);
  EXPECT_EQ(HashState(state), HashState(*loop.Snapshot()));
}

TEST(Recording, AChangedCommandIsFoundOutAtTheNextHash) {
  const auto model = TwoDrones();
  SimLoop loop(model);
  Recording recording = RecordedRun(loop);
  std::get<WindCommand>(recording.commands[4].commands[0].action).wind_W.x = 1.001;
  SimState state = StartState(*model);
  const ReplayResult result = Replay(*model, recording, state);
  EXPECT_FALSE(result.same);
  EXPECT_EQ(result.differs_at, 1500);  // the wind changed at step 1200, hashes come every 500
  // Another start, or another step, is refused.
  EXPECT_THROW(Replay(*model, recording, state), InputError);
}

TEST(Recording, DamagedCutOrForeignFilesAreRefused) {
  const auto model = TwoDrones();
  SimLoop loop(model);
  const Bytes bytes = EncodeRecording(RecordedRun(loop));
  for (const size_t size : {size_t{0}, size_t{7}, size_t{60}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_THROW(DecodeRecording(std::span(bytes).first(size), "run"), InputError) << size;
  for (size_t place = 0; place < bytes.size(); place += 97) {
    Bytes damaged = bytes;
    damaged[place] ^= std::byte{1};
    EXPECT_THROW(DecodeRecording(damaged, "run"), InputError) << place;
  }
  try {
    DecodeRecording(AsBytes("not a recording at all, but long enough to look at: 0123456789 0123456789 0123456789"), "some.file");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "some.file: not a recording");
  }
}

TEST(Recording, ImpossibleStepsAreRefused) {
  constexpr int64_t kLeast = std::numeric_limits<int64_t>::min(), kMost = std::numeric_limits<int64_t>::max();
  const auto good = [] { return Recording{.dt_ns = 1'000'000, .first_step = 5, .steps = 10}; };
  EXPECT_NO_THROW(DecodeRecording(EncodeRecording(good()), "run"));
  for (const int64_t wrong : {kLeast, int64_t{-1}, kMost}) {
    Recording first = good(), length = good();
    first.first_step = wrong, length.steps = wrong;
    EXPECT_THROW(DecodeRecording(EncodeRecording(first), "run"), InputError) << wrong;
    EXPECT_THROW(DecodeRecording(EncodeRecording(length), "run"), InputError) << wrong;
  }
  Recording before = good(), hash = good();
  before.commands = {{4, {}}};
  hash.hashes = {{kLeast, 0}};
  EXPECT_THROW(DecodeRecording(EncodeRecording(before), "run"), InputError);
  EXPECT_THROW(DecodeRecording(EncodeRecording(hash), "run"), InputError);
}

TEST(Recording, TrajectoriesThatAFileCannotHoldAreRefused) {
  const auto model = TwoDrones();
  SimLoop loop(model);
  loop.StartRecording("");
  loop.Post({0, FlightCommand{TrajectoryCommand{std::make_shared<const Lemniscate>(Vec3d{0, 0, 2}, 1, 1)}}});
  EXPECT_THROW(loop.Advance(1), InputError);
}

TEST(SimLoop, PausesContinuesForStepsAndRestores) {
  SimLoop loop(TwoDrones());
  loop.Pause();
  EXPECT_EQ(loop.AdvanceUnlessPaused(10), 0);
  loop.Continue(7);
  EXPECT_EQ(loop.AdvanceUnlessPaused(10), 7);
  EXPECT_TRUE(loop.paused());
  loop.Advance(3);  // lockstep clients do not care
  EXPECT_EQ(loop.Snapshot()->step, 10);
  loop.Continue();
  EXPECT_EQ(loop.AdvanceUnlessPaused(10), 10);

  const auto snapshot = loop.Snapshot();
  loop.Post({0, FlightCommand{VelocityCommand{.v = {1, 0, 0}}}});
  loop.Advance(100);
  const uint64_t moved = HashState(*loop.Snapshot());
  loop.Restore(*snapshot);
  EXPECT_EQ(HashState(*loop.Snapshot()), HashState(*snapshot));
  loop.Post({0, FlightCommand{VelocityCommand{.v = {1, 0, 0}}}});
  loop.Advance(100);
  EXPECT_EQ(HashState(*loop.Snapshot()), moved);
}

TEST(SimLoop, RefusesWrongCommandsAtOnceAndKeepsRunning) {
  SimLoop loop(TwoDrones());
  EXPECT_THROW(loop.Post({2, FlightCommand{HoverCommand{}}}), InputError);
  EXPECT_THROW(loop.Post({1, GimbalCommand{}}), InputError);
  EXPECT_THROW(loop.Post({0, std::shared_ptr<const Route>()}), InputError);
  loop.Advance(2);
  EXPECT_EQ(loop.Snapshot()->step, 2);
}

TEST(RealTimePacer, ReachesItsTimeExactlyWithTheStatesOfALockstepClient) {
  SimLoop paced(TwoDrones()), lockstep(TwoDrones());
  RealTimePacer pacer(paced, 0);
  pacer.Run(303'000'000);
  lockstep.Advance(303);
  EXPECT_EQ(paced.t_ns(), 303'000'000);
  EXPECT_EQ(HashState(*paced.Snapshot()), HashState(*lockstep.Snapshot()));
  EXPECT_NEAR(pacer.report().simulated, 0.303, 1e-9);
  EXPECT_THROW(RealTimePacer(paced, -1), InputError);
}

TEST(RealTimePacer, IsNeverFasterThanItsSpeed) {
  SimLoop loop(TwoDrones());
  RealTimePacer pacer(loop, 2);
  pacer.Run(200'000'000);
  EXPECT_LE(pacer.report().real_time_factor, 2.1);
}

TEST(PolynomialOf, IsTheRouteAtEveryTime) {
  const Route route = RouteThrough({{.p = {-1, 0, 2}}, {.p = {1, 1, 3}}, {.p = {-1, 2, 2}}}, 2);
  const PolynomialTrajectory polynomial = PolynomialOf(route);
  for (double t = 0; t <= route.duration(); t += 0.013) {
    const RoutePoint expected = route.At(t);
    const TrajectoryPoint point = polynomial.At(t);
    ASSERT_LT(Norm(point.p - expected.p), 1e-12);
    ASSERT_LT(Norm(point.v - expected.v), 1e-11);
    ASSERT_LT(Norm(point.a - expected.a), 1e-10);
  }
}

TEST(PlannedReference, LooksAlongTheWayAndItsRateIsTheDerivativeOfItsHeading) {
  const auto polynomial =
      std::make_shared<const PolynomialTrajectory>(PolynomialOf(RouteThrough({{.p = {-4, 0, 2}}, {.p = {0, 3, 3}}, {.p = {4, 0, 2}}}, 2)));
  const PlannedReference reference(polynomial, std::nullopt);
  const double middle = polynomial->duration() / 2, h = 1e-5;
  EXPECT_NEAR(reference.At(middle).yaw, 0, 1e-9);  // at the top it flies east
  for (double t = 1; t < polynomial->duration() - 1; t += 0.1) {
    const double slope = (reference.At(t + h).yaw - reference.At(t - h).yaw) / (2 * h);
    ASSERT_NEAR(reference.At(t).yaw_rate, slope, 1e-5) << t;
  }
  EXPECT_EQ(PlannedReference(polynomial, 1.25).At(2).yaw, 1.25);
}

}  // namespace
}  // namespace airsim360
