#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/flight/dynamics/battery_equations.h"
#include "airsim360/flight/dynamics/dynamics.h"
#include "airsim360/flight/test_drones.h"

namespace airsim360 {
namespace {

DroneModel Powered() {
  DroneModel m = AgiliciousDrone();
  m.battery = {.cells = 4, .capacity_ah = 1.5, .resistance = 0.03, .efficiency = 0.75, .idle_power = 5};
  return m;
}

DroneState HoveringOnBattery(const DroneModel& model) {
  DroneState s;
  s.rotor_speeds.fill(HoverSpeed(model));
  return s;
}

double HoverPower(const DroneModel& m) {
  const RotorModel& r = m.rotors[0];
  return 4 * r.torque_ratio * r.thrust_factor * std::pow(HoverSpeed(m), 3) / m.battery.efficiency + m.battery.idle_power;
}

TEST(Battery, CellVoltageIsThePublishedCurve) {
  for (double charge = 0; charge <= 1; charge += 0.01) {
    const double exact =
        -1.031 * std::exp(-35 * charge) + 3.685 + 0.2156 * charge - 0.1178 * charge * charge + 0.3201 * charge * charge * charge;
    EXPECT_NEAR(internal::CellVoltage(charge), exact, 1e-4);
  }
}

TEST(Battery, VoltageAndCurrentGiveThePowerThatTheRotorsTake) {
  const DroneModel m = Powered();
  const DroneState s = HoveringOnBattery(m);
  const double voltage = BatteryVoltage(m, s);
  const double current = (4 * internal::CellVoltage(1.0) - voltage) / m.battery.resistance;
  EXPECT_NEAR(voltage * current, HoverPower(m), 1e-9 * HoverPower(m));
  EXPECT_LT(voltage, 4 * internal::kFullCellVoltage);
}

TEST(Battery, HoverSpendsTheChargeThatItsPowerAsksFor) {
  const DroneModel m = Powered();
  const DroneDynamics drone(m, 1e-2);
  DroneState s = HoveringOnBattery(m);
  const RotorSpeeds hover = s.rotor_speeds;
  double ampere_seconds = 0;
  for (int i = 0; i < 1000; ++i) {
    ampere_seconds += HoverPower(m) / BatteryVoltage(m, s) * 1e-2;
    drone.Step({}, hover, kAllRotorsWork, s);
  }
  EXPECT_NEAR((1 - s.charge) * m.battery.capacity_ah * 3600, ampere_seconds, 1e-6 * ampere_seconds);
}

TEST(Battery, AWeakBatterySlowsTheRotorsAndADeadOneStopsThem) {
  const DroneModel m = Powered();
  const auto top_speed = [&](double charge) {
    const DroneDynamics drone(m, 1e-3);
    DroneState s;
    s.charge = charge;
    RotorSpeeds all;
    all.fill(1e9);
    for (int i = 0; i < 1000; ++i) drone.Step({}, all, kAllRotorsWork, s);
    return s.rotor_speeds[0];
  };
  EXPECT_LT(top_speed(1.0), m.rotors[0].max_speed);
  EXPECT_LT(top_speed(0.2), top_speed(0.8));
  EXPECT_EQ(top_speed(0), 0);
}

TEST(Battery, MorePowerThanItCanGiveLeavesFiniteFigures) {
  DroneModel m = Powered();
  m.battery.resistance = 10;
  const DroneDynamics drone(m, 1e-3);
  DroneState s = HoveringOnBattery(m);
  const RotorSpeeds hover = s.rotor_speeds;
  for (int i = 0; i < 20000; ++i) drone.Step({}, hover, kAllRotorsWork, s);
  EXPECT_TRUE(std::isfinite(Norm(s.p_WB)));
  EXPECT_GE(s.charge, 0);
  EXPECT_LT(s.rotor_speeds[0], HoverSpeed(m));
}

}  // namespace
}  // namespace airsim360
