#include "airsim360/flight/dynamics/downwash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "airsim360/flight/dynamics/dynamics.h"
#include "airsim360/flight/test_drones.h"

namespace airsim360 {
namespace {

RotorWake HoverWake(const DroneModel& model, Vec3d p = {}) {
  DroneState s;
  s.p_WB = p;
  s.rotor_speeds.fill(HoverSpeed(model));
  return WakeOf(model, s);
}

/// Momentum flux / density through the plane x metres below: the integral of u^2.
double MomentumFlux(const RotorWake& wake, double x) {
  double sum = 0;
  const double dr = x / 400;
  for (double r = dr / 2; r < 2 * x; r += dr) {
    const double u = -WakeVelocity(wake, wake.p_W + Vec3d{r, 0, -x}).z;
    sum += u * u * 2 * std::numbers::pi * r * dr;
  }
  return sum;
}

TEST(Downwash, TheJetCarriesTheThrustAsMomentum) {
  const DroneModel model = AgiliciousDrone();
  const RotorWake wake = HoverWake(model);
  EXPECT_NEAR(wake.momentum, model.mass * kGravity / kSeaLevelAirDensity, 1e-12);
  for (double x : {2.0, 5.0, 20.0}) EXPECT_NEAR(MomentumFlux(wake, x) / wake.momentum, 1, 0.01) << x;
}

TEST(Downwash, StartsAtTheInducedVelocityAndIsNeverMoreThanTwiceIt) {
  const DroneModel model = AgiliciousDrone();
  const RotorWake wake = HoverWake(model);
  const double induced = std::sqrt(model.mass * kGravity / (2 * kSeaLevelAirDensity * 4 * std::numbers::pi / 4 * 0.13 * 0.13));
  EXPECT_NEAR(-WakeVelocity(wake, {0, 0, -1e-6}).z, induced, 1e-3);
  double last = 0;
  for (double x = 0.01; x < 30; x += 0.01) {
    const double u = -WakeVelocity(wake, {0, 0, -x}).z;
    EXPECT_LE(u, 2 * induced);
    EXPECT_LT(std::abs(u - last), 0.6 * induced + (x < 0.02 ? induced : 0)) << x;  // no jump where the parts join
    last = u;
  }
}

TEST(Downwash, GoesDownwardsOnlyAndFadesSideways) {
  const RotorWake wake = HoverWake(AgiliciousDrone(), {1, 2, 10});
  EXPECT_EQ(WakeVelocity(wake, {1, 2, 10.5}), (Vec3d{}));
  EXPECT_GT(-WakeVelocity(wake, {1, 2, 9}).z, 10 * -WakeVelocity(wake, {1.6, 2, 9}).z);
}

TEST(Downwash, MomentaOfWakesAdd) {
  const RotorWake wake = HoverWake(AgiliciousDrone());
  const RotorWake wakes[] = {wake, wake, wake};
  const Vec3d below{0, 0, -3};
  EXPECT_NEAR(DownwashOn(wakes, 0, below).z, std::sqrt(2.0) * WakeVelocity(wake, below).z, 1e-12);
  EXPECT_EQ(DownwashOn(std::span(wakes, 1), 0, below), (Vec3d{}));
}

TEST(Downwash, PushesDownADroneBelowAnother) {
  const DroneModel model = DroneWithEveryTerm();
  DroneState s;
  s.rotor_speeds.fill(HoverSpeed(model));
  DroneSurroundings below;
  below.wind_W = WakeVelocity(HoverWake(model, {0, 0, 1}), s.p_WB);
  const DroneDynamics drone(model);
  EXPECT_LT(drone.Derivative(below, s.rotor_speeds, kAllRotorsWork, s).a_WB.z, -0.5);
}

}  // namespace
}  // namespace airsim360
