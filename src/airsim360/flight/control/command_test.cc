// Every level of command does what it says; what cannot be flown is refused by name and the drone holds.
#include "airsim360/flight/control/command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "airsim360/flight/control/attitude.h"
#include "airsim360/flight/control/flight_check.h"
#include "airsim360/flight/drones/catalog.h"

namespace airsim360 {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

FlightLoop Hovering(const char* name = "agilicious", ControllerKind kind = ControllerKind::kIndi, Vec3d at = {0, 0, 10}) {
  AutopilotOptions options;
  options.controller = kind;
  return FlightLoop(CatalogModel(name), options, at);
}

double Heading(const FlightLoop& loop) { return internal::HeadingOf(ToMatrix(loop.state.q_WB)); }

TEST(Command, HoverStaysAtRest) {
  FlightLoop loop = Hovering();
  loop.Give(HoverCommand{});
  loop.Run(3);
  EXPECT_LT(Norm(loop.state.p_WB - Vec3d{0, 0, 10}), 1e-3);
  EXPECT_LT(Norm(loop.state.v_WB), 1e-3);
  EXPECT_EQ(loop.pilot.mode, FlightMode::kHold);
}

TEST(Command, VelocityIsReachedAndKeptByEveryController) {
  for (const ControllerKind kind : {ControllerKind::kIndi, ControllerKind::kSe3, ControllerKind::kPx4}) {
    FlightLoop loop = Hovering("agilicious", kind);
    VelocityCommand command;
    command.v = {3, -2, 1};
    loop.Give(command);
    loop.Run(4);
    EXPECT_LT(Norm(loop.state.v_WB - command.v), 0.1) << ControllerKindName(kind);
    loop.Run(2);
    EXPECT_LT(Norm(loop.state.v_WB - command.v), 0.1) << ControllerKindName(kind);
  }
}

TEST(Command, BodyVelocityFollowsTheHeading) {
  FlightLoop loop = Hovering();
  HoverCommand turn;
  turn.yaw = {YawTarget::Mode::kAngle, 1.2};
  loop.Give(turn);
  loop.Run(4);
  EXPECT_NEAR(Heading(loop), 1.2, 0.01);
  VelocityCommand command;
  command.v = {2, 0, 0};
  command.body_heading = true;
  loop.Give(command);
  loop.Run(4);
  EXPECT_NEAR(loop.state.v_WB.x, 2 * std::cos(1.2), 0.05);
  EXPECT_NEAR(loop.state.v_WB.y, 2 * std::sin(1.2), 0.05);
}

TEST(Command, YawRateTurnsAtThatRate) {
  FlightLoop loop = Hovering();
  HoverCommand turn;
  turn.yaw = {YawTarget::Mode::kRate, 0.8};
  loop.Give(turn);
  loop.Run(3);
  EXPECT_NEAR(loop.state.w_WB_B.z, 0.8, 0.01);
  EXPECT_LT(Norm(loop.state.v_WB), 0.02);
}

TEST(Command, PositionIsReachedWithoutOvershootWithinItsSpeed) {
  FlightLoop loop = Hovering();
  PositionCommand command;
  command.p_W = {8, -3, 12};
  command.speed = 2.5;
  loop.Give(command);
  double fastest = 0, furthest = 0;
  for (int i = 0; i < 5000; ++i) {
    loop.Step();
    fastest = std::max(fastest, std::hypot(loop.state.v_WB.x, loop.state.v_WB.y));
    furthest = std::max(furthest, loop.state.p_WB.x);
  }
  EXPECT_LT(Norm(loop.state.p_WB - command.p_W), 0.01);
  EXPECT_LT(fastest, 2.6);
  EXPECT_GT(fastest, 2.2);
  EXPECT_LT(furthest, 8.05);
  EXPECT_TRUE(loop.pilot.flags & kCommandDone);
}

TEST(Command, AttitudeIsHeldAndAltitudeKept) {
  FlightLoop loop = Hovering();
  AttitudeCommand command;
  command.roll = 0.2;
  command.pitch = -0.15;
  command.vertical = {VerticalTarget::Mode::kAltitude, 12};
  loop.Give(command);
  loop.Run(4);
  const internal::RollPitch now = internal::RollPitchOf(ToMatrix(loop.state.q_WB));
  EXPECT_NEAR(now.roll, 0.2, 0.01);
  EXPECT_NEAR(now.pitch, -0.15, 0.01);
  EXPECT_NEAR(loop.state.p_WB.z, 12, 0.1);
  // Right side down flies to the right, nose down forward.
  EXPECT_LT(loop.state.v_WB.y, -1);
  EXPECT_GT(loop.state.v_WB.x, 1);
}

TEST(Command, RatesAndThrottleAreHeld) {
  FlightLoop loop = Hovering();
  RateCommand command;
  command.w_B = {0.5, -0.3, 0.4};
  const double hover = loop.model().mass * kGravity / MaxThrust(loop.model());
  command.vertical = {VerticalTarget::Mode::kThrottle, hover};
  loop.Give(command);
  loop.Run(0.8);
  EXPECT_LT(Norm(loop.state.w_WB_B - command.w_B), 0.05);
  double thrust = 0;
  for (size_t i = 0; i < 4; ++i) thrust += ThrustAtSpeed(loop.model().rotors[i], loop.state.rotor_speeds[i]);
  EXPECT_NEAR(thrust, loop.model().mass * kGravity, 0.05);
}

TEST(Command, RotorSpeedsAndSignalsReachTheRotors) {
  FlightLoop loop = Hovering();
  RotorSpeedCommand speeds;
  speeds.speeds = {1100, 1120, 1080, 1090};
  loop.Give(speeds);
  loop.Run(0.5);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(loop.state.rotor_speeds[i], speeds.speeds[i], 1e-3);
  RotorSignalCommand signals;
  signals.signals = {0.25, 0.25, 0.25, 0.25};
  loop.Give(signals);
  loop.Run(0.5);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(loop.state.rotor_speeds[i], 0.5 * loop.model().rotors[i].max_speed, 1e-2);
  }
}

TEST(Command, APathPassesItsWaypointsAndEnds) {
  FlightLoop loop = Hovering("f450");
  PathCommand path;
  const std::vector<Vec3d> points = {{10, 0, 10}, {10, 10, 12}, {0, 10, 10}};
  path.waypoints = std::make_shared<const std::vector<Vec3d>>(points);
  path.speed = 3;
  path.yaw.mode = YawTarget::Mode::kForward;
  loop.Give(path);
  std::vector<double> nearest(points.size(), 1e9);
  for (int i = 0; i < 12000 && !(loop.pilot.flags & kCommandDone); ++i) {
    loop.Step();
    for (size_t k = 0; k < points.size(); ++k) {
      nearest[k] = std::min(nearest[k], Norm(loop.state.p_WB - points[k]));
    }
  }
  EXPECT_TRUE(loop.pilot.flags & kCommandDone);
  // Corners are cut by less than the lookahead, 0.6 s of flight.
  EXPECT_LT(nearest[0], 1.8);
  EXPECT_LT(nearest[1], 1.8);
  EXPECT_LT(nearest[2], 0.2);
  // It looked where it flew: last along -X.
  EXPECT_GT(std::abs(Heading(loop)), 2.5);
}

TEST(Command, WhatIsNoNumberOrAbsurdIsRefusedByNameAndTheDroneHolds) {
  const DroneModel model = CatalogModel("agilicious");
  VelocityCommand velocity;
  velocity.v = {0, kNan, 0};
  EXPECT_EQ(CommandProblem(velocity, model), "velocity.v.y: nan is not a finite number");
  PositionCommand position;
  position.p_W = {0, 0, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(CommandProblem(position, model), "position.p.z: inf is not a finite number");
  AttitudeCommand attitude;
  attitude.vertical.value = 1.5;
  EXPECT_EQ(CommandProblem(attitude, model), "attitude.throttle: 1.5 is not in 0 ... 1");
  PathCommand path;
  EXPECT_EQ(CommandProblem(path, model), "path.waypoints: there are none");
  path.waypoints = std::make_shared<const std::vector<Vec3d>>(std::vector<Vec3d>{{1, 2, 3}, {kNan, 0, 0}});
  EXPECT_EQ(CommandProblem(path, model), "path.waypoints[1].x: nan is not a finite number");
  EXPECT_EQ(CommandProblem(TrajectoryCommand{}, model), "trajectory.trajectory: there is none");
  RateCommand rates;
  rates.w_B.x = 1e9;
  EXPECT_NE(CommandProblem(rates, model).find("rates.w.x: 1e+09 is not in -100 ... 100"), std::string::npos);

  for (const Command& bad : {Command(velocity), Command(position), Command(attitude), Command(rates)}) {
    FlightLoop loop = Hovering();
    loop.Give(bad);
    loop.Run(1);
    EXPECT_TRUE(loop.pilot.flags & kCommandRefused);
    EXPECT_EQ(loop.pilot.mode, FlightMode::kHold);
    EXPECT_LT(Norm(loop.state.p_WB - Vec3d{0, 0, 10}), 1e-3);
    EXPECT_EQ(DescribeState(loop.pilot), "hold (command refused)");
  }
}

TEST(Command, ALostStreamOfCommandsEndsInHover) {
  FlightLoop loop = Hovering();
  VelocityCommand command;
  command.v = {4, 0, 0};
  loop.Give(command, 500'000'000);
  loop.Run(0.4);
  EXPECT_FALSE(loop.pilot.flags & kCommandLost);
  loop.Run(4);
  EXPECT_TRUE(loop.pilot.flags & kCommandLost);
  EXPECT_LT(Norm(loop.state.v_WB), 0.02);
  // The next command is flown.
  loop.Give(command, 10'000'000'000);
  loop.Run(3);
  EXPECT_NEAR(loop.state.v_WB.x, 4, 0.1);
}

}  // namespace
}  // namespace airsim360
