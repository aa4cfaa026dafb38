// Every sample prompt gives a plausible drone, and a share of them is flown in each test.
#include <gtest/gtest.h>

#include <set>

#include "airsim360/flight/control/flight_check.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/flight/prompt/design.h"
#include "airsim360/flight/prompt/gate.h"
#include "airsim360/flight/prompt/sample_prompts.h"

namespace airsim360 {
namespace {

constexpr int kShares = 8;

class Sweep : public testing::TestWithParam<int> {};

TEST_P(Sweep, EveryPromptFliesTheLemniscateUntuned) {
  for (size_t i = static_cast<size_t>(GetParam()); i < std::size(kSamplePrompts); i += kShares) {
    const DroneDesign design = DroneFromPrompt(kSamplePrompts[i]);
    EXPECT_TRUE(GateProblems(design.model).empty()) << kSamplePrompts[i];
    EXPECT_NEAR(design.parts.Sum(), design.model.mass, 0.02 * design.model.mass) << kSamplePrompts[i];
    EXPECT_GT(design.endurance, 60) << kSamplePrompts[i];
    const FlightCheck check = CheckFlight(design.model);
    EXPECT_TRUE(check.passed) << kSamplePrompts[i] << ": rms " << check.tracking.rms << " m of " << check.lemniscate.amplitude;
  }
}
INSTANTIATE_TEST_SUITE_P(Prompts, Sweep, testing::Range(0, kShares));

TEST(Sweep, HoldsTwoHundredDifferentPrompts) {
  std::set<std::string> prompts(std::begin(kSamplePrompts), std::end(kSamplePrompts));
  EXPECT_GE(prompts.size(), 200u);
}

TEST(Catalog, LawsMeetRealDronesDescribedByMassSizeAndKind) {
  int thrusts = 0, inertias = 0;
  for (const CatalogDrone& drone : DroneCatalog()) {
    if (drone.prompt.empty()) continue;
    const DroneModel real = CatalogModel(std::string(drone.name)), words = DroneFromPrompt(drone.prompt).model;
    if (drone.measured_thrust) {
      EXPECT_NEAR(words.rotors[0].thrust_factor / real.rotors[0].thrust_factor, 1, 0.2) << drone.name;
      ++thrusts;
    }
    for (int i = 0; i < 3 && drone.measured_inertia; ++i) {
      EXPECT_NEAR(words.inertia_B.m[i][i] / real.inertia_B.m[i][i], 1, 0.3) << drone.name << " axis " << i;
      ++inertias;
    }
  }
  EXPECT_GE(thrusts, 7);
  EXPECT_GE(inertias, 21);
}

TEST(Catalog, EveryRealDroneFliesUntuned) {
  for (const CatalogDrone& drone : DroneCatalog()) {
    const FlightCheck check = CheckFlight(CatalogModel(std::string(drone.name)));
    EXPECT_TRUE(check.passed) << drone.name << ": rms " << check.tracking.rms << " m of " << check.lemniscate.amplitude;
  }
}

TEST(Catalog, AirSimsDroneHasAirSimsFigures) {
  const DroneModel model = CatalogModel("airsim_quad");
  EXPECT_NEAR(model.inertia_B.m[0][0], 0.006721, 1e-6);
  EXPECT_NEAR(model.inertia_B.m[1][1], 0.008041, 1e-6);
  EXPECT_NEAR(model.inertia_B.m[2][2], 0.014279, 1e-6);
  const RotorModel& rotor = model.rotors[0];
  EXPECT_NEAR(ThrustAtSpeed(rotor, rotor.max_speed), 4.179446, 1e-4);
  EXPECT_NEAR(ThrustAtSpeed(rotor, rotor.max_speed) * rotor.torque_ratio, 0.055562, 1e-5);
  EXPECT_NEAR(model.mass * kGravity / MaxThrust(model), 0.5866, 1e-4);
  // Terminal fall: m g = c v^2.
  EXPECT_NEAR(std::sqrt(model.mass * kGravity / model.quadratic_drag_B.z), 8.53, 0.01);
  EXPECT_NEAR(model.quadratic_drag_B.x / kSeaLevelAirDensity, 0.005383, 1e-6);
}

TEST(Gate, FindsWhatPublishedSetsGetWrong) {
  const auto problems = GateProblems(CatalogModel("crazyflie_rotorpy"));
  ASSERT_EQ(problems.size(), 3u);  // torque constant, figure of merit, inertia
  EXPECT_NE(problems[0].find("k_m / (k_f D) 0.722"), std::string::npos);
  EXPECT_NE(problems[2].find("triangle"), std::string::npos);
  EXPECT_NE(GateProblems(CatalogModel("airsim_octo")).at(0).find("spacing"), std::string::npos);
  EXPECT_TRUE(GateProblems(CatalogModel("crazyflie")).empty());
  EXPECT_TRUE(GateProblems(CatalogModel("agilicious")).empty());
}

TEST(Gate, RefusesEachBrokenFigure) {
  const DroneModel good = CatalogModel("agilicious");
  const auto breaks = [&](auto change) {
    DroneModel model = good;
    change(model);
    return GateProblems(model).size();
  };
  EXPECT_EQ(breaks([](DroneModel&) {}), 0u);
  EXPECT_GT(breaks([](DroneModel& m) { m.inertia_B.m[2][2] = 0.01; }), 0u);
  EXPECT_GT(breaks([](DroneModel& m) { m.inertia_B.m[0][1] = m.inertia_B.m[1][0] = 0.0023; }), 0u);
  EXPECT_GT(breaks([](DroneModel& m) {
              for (auto& r : m.rotors) r.thrust_factor *= 2;
            }),
            0u);
  EXPECT_GT(breaks([](DroneModel& m) {
              for (auto& r : m.rotors) r.torque_ratio *= 3;
            }),
            0u);
  EXPECT_GT(breaks([](DroneModel& m) { m.rotors[0].tau_up = 0.3; }), 0u);
  EXPECT_GT(breaks([](DroneModel& m) { m.rotors[0].p_B = m.rotors[2].p_B * 0.9; }), 0u);
  EXPECT_GT(breaks([](DroneModel& m) { m.mass *= 5; }), 0u);
  EXPECT_GT(breaks([](DroneModel& m) {
              for (auto& r : m.rotors) r.max_speed *= 2;
            }),
            0u);
}

}  // namespace
}  // namespace airsim360
