// How well the controllers track: bars of issue 5, second methods, wind, noise.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/flight/control/flight_check.h"
#include "airsim360/flight/control/simple_flight.h"
#include "airsim360/flight/drones/catalog.h"

namespace airsim360 {
namespace {

double LemniscateRms(const char* name, double amplitude, double speed, ControllerKind kind) {
  AutopilotOptions options;
  options.controller = kind;
  FlightLoop loop(CatalogModel(name), options);
  const auto curve = std::make_shared<Lemniscate>(Vec3d{}, amplitude, speed, 1, 3);
  const TrackingError error = Track(loop, curve, curve->ramp(), curve->duration() - curve->ramp());
  EXPECT_TRUE(error.upright);
  return error.rms;
}

TEST(Tracking, HummingbirdAtFiveMetresASecondStaysWithinAThirdOfRotorPysError) {
  EXPECT_LT(LemniscateRms("hummingbird", 4, 5, ControllerKind::kIndi), 0.064);
}

TEST(Tracking, CrazyflieAtTwoMetresASecondStaysWithinAThirdOfRotorPysError) {
  EXPECT_LT(LemniscateRms("crazyflie_rotorpy", 1, 2, ControllerKind::kIndi), 0.015);
}

TEST(Tracking, FollowsTwoGInLightTurbulence) {
  FlightLoop loop(CatalogModel("agilicious"), {}, {0, 0, 10});
  loop.wind.emplace().wind_6m = 15 * 1852.0 / 3600;  // light turbulence: 15 knots (MIL-F-8785C)
  const auto curve = std::make_shared<Lemniscate>(Vec3d{0, 0, 10}, 8.58, 12.9, 1, 4);
  EXPECT_LT(Track(loop, curve, curve->ramp(), curve->duration() - curve->ramp()).rms, 0.066);
}

TEST(Tracking, TheSimplerCascadesFlyTheSameCurveLessClosely) {
  const double indi = LemniscateRms("hummingbird", 4, 2, ControllerKind::kIndi);
  for (const ControllerKind kind : {ControllerKind::kSe3, ControllerKind::kPx4}) {
    const double rms = LemniscateRms("hummingbird", 4, 2, kind);
    EXPECT_LT(rms, 0.15) << ControllerKindName(kind);
    EXPECT_GT(rms, indi);
  }
}

TEST(Tracking, ASteadyWindLeavesNoErrorWhereItIsMeasuredOrIntegrated) {
  for (const ControllerKind kind : {ControllerKind::kIndi, ControllerKind::kPx4}) {
    AutopilotOptions options;
    options.controller = kind;
    FlightLoop loop(CatalogModel("agilicious"), options, {0, 0, 10});
    loop.surroundings.wind_W = {5, 3, 0};
    loop.Run(kind == ControllerKind::kIndi ? 6 : 15);
    EXPECT_LT(Norm(loop.state.p_WB - loop.pilot.reference_p), 0.01) << ControllerKindName(kind);
    EXPECT_LT(Norm(loop.state.v_WB), 0.01) << ControllerKindName(kind);
  }
}

TEST(Tracking, NoisyEstimatesShakeTheDroneButDoNotTopple) {
  // White at 500 Hz: gyro 0.01 rad/s, velocity 5 mm/s, position 1 cm, attitude 0.1 degrees.
  const DroneModel model = CatalogModel("agilicious");
  AutopilotOptions options;
  options.filter_hz = 15;
  const Autopilot autopilot(model, options);
  const DroneDynamics dynamics(model, 1e-3);
  DroneState state;
  std::fill_n(state.rotor_speeds.begin(), 4, HoverSpeed(model));
  AutopilotState pilot = autopilot.HoverState(EstimateOf(state, 0));
  RngStream rng(7, "noise");
  const auto noise = [&](double s) { return Vec3d{rng.Normal(), rng.Normal(), rng.Normal()} * s; };
  double furthest = 0;
  for (int64_t i = 0; i < 5000; ++i) {
    StateEstimate estimate = EstimateOf(state, i * 2'000'000);
    estimate.p_WB += noise(0.01);
    estimate.v_WB += noise(0.005);
    estimate.w_WB_B += noise(0.01);
    const Vec3d turn = noise(0.0017);
    const Quaternion q = estimate.q_WB;
    estimate.q_WB = ToQuaternion(ToMatrix(q) * RotationX(turn.x) * RotationY(turn.y) * RotationZ(turn.z));
    const RotorValues speeds = autopilot.Step(estimate, {}, pilot);
    for (int k = 0; k < 2; ++k) dynamics.Step({}, speeds, kAllRotorsWork, state);
    furthest = std::max(furthest, Norm(state.p_WB));
  }
  EXPECT_LT(furthest, 0.15);
  EXPECT_GT(ToMatrix(state.q_WB).m[2][2], 0.99);
}

TEST(SimpleFlight, HoversAtAirSimsSignal) {
  AutopilotOptions options;
  options.controller = ControllerKind::kSimpleFlight;
  options.control_dt = 0.003;
  FlightLoop loop(CatalogModel("airsim_quad"), options, {0, 0, 5});
  loop.Give(HoverCommand{});
  loop.Run(10);
  for (int i = 0; i < 4; ++i) {
    const double ratio = loop.state.rotor_speeds[i] / loop.model().rotors[i].max_speed;
    EXPECT_NEAR(ratio * ratio, 0.5866, 1e-4);
  }
  EXPECT_LT(Norm(loop.state.v_WB), 0.01);
}

TEST(SimpleFlight, SaturatesAsItsParametersSay) {
  const DroneModel model = CatalogModel("airsim_quad");
  const SimpleFlightGains gains;
  AutopilotState state;
  StateEstimate level;
  Goal goal;
  goal.level = GoalLevel::kAttitude;
  goal.throttle_given = true;
  goal.throttle = 0.5;
  // Level error of 0.4 rad saturates the level loop: 2.5 rad/s, times 0.25: 0.625 of signal on every motor.
  goal.roll = 0.5;
  const RotorValues roll = SimpleFlightSignals(model, gains, goal, level, 0.003, state);
  // Order FR, RL, FL, RR; AirSim's mix: roll lifts the left side; undershoot shifts all up, then scales.
  EXPECT_NEAR(roll[1], 1, 1e-12);
  EXPECT_NEAR(roll[2], 1, 1e-12);
  EXPECT_NEAR(roll[0], 0, 1e-12);
  EXPECT_NEAR(roll[3], 0, 1e-12);
  goal.roll = 0.1;
  // 0.1 rad * 2.5 = 0.25 of 2.5 rad/s = 0.625 rad/s; times 0.25 = 0.15625.
  const RotorValues little = SimpleFlightSignals(model, gains, goal, level, 0.003, state);
  EXPECT_NEAR(little[0], 0.5 - 0.15625, 1e-12);
  EXPECT_NEAR(little[1], 0.5 + 0.15625, 1e-12);
  // Below 5 % of throttle nothing but throttle reaches the motors.
  goal.throttle = 0.04;
  EXPECT_EQ(SimpleFlightSignals(model, gains, goal, level, 0.003, state)[1], 0.04);
  // A position 1 m away asks for 1.5 m/s, that for 0.3 of pi / 5.5 of lean, that for 2.5 times 2.5 rad/s of
  // it.
  const auto pitch_signal = [&](double away) {
    Goal position;
    position.level = GoalLevel::kPosition;
    position.p_W = {away, 0, 0};
    position.speed = position.climb = 100;
    AutopilotState fresh;
    const RotorValues s = SimpleFlightSignals(model, gains, position, level, 0.003, fresh);
    return (s[1] - s[0]) / 2;
  };
  EXPECT_NEAR(pitch_signal(1), 0.25 * 2.5 * 2.5 * 0.3 * std::numbers::pi / 5.5, 1e-9);
  // From 4 m on (6 m/s) it asks for no more.
  EXPECT_EQ(pitch_signal(4), pitch_signal(8));
}

TEST(SimpleFlight, MixesAsAirSimDoes) {
  // FR (1, -1, 1, 1), RL (1, 1, -1, 1), FL (1, 1, 1, -1), RR (1, -1, -1, -1) for throttle, roll, pitch, yaw;
  // positive pitch is nose up and positive yaw clockwise from above.
  const DroneModel model = CatalogModel("airsim_quad");
  const SimpleFlightGains gains;
  AutopilotState state;
  Goal goal;
  goal.level = GoalLevel::kRates;
  goal.throttle_given = true;
  goal.throttle = 0.5;
  const double expected[3][4] = {{-1, 1, 1, -1}, {1, -1, 1, -1}, {1, 1, -1, -1}};
  for (int axis = 0; axis < 3; ++axis) {
    goal.w_B = {};
    goal.w_B[axis] = axis == 0 ? 0.4 : -0.4;  // forward-right-down against forward-left-up
    const RotorValues s = SimpleFlightSignals(model, gains, goal, {}, 0.003, state);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(s[i] - 0.5, 0.1 * expected[axis][i], 1e-12) << axis << i;
  }
}

TEST(Gains, ADroneThatCannotFlyIsRefusedWithTheReason) {
  DroneModel model = CatalogModel("agilicious");
  model.mass = 10;
  EXPECT_THROW(Autopilot{model}, InputError);
  model = CatalogModel("agilicious");
  for (RotorModel& rotor : model.rotors) rotor.p_B = {0.1, 0, 0};
  try {
    Autopilot{model};
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("roll, pitch and thrust"), std::string::npos);
  }
  AutopilotOptions options;
  options.control_dt = 1;
  EXPECT_THROW(Autopilot(CatalogModel("agilicious"), options), InputError);
  EXPECT_THROW(ParseControllerKind("indy"), InputError);
}

}  // namespace
}  // namespace airsim360
