#include "airsim360/rpc/session/flight_task.h"

#include <gtest/gtest.h>

#include <cmath>

namespace airsim360 {
namespace {

constexpr airsim::YawMode kYaw{true, 0};

// A drone that has the commanded velocity after a lag of 0.2 s.
struct ToyDrone {
  FlightView view;

  void Follow(const Command& command) {
    Vec3d v_N{};
    if (const auto* velocity = std::get_if<VelocityCommand>(&command)) v_N = NedFromWorld(velocity->v);
    view.v_N += (v_N - view.v_N) * (kTaskPeriod / 0.2);
    view.p_N += view.v_N * kTaskPeriod;
  }
};

// Runs a task to its end; nullopt after `seconds`.
std::optional<bool> Fly(FlightTask& task, ToyDrone& drone, double seconds, double* fastest = nullptr) {
  for (double t = 0; t < seconds; t += kTaskPeriod) {
    const TaskTurn turn = task.Turn(drone.view);
    if (turn.result) return turn.result;
    if (turn.command) drone.Follow(*turn.command);
    if (fastest) *fastest = std::max(*fastest, Norm(drone.view.v_N));
  }
  return std::nullopt;
}

TEST(FlightTask, PathsEndNearTheirLastPoint) {
  for (const double velocity : {0.5, 2.0, 5.0}) {
    ToyDrone drone;
    const auto task =
        MakePathTask(drone.view, {{10, 0, -5}, {10, 10, -5}, {0, 10, -5}}, 1e9, {.velocity = velocity, .drivetrain = {}, .yaw = kYaw});
    double fastest = 0;
    EXPECT_EQ(Fly(*task, drone, 400, &fastest), true) << velocity;
    EXPECT_LT(Norm(drone.view.p_N - Vec3d{0, 10, -5}), 0.6 + 0.3 * velocity);
    EXPECT_LT(fastest, velocity * 1.01);
  }
}

TEST(FlightTask, ShortWaysAreFlownThoughTheLookaheadIsLonger) {
  ToyDrone drone;
  const auto task = MakePathTask(drone.view, {{2, 0, 0}}, 1e9, {.velocity = 5, .drivetrain = {}, .yaw = kYaw});
  EXPECT_EQ(Fly(*task, drone, 60), true);
  EXPECT_GT(drone.view.p_N.x, 1.4);
}

TEST(FlightTask, NowhereToGoEndsAtOnce) {
  ToyDrone drone;
  drone.view.p_N = {1, 2, 3};
  const auto task = MakePathTask(drone.view, {{1, 2, 3}}, 1e9, {.velocity = 5, .drivetrain = {}, .yaw = kYaw});
  EXPECT_EQ(task->Turn(drone.view).result, true);
}

TEST(FlightTask, CreepingWithinTheAccuracyOfTheEndIsTheEnd) {
  FlightView view;
  view.p_N = {0, 0, -2};
  const auto task = MakePathTask(view, {{0, 0, 0}}, 1e9, {.velocity = 0.5, .drivetrain = {}, .yaw = kYaw});
  task->Turn(view);
  view.p_N.z = -0.48;
  EXPECT_FALSE(task->Turn(view).result);
  for (int i = 0; i < 3; ++i) {
    view.p_N.z += 1e-4;
    if (task->Turn(view).result) return;
  }
  FAIL() << "it goes on";
}

TEST(FlightTask, SlowingDownOvershootsLess) {
  const auto overshoot = [](bool slow_down) {
    ToyDrone drone;
    const auto task = MakePathTask(drone.view, {{30, 0, 0}}, 1e9, {.velocity = 8, .drivetrain = {}, .yaw = kYaw, .slow_down = slow_down});
    Fly(*task, drone, 100);
    // Afterwards it is told to stop.
    for (int i = 0; i < 200; ++i) drone.Follow(NedVelocity({}, kYaw));
    return drone.view.p_N.x - 30;
  };
  EXPECT_LT(std::abs(overshoot(true)), 0.8);
  EXPECT_GT(overshoot(false), overshoot(true));
}

TEST(FlightTask, LookaheadsThatMakeNoSenseAreRefused) {
  const FlightView view;
  const auto refused = [&](PathOptions options) { EXPECT_THROW(MakePathTask(view, {{1, 0, 0}}, 1, options), std::invalid_argument); };
  refused({.velocity = 1, .drivetrain = {}, .yaw = kYaw, .lookahead = 0});
  refused({.velocity = 1, .drivetrain = {}, .yaw = kYaw, .lookahead = 0.4});
  refused({.velocity = 100, .drivetrain = {}, .yaw = kYaw, .lookahead = 1});
  refused({.velocity = 1, .drivetrain = airsim::DrivetrainType::kForwardOnly, .yaw = kYaw});
}

TEST(FlightTask, LandingEndsWhenTheGroundHasStoppedTheDrone) {
  ToyDrone drone;
  drone.view.v_N.z = 0.2;
  const auto task = MakeLandTask(60);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(task->Turn(drone.view).result);
  // In the air it may well rise for a moment: a descent has been caught.
  drone.view.v_N.z = -0.1;
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(task->Turn(drone.view).result);
  drone.view.touches = true;
  drone.view.v_N.z = 0.2;
  EXPECT_FALSE(task->Turn(drone.view).result);
  drone.view.v_N.z = 0;
  EXPECT_EQ(Fly(*task, drone, 0.1), std::nullopt);
  drone.view.v_N.z = 0;
  int turns = 0;
  while (!task->Turn(drone.view).result) ++turns;
  EXPECT_LE(turns, 11);
}

TEST(FlightTask, TurningMeasuresTheErrorAsAirSimOrRoundTheCircle) {
  FlightView view;
  view.yaw_deg = -178;
  const auto stock = MakeRotateTask(view, 179, 5, 10, false), ours = MakeRotateTask(view, 179, 5, 10, true);
  EXPECT_FALSE(stock->Turn(view).result);
  EXPECT_EQ(ours->Turn(view).result, true);
}

TEST(FlightTask, ForwardOnlyTurnsAlongTheWay) {
  const airsim::YawMode yaw = AdjustYaw({0, 2, 0}, airsim::DrivetrainType::kForwardOnly, {false, 10});
  EXPECT_NEAR(yaw.yaw_or_rate, 100, 1e-4);
  EXPECT_TRUE(AdjustYaw({0.1, 0, 0}, airsim::DrivetrainType::kForwardOnly, {false, 10}).is_rate);
  EXPECT_NEAR(AdjustYaw({0, 2, 0}, airsim::DrivetrainType::kMaxDegreeOfFreedom, {false, 10}).yaw_or_rate, 10, 0);
}

TEST(NedCommands, SignsAreOurs) {
  const auto attitude = std::get<AttitudeCommand>(FrdAttitude(0.1, 0.2, 0.5, true, {false, -3}, {1, 2, 10}));
  EXPECT_EQ(attitude.roll, 0.1);
  EXPECT_EQ(attitude.pitch, 0.2);
  EXPECT_EQ(attitude.yaw.value, -0.5);
  EXPECT_EQ(attitude.vertical.value, 13);
  const auto rates = std::get<RateCommand>(FrdRates({1, 2, 3}, {true, 0.5}, {}));
  EXPECT_EQ(rates.w_B, (Vec3d{1, -2, -3}));
  const auto velocity = std::get<VelocityCommand>(NedVelocity({1, 2, 3}, {false, 90}));
  EXPECT_EQ(velocity.v, (Vec3d{2, 1, -3}));
  EXPECT_NEAR(velocity.yaw.value, 0, 1e-12);
}

}  // namespace
}  // namespace airsim360
