#include "airsim360/flight/dynamics/dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/flight/dynamics/drone_step.h"
#include "airsim360/flight/dynamics/state_lanes.h"
#include "airsim360/flight/test_drones.h"

namespace airsim360 {
namespace {

const DroneSurroundings kCalm;

RotorSpeeds AllAt(double speed) {
  RotorSpeeds out;
  out.fill(speed);
  return out;
}

DroneState Hovering(const DroneModel& model) {
  DroneState s;
  s.rotor_speeds = AllAt(HoverSpeed(model));
  return s;
}

/// Something is going on in every component.
DroneState Tumbling(double speed) {
  DroneState s;
  s.p_WB = {1, -2, 3};
  s.q_WB = {0.8, 0.2, -0.4, 0.4};
  s.v_WB = {4, -3, 2};
  s.w_WB_B = {1.5, -2.5, 3.5};
  for (int i = 0; i < kMaxRotors; ++i) s.rotor_speeds[i] = speed * (1 + 0.07 * i);
  return s;
}

void Fly(const DroneDynamics& drone, const RotorSpeeds& commands, int steps, DroneState& s, const DroneSurroundings& around = kCalm,
         const RotorHealth& health = kAllRotorsWork) {
  for (int i = 0; i < steps; ++i) drone.Step(around, commands, health, s);
}

double Distance(const DroneState& a, const DroneState& b) {
  const double q = std::hypot(a.q_WB.w - b.q_WB.w, a.q_WB.x - b.q_WB.x, std::hypot(a.q_WB.y - b.q_WB.y, a.q_WB.z - b.q_WB.z));
  return Norm(a.p_WB - b.p_WB) + Norm(a.v_WB - b.v_WB) + Norm(a.w_WB_B - b.w_WB_B) + q;
}

TEST(Dynamics, HoverThrustCarriesTheWeight) {
  for (const DroneModel& model : {AgiliciousDrone(), AirSimDrone(), DroneWithEveryTerm()}) {
    const DroneDynamics drone(model);
    const DroneState start = Hovering(model);
    const DroneDerivative rate = drone.Derivative(kCalm, start.rotor_speeds, kAllRotorsWork, start);
    EXPECT_LT(Norm(rate.a_WB), 1e-14 * kGravity) << model.name;
    EXPECT_NEAR(rate.specific_force_B.z, kGravity, 1e-13);
    DroneState s = start;
    Fly(drone, start.rotor_speeds, 10000, s);
    EXPECT_LT(Distance(s, start), 1e-12) << model.name;
  }
}

TEST(Dynamics, AirSimsDroneHoversAtItsKnownSignalAndFallsAtItsKnownSpeed) {
  const DroneModel model = AirSimDrone();
  const double signal = std::pow(HoverSpeed(model) / model.rotors[0].max_speed, 2);
  EXPECT_NEAR(signal, 0.5866, 5e-5);
  DroneState s;
  Fly(DroneDynamics(model, 1e-3), AllAt(0), 20000, s);
  EXPECT_NEAR(s.v_WB.z, -8.53, 0.005);
}

TEST(Dynamics, FreeFallIsAParabola) {
  DroneModel model = AgiliciousDrone();
  model.quadratic_drag_B = {};
  DroneState s;
  s.v_WB = {2, 0, 1};
  Fly(DroneDynamics(model), AllAt(0), 1500, s);
  EXPECT_NEAR(s.p_WB.x, 2 * 1.5, 1e-11);
  EXPECT_NEAR(s.p_WB.z, 1.5 - 0.5 * kGravity * 1.5 * 1.5, 1e-11);
}

TEST(Dynamics, FallWithQuadraticDragIsTheHyperbolicTangent) {
  const DroneModel model = AgiliciousDrone();
  const double terminal = std::sqrt(model.mass * kGravity / model.quadratic_drag_B.z);
  DroneState s;
  Fly(DroneDynamics(model), AllAt(0), 3000, s);
  EXPECT_NEAR(s.v_WB.z, -terminal * std::tanh(kGravity * 3 / terminal), 1e-9);
}

TEST(Dynamics, SteadyWindCarriesTheDroneAlongWithIt) {
  const DroneModel model = AgiliciousDrone();
  DroneSurroundings windy;
  windy.wind_W = {5, -2, 0};
  DroneState s = Hovering(model);
  Fly(DroneDynamics(model, 5e-3), s.rotor_speeds, 40000, s, windy);
  EXPECT_NEAR(s.v_WB.x, 5, 1e-2);
  EXPECT_NEAR(s.v_WB.y, -2, 1e-2);
}

TEST(Dynamics, RotorsFollowTheirExponentialWhateverTheStep) {
  const DroneModel model = DroneWithEveryTerm();
  for (const double dt : {1e-4, 1e-3, 2e-2}) {
    DroneState s;
    Fly(DroneDynamics(model, dt), AllAt(1000), static_cast<int>(std::lround(0.1 / dt)), s);
    const double up = 1000 * (1 - std::exp(-0.1 / model.rotors[0].tau_up));
    EXPECT_NEAR(s.rotor_speeds[2], up, 1e-9);
    Fly(DroneDynamics(model, dt), AllAt(200), static_cast<int>(std::lround(0.1 / dt)), s);
    const double down = 200 + (up - 200) * std::exp(-0.1 / model.rotors[0].tau_down);
    EXPECT_NEAR(s.rotor_speeds[2], down, 1e-9);
  }
}

TEST(Dynamics, ErrorFallsWithTheFourthPowerOfTheStep) {
  for (const DroneModel& model : {AgiliciousDrone(), DroneWithEveryTerm()}) {
    const RotorSpeeds commands = {1200, 900, 1500, 1100};
    const auto end = [&](int steps) {
      DroneState s = Tumbling(1000);
      Fly(DroneDynamics(model, 0.32 / steps), commands, steps, s);
      return s;
    };
    const DroneState truth = end(4096);
    const double coarse = Distance(end(32), truth), middle = Distance(end(64), truth), fine = Distance(end(128), truth);
    EXPECT_NEAR(coarse / middle, 16, 3) << model.name;
    EXPECT_NEAR(middle / fine, 16, 1.5) << model.name;
  }
}

TEST(Dynamics, TorqueFreeSpinKeepsEnergyAndAngularMomentum) {
  DroneModel model = DroneWithEveryTerm();
  DroneSurroundings vacuum;
  vacuum.air_density = 0;
  DroneState s;
  s.w_WB_B = {5, 0.3, 2};
  const auto energy = [&] { return 0.5 * Dot(s.w_WB_B, model.inertia_B * s.w_WB_B); };
  const auto momentum = [&] { return ToMatrix(s.q_WB) * (model.inertia_B * s.w_WB_B); };
  const double e0 = energy();
  const Vec3d l0 = momentum();
  Fly(DroneDynamics(model), AllAt(0), 10000, s, vacuum);
  EXPECT_LT(std::abs(energy() / e0 - 1) / 10, 1e-9);
  EXPECT_LT(Norm(momentum() - l0) / Norm(l0) / 10, 1e-9);
  EXPECT_NEAR(s.q_WB.w * s.q_WB.w + s.q_WB.x * s.q_WB.x + s.q_WB.y * s.q_WB.y + s.q_WB.z * s.q_WB.z, 1, 1e-14);
}

// The motors' torques are internal: body and rotors trade momentum.
TEST(Dynamics, SpinningUpInVacuumKeepsTheMomentumOfBodyAndRotorsTogether) {
  const DroneModel model = DroneWithEveryTerm();
  DroneSurroundings vacuum;
  vacuum.air_density = 0;
  DroneState s = Tumbling(500);
  const auto momentum = [&] {
    Vec3d l_B = model.inertia_B * s.w_WB_B;
    for (size_t i = 0; i < model.rotors.size(); ++i) {
      const RotorModel& r = model.rotors[i];
      l_B -= r.axis_B * (r.direction * r.inertia * s.rotor_speeds[i]);
    }
    return ToMatrix(s.q_WB) * l_B;
  };
  const Vec3d l0 = momentum();
  Fly(DroneDynamics(model), {2000, 100, 1500, 0}, 1000, s, vacuum);
  EXPECT_LT(Norm(momentum() - l0) / Norm(l0), 1e-7);
}

TEST(Dynamics, YawFollowsTheReactionTorque) {
  const DroneModel model = AgiliciousDrone();
  const DroneDynamics drone(model);
  // Rotors 2 and 3 have direction +1: faster, they turn the body counter-clockwise.
  const double hover = HoverSpeed(model);
  DroneState s;
  s.rotor_speeds = {0.9 * hover, 0.9 * hover, 1.1 * hover, 1.1 * hover};
  const DroneDerivative rate = drone.Derivative(kCalm, s.rotor_speeds, kAllRotorsWork, s);
  const double k_m = model.rotors[0].torque_ratio * model.rotors[0].thrust_factor;
  const double torque = k_m * hover * hover * 2 * (1.21 - 0.81);
  EXPECT_NEAR(rate.angular_acceleration_B.z, torque / model.inertia_B.m[2][2], 1e-9);
  EXPECT_NEAR(rate.angular_acceleration_B.x, 0, 1e-9);
  EXPECT_NEAR(rate.angular_acceleration_B.y, 0, 1e-9);
}

/// Mirrored in the x-z plane: what is left becomes right.
DroneModel Mirrored(DroneModel m) {
  for (RotorModel& r : m.rotors) {
    r.p_B.y = -r.p_B.y;
    r.axis_B.y = -r.axis_B.y;
    r.direction = -r.direction;
  }
  for (int i : {0, 2}) m.inertia_B.m[i][1] = -m.inertia_B.m[i][1], m.inertia_B.m[1][i] = -m.inertia_B.m[1][i];
  return m;
}

DroneState Mirrored(DroneState s) {
  s.p_WB.y = -s.p_WB.y;
  s.v_WB.y = -s.v_WB.y;
  s.q_WB.x = -s.q_WB.x;
  s.q_WB.z = -s.q_WB.z;
  s.w_WB_B.x = -s.w_WB_B.x;
  s.w_WB_B.z = -s.w_WB_B.z;
  return s;
}

DroneModel TiltedHexa() {
  DroneModel m = DroneWithEveryTerm();
  m.name = "tilted hexa";
  m.rotors.push_back(m.rotors[0]);
  m.rotors.push_back(m.rotors[3]);
  for (int i = 0; i < 6; ++i) {
    RotorModel& r = m.rotors[i];
    const double a = i * 1.0471975511965976;
    r.p_B = {0.2 * std::cos(a), 0.2 * std::sin(a), 0.01 * i};
    r.axis_B = Normalized(Vec3d{0.3 * std::sin(a) * (i % 2 ? 1 : -1), -0.3 * std::cos(a) * (i % 2 ? 1 : -1), 1});
    r.direction = i % 2 ? 1 : -1;
  }
  return m;
}

TEST(Dynamics, AMirroredDroneFliesTheMirroredWay) {
  for (const DroneModel& model : {DroneWithEveryTerm(), TiltedHexa()}) {
    DroneState s = Tumbling(900), t = Mirrored(s);
    const RotorSpeeds commands = {1200, 900, 1500, 1100, 1000, 800};
    Fly(DroneDynamics(model), commands, 500, s);
    Fly(DroneDynamics(Mirrored(model)), commands, 500, t);
    EXPECT_LT(Distance(Mirrored(s), t), 1e-11) << model.name;
  }
}

// Two derivations of the rotors' wrench: sums over an upright layout, and rotor by rotor.
TEST(Dynamics, SumsOverUprightRotorsEqualTheRotorsOneByOne) {
  const DroneModel model = DroneWithEveryTerm();
  auto c = internal::MakeDroneConstants<double>(model, 1e-3);
  ASSERT_TRUE(c.upright);
  DroneSurroundings around;
  around.wind_W = {1, 2, -0.5};
  around.wind_rate_B = {0.2, -0.1, 0.3};
  around.air_density = 1.0;
  around.ground_distance = 0.1;
  around.force_W = {0.3, -0.2, 0.1};
  around.torque_B = {0.01, 0.02, -0.03};
  const auto end = [&]<class Drive>() {
    internal::BodyState<double> s{};
    internal::LoadState(Tumbling(1000), 4, s);
    const double commands[] = {1200, 900, 1500, 1100};
    internal::StepLanes<Drive>(c, internal::LoadSurroundings(around), true, commands, 300, s);
    DroneState out;
    internal::StoreState(s, 4, out);
    return out;
  };
  const DroneState sums = end.operator()<internal::UprightDrive<double>>();
  c.upright = false;
  const DroneState singly = end.operator()<internal::TiltedDrive<double>>();
  EXPECT_GT(Distance(sums, Tumbling(1000)), 1);
  EXPECT_LT(Distance(sums, singly), 1e-10);
}

TEST(Dynamics, ThePoseOfTheWholeExperimentDoesNotMatter) {
  // Turned about the vertical and moved, everything turns and moves along (Galilean invariance in yaw).
  const DroneDynamics drone(DroneWithEveryTerm());
  DroneState s = Tumbling(1000), t = s;
  const Quaternion turn{std::cos(0.6), 0, 0, std::sin(0.6)};
  const Mat3d R = ToMatrix(turn);
  const Quaternion q = s.q_WB;
  t.q_WB = {turn.w * q.w - turn.z * q.z, turn.w * q.x - turn.z * q.y, turn.w * q.y + turn.z * q.x, turn.w * q.z + turn.z * q.w};
  t.p_WB = R * s.p_WB;
  t.v_WB = R * s.v_WB;
  Fly(drone, AllAt(1200), 500, s);
  Fly(drone, AllAt(1200), 500, t);
  EXPECT_LT(Norm(R * s.p_WB - t.p_WB) + Norm(R * s.v_WB - t.v_WB) + Norm(s.w_WB_B - t.w_WB_B), 1e-9);
}

TEST(Dynamics, TheGroundAddsThrustByCheesemanAndBennettAndNeverWithoutBound) {
  const DroneModel model = AgiliciousDrone();
  const DroneDynamics drone(model);
  const DroneState s = Hovering(model);
  const double radius = model.rotors[0].diameter / 2;
  const auto gain = [&](double z) {
    DroneSurroundings around;
    around.ground_distance = z;
    return drone.Derivative(around, s.rotor_speeds, kAllRotorsWork, s).specific_force_B.z / kGravity;
  };
  EXPECT_NEAR(gain(radius), 1 / (1 - 1.0 / 16), 1e-9);
  EXPECT_NEAR(gain(2 * radius), 1 / (1 - 1.0 / 64), 1e-9);
  EXPECT_NEAR(gain(0.5 * radius), 4.0 / 3, 1e-9);
  EXPECT_NEAR(gain(0), 4.0 / 3, 1e-9);
  EXPECT_NEAR(gain(100 * radius), 1, 1e-12);
}

TEST(Dynamics, ThinAirThrustsInProportion) {
  const DroneModel model = DroneWithEveryTerm();
  DroneSurroundings thin;
  thin.air_density = 0.5 * kSeaLevelAirDensity;
  const DroneState s = Tumbling(900);
  const DroneDynamics drone(model);
  const Vec3d dense = drone.Derivative(kCalm, s.rotor_speeds, kAllRotorsWork, s).specific_force_B;
  const Vec3d half = drone.Derivative(thin, s.rotor_speeds, kAllRotorsWork, s).specific_force_B;
  EXPECT_LT(Norm(dense * 0.5 - half), 1e-12);
}

TEST(Dynamics, AFailedRotorRunsDownAndTheOthersDoNot) {
  const DroneModel model = AgiliciousDrone();
  DroneState s = Hovering(model);
  RotorHealth health = kAllRotorsWork;
  health[1] = 0;
  Fly(DroneDynamics(model), s.rotor_speeds, 100, s, kCalm, health);
  EXPECT_NEAR(s.rotor_speeds[1], HoverSpeed(model) * std::exp(-0.1 / model.rotors[1].tau_down), 1e-9);
  EXPECT_EQ(s.rotor_speeds[0], HoverSpeed(model));
  EXPECT_GT(s.w_WB_B.x, -1e3);
  EXPECT_LT(s.w_WB_B.x, 0);  // rotor 1 is on the left (+Y): its side drops
}

TEST(Dynamics, AbsurdCommandsAreLimited) {
  const DroneModel model = AgiliciousDrone();
  DroneState s;
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  Fly(DroneDynamics(model), {nan, inf, -inf, 1e300}, 1000, s);
  EXPECT_EQ(s.rotor_speeds[0], 0);
  EXPECT_NEAR(s.rotor_speeds[1], model.rotors[1].max_speed, 1e-6);
  EXPECT_EQ(s.rotor_speeds[2], 0);
  EXPECT_NEAR(s.rotor_speeds[3], model.rotors[3].max_speed, 1e-6);
  EXPECT_TRUE(std::isfinite(Norm(s.p_WB)));
}

TEST(Dynamics, ModelsThatCannotFlyAreRefusedByName) {
  const auto refused = [](auto change) {
    DroneModel model = AgiliciousDrone();
    change(model);
    try {
      DroneDynamics drone(model);
    } catch (const InputError& e) {
      return std::string(e.what()).find("agilicious") != std::string::npos;
    }
    return false;
  };
  EXPECT_FALSE(refused([](DroneModel&) {}));
  EXPECT_TRUE(refused([](DroneModel& m) { m.mass = 0; }));
  EXPECT_TRUE(refused([](DroneModel& m) { m.mass = std::nan(""); }));
  EXPECT_TRUE(refused([](DroneModel& m) { m.rotors.resize(2); }));
  EXPECT_TRUE(refused([](DroneModel& m) { m.rotors[0].axis_B = {0, 0, 2}; }));
  EXPECT_TRUE(refused([](DroneModel& m) { m.inertia_B.m[0][1] = m.inertia_B.m[1][0] = 1; }));
  EXPECT_TRUE(refused([](DroneModel& m) { m.rotors[3].tau_up = 0; }));
}

}  // namespace
}  // namespace airsim360
