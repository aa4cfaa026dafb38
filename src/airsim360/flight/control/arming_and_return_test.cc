// Arming, take-off, landing, return, the fence, failures.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "airsim360/base/random.h"
#include "airsim360/flight/control/attitude.h"
#include "airsim360/flight/control/flight_check.h"
#include "airsim360/flight/drones/catalog.h"

namespace airsim360 {
namespace {

/// A level floor at z = 0 that stops what falls on it.
void StepOnFloor(FlightLoop& loop) {
  loop.Step();
  if (loop.state.p_WB.z > 0) return;
  loop.state.p_WB.z = 0;
  loop.state.v_WB = {0, 0, std::max(loop.state.v_WB.z, 0.0)};
  loop.state.w_WB_B = {};
  loop.state.q_WB = {std::cos(internal::HeadingOf(ToMatrix(loop.state.q_WB)) / 2), 0, 0,
                     std::sin(internal::HeadingOf(ToMatrix(loop.state.q_WB)) / 2)};
}

void RunOnFloor(FlightLoop& loop, double seconds) {
  for (double t = 0; t < seconds; t += loop.autopilot().options().control_dt) StepOnFloor(loop);
}

FlightLoop OnTheGround(const char* name = "f450", ControllerKind kind = ControllerKind::kIndi) {
  AutopilotOptions options;
  options.controller = kind;
  FlightLoop loop(CatalogModel(name), options);
  loop.state.rotor_speeds = {};
  loop.pilot = loop.autopilot().GroundState(EstimateOf(loop.state, 0));
  return loop;
}

TEST(Mission, ADisarmedDroneRefusesToFlyAndItsRotorsStandStill) {
  FlightLoop loop = OnTheGround();
  VelocityCommand command;
  command.v = {0, 0, 1};
  loop.Give(command);
  RunOnFloor(loop, 0.5);
  EXPECT_TRUE(loop.pilot.flags & kCommandRefused);
  EXPECT_EQ(loop.autopilot().Problem(command, loop.pilot), "velocity: the drone is disarmed; arm it or take off first");
  EXPECT_EQ(loop.state.p_WB.z, 0);
  EXPECT_EQ(loop.state.rotor_speeds[0], 0);
}

TEST(Mission, ArmingIdlesTheRotorsWithoutLeavingTheGround) {
  FlightLoop loop = OnTheGround();
  loop.Give(ArmCommand{});
  RunOnFloor(loop, 1);
  EXPECT_EQ(loop.pilot.mode, FlightMode::kGround);
  EXPECT_NEAR(loop.state.rotor_speeds[0], 0.05 * loop.model().rotors[0].max_speed, 0.1);
  EXPECT_EQ(loop.state.p_WB.z, 0);
  loop.Give(DisarmCommand{});
  RunOnFloor(loop, 1);
  EXPECT_EQ(loop.pilot.mode, FlightMode::kDisarmed);
}

TEST(Mission, TakesOffKeepsItsHeightLandsAndDisarmsAtRestWithEveryController) {
  for (const ControllerKind kind : {ControllerKind::kIndi, ControllerKind::kSe3, ControllerKind::kPx4, ControllerKind::kSimpleFlight}) {
    // AirSim's gains belong to its own drone.
    FlightLoop loop = OnTheGround(kind == ControllerKind::kSimpleFlight ? "airsim_quad" : "f450", kind);
    loop.Give(TakeoffCommand{2, 1});
    RunOnFloor(loop, 8);
    EXPECT_NEAR(loop.state.p_WB.z, 2, 0.15) << ControllerKindName(kind);
    EXPECT_LT(std::hypot(loop.state.p_WB.x, loop.state.p_WB.y), 0.05);
    EXPECT_TRUE(loop.pilot.flags & kCommandDone) << ControllerKindName(kind);
    loop.Give(LandCommand{});
    RunOnFloor(loop, 8);
    EXPECT_EQ(loop.pilot.mode, FlightMode::kDisarmed) << ControllerKindName(kind);
    EXPECT_EQ(loop.state.p_WB.z, 0);
    EXPECT_LT(Norm(loop.state.v_WB), 1e-6);
    EXPECT_LT(loop.state.rotor_speeds[0], 1);
  }
}

TEST(Mission, ReturnClimbsFliesHomeAndLands) {
  FlightLoop loop = OnTheGround();
  loop.Give(TakeoffCommand{2, 1});
  RunOnFloor(loop, 5);
  PositionCommand away;
  away.p_W = {12, 5, 3};
  loop.Give(away);
  RunOnFloor(loop, 10);
  loop.Give(ReturnCommand{6, 4, true});
  double highest = 0;
  for (int i = 0; i < 20000 && loop.pilot.mode != FlightMode::kDisarmed; ++i) {
    StepOnFloor(loop);
    highest = std::max(highest, loop.state.p_WB.z);
  }
  EXPECT_EQ(loop.pilot.mode, FlightMode::kDisarmed);
  EXPECT_NEAR(highest, 6, 0.2);
  EXPECT_LT(std::hypot(loop.state.p_WB.x, loop.state.p_WB.y), 0.3);
}

TEST(Mission, TheFenceHoldsPositionsVelocitiesTrajectoriesAndFlightByHand) {
  AutopilotOptions options;
  options.fence = Geofence{{-5, -5, 1}, {5, 5, 12}, 1e9};
  VelocityCommand velocity;
  velocity.v = {8, 1, 0};
  PositionCommand position;
  position.p_W = {50, 0, 50};
  AttitudeCommand attitude;
  attitude.pitch = -0.4;
  attitude.vertical = {VerticalTarget::Mode::kAltitude, 10};
  const TrajectoryCommand trajectory{std::make_shared<Lemniscate>(Vec3d{0, 0, 10}, 8, 5)};
  for (const Command& command : {Command(velocity), Command(position), Command(attitude), Command(trajectory)}) {
    FlightLoop loop(CatalogModel("agilicious"), options, {0, 0, 10});
    loop.Give(command);
    double furthest = 0;
    for (int i = 0; i < 5000; ++i) {
      loop.Step();
      furthest = std::max(furthest, loop.state.p_WB.x);
    }
    EXPECT_TRUE(loop.pilot.flags & kFenceHeld) << CommandName(command);
    EXPECT_LT(furthest, 5.3) << CommandName(command);
    EXPECT_GT(furthest, 2.5) << CommandName(command);
    EXPECT_LT(loop.state.p_WB.z, 12.1) << CommandName(command);
  }
}

TEST(Mission, AHexaFliesOnWithoutARotorAndSaysSo) {
  FlightLoop loop(CatalogModel("f550"), {}, {0, 0, 20});
  loop.Run(1);
  loop.health[2] = 0;
  loop.Run(6);
  EXPECT_EQ(loop.pilot.failed_rotors, 4u);
  EXPECT_TRUE(loop.pilot.flags & kRotorFailed);
  EXPECT_GT(ToMatrix(loop.state.q_WB).m[2][2], 0.8);
  EXPECT_LT(Norm(loop.state.p_WB - Vec3d{0, 0, 20}), 3);
}

TEST(Mission, AQuadWithoutARotorComesDownAndSaysWhy) {
  FlightLoop loop(CatalogModel("agilicious"), {}, {0, 0, 50});
  loop.Run(1);
  loop.health[0] = 0;
  loop.Run(1.5);
  EXPECT_EQ(loop.pilot.failed_rotors, 1u);
  EXPECT_NE(DescribeState(loop.pilot).find("rotor failed"), std::string::npos);
  loop.Run(6);
  EXPECT_LT(loop.state.p_WB.z, 40);
  EXPECT_TRUE(std::isfinite(Norm(loop.state.p_WB)) && std::isfinite(Norm(loop.state.w_WB_B)));
}

TEST(Mission, AnEmptyBatteryLandsTheDrone) {
  FlightLoop loop = OnTheGround();
  loop.Give(TakeoffCommand{3, 1});
  RunOnFloor(loop, 6);
  loop.state.charge = 0.04;  // an ideal supply keeps what it is told
  VelocityCommand command;
  command.v = {1, 0, 0};
  loop.Give(command);
  RunOnFloor(loop, 1);
  EXPECT_EQ(loop.pilot.mode, FlightMode::kLand);
  EXPECT_TRUE(loop.pilot.flags & kBatteryEmpty);
  RunOnFloor(loop, 10);
  EXPECT_EQ(loop.pilot.mode, FlightMode::kDisarmed);
}

/// Any command at all, every tenth of them broken.
Command RandomCommand(RngStream& rng) {
  const auto vector = [&](double s) { return Vec3d{rng.Normal(), rng.Normal(), rng.Normal()} * s; };
  const double broken = rng.Chance(0.1) ? std::numeric_limits<double>::quiet_NaN() : 0;
  const YawTarget yaw{static_cast<YawTarget::Mode>(rng.Index(4)), rng.Uniform(-3, 3) + broken};
  const VerticalTarget throttle{VerticalTarget::Mode::kThrottle, rng.Uniform()};
  switch (rng.Index(8)) {
    case 0: {
      RotorSignalCommand c;
      for (double& signal : c.signals) signal = rng.Uniform() + broken;
      return c;
    }
    case 1:
      return RateCommand{vector(3) * (1 + broken), throttle};
    case 2:
      return AttitudeCommand{rng.Uniform(-1, 1) + broken, rng.Uniform(-1, 1), yaw, throttle};
    case 3:
      return VelocityCommand{vector(8), rng.Chance(0.5), yaw, false, broken};
    case 4:
      return PositionCommand{vector(30), rng.Uniform(0, 20) + broken, yaw};
    case 5: {
      std::vector<Vec3d> points(1 + rng.Index(5));
      for (Vec3d& p : points) p = vector(20);
      return PathCommand{std::make_shared<const std::vector<Vec3d>>(points), rng.Uniform(0, 10) + broken, 0, yaw};
    }
    case 6:
      return TrajectoryCommand{std::make_shared<Lemniscate>(vector(10), 5, 1 + rng.Uniform(0, 10))};
    default:
      return HoverCommand{yaw};
  }
}

TEST(Mission, AQuarterOfAnHourOfRandomCommandsLeaveNoNanAndNoEscape) {
  AutopilotOptions options;
  options.fence = Geofence{{-60, -60, -60}, {60, 60, 60}, 1e9};
  for (const char* name : {"agilicious", "f550"}) {
    FlightLoop loop(CatalogModel(name), options);
    RngStream rng(4, name);
    double furthest = 0;
    for (int i = 0; i < 400; ++i) {
      loop.Give(RandomCommand(rng), 3'000'000'000);
      loop.Run(rng.Uniform(0.2, 2));
      ASSERT_TRUE(std::isfinite(Norm(loop.state.p_WB) + Norm(loop.state.w_WB_B))) << i;
      for (int k = 0; k < 3; ++k) furthest = std::max(furthest, std::abs(loop.state.p_WB[k]));
    }
    // Rotor signals throw it over the fence, tumbling at up to 30 m/s: a second to right itself, then some
    // 35 m of braking.
    EXPECT_LT(furthest, 60 + 30 + 35) << name;
    loop.Give(HoverCommand{});
    loop.Run(20);
    EXPECT_LT(Norm(loop.state.v_WB), 0.05) << name;
    EXPECT_GT(ToMatrix(loop.state.q_WB).m[2][2], 0.99) << name;
  }
}

TEST(Autopilot, IsAPureFunctionOfPlainData) {
  // Two copies of the same state, one taken in the middle of a flight, go on bit by bit alike.
  FlightLoop a(CatalogModel("agilicious"), {}, {0, 0, 10});
  a.Give(TrajectoryCommand{std::make_shared<Lemniscate>(Vec3d{0, 0, 10}, 3, 6)});
  a.Run(2);
  FlightLoop b = a;
  a.Run(2);
  b.Run(2);
  EXPECT_EQ(std::memcmp(&a.pilot, &b.pilot, sizeof(a.pilot)), 0);
  EXPECT_EQ(a.state.p_WB, b.state.p_WB);
  EXPECT_EQ(a.state.rotor_speeds, b.state.rotor_speeds);
}

TEST(Autopilot, StateHasNoPadding) {
  // Every byte belongs to a member: a state made in dirty memory equals one made in clean memory.
  alignas(AutopilotState) unsigned char clean[sizeof(AutopilotState)], dirty[sizeof(AutopilotState)];
  std::memset(clean, 0, sizeof(clean));
  std::memset(dirty, 0xaa, sizeof(dirty));
  new (clean) AutopilotState();
  new (dirty) AutopilotState();
  EXPECT_EQ(std::memcmp(clean, dirty, sizeof(clean)), 0);
}

}  // namespace
}  // namespace airsim360
