#include "airsim360/flight/control/mixer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "airsim360/base/random.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/flight/prompt/design.h"

namespace airsim360 {
namespace {

std::vector<DroneModel> Layouts() {
  return {CatalogModel("agilicious"),
          CatalogModel("airsim_quad"),
          CatalogModel("f550"),
          CatalogModel("octo"),
          DroneFromPrompt("a plus quad").model,
          DroneFromPrompt("a coaxial 8 kg drone").model,
          DroneFromPrompt("an H quad").model};
}

void ExpectEqual(const RotorWrench& a, const RotorWrench& b, double scale) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a.torque_B[i], b.torque_B[i], 1e-12 * scale);
  EXPECT_NEAR(a.thrust, b.thrust, 1e-12 * scale);
}

TEST(Mixer, GivesExactlyTheWantedWrenchWhereItFits) {
  for (const DroneModel& model : Layouts()) {
    const Mixer mixer(model);
    const double weight = model.mass * kGravity, arm = std::abs(model.rotors[0].p_B.x) + 0.01;
    RngStream rng(1, model.name);
    for (int i = 0; i < 50; ++i) {
      const double c = model.rotors[0].torque_ratio;
      const RotorWrench wanted{
          {0.05 * weight * arm * rng.Uniform(-1, 1), 0.05 * weight * arm * rng.Uniform(-1, 1), 0.05 * weight * c * rng.Uniform(-1, 1)},
          weight * rng.Uniform(0.8, 1.1)};
      const Mixer::Result result = mixer.Allocate(wanted);
      EXPECT_FALSE(result.saturated) << model.name;
      ExpectEqual(mixer.WrenchOf(result.thrust), wanted, weight);
    }
  }
}

TEST(Mixer, KeepsEveryRotorWithinItsRange) {
  for (const DroneModel& model : Layouts()) {
    const Mixer mixer(model);
    const double full = MaxThrust(model);
    RngStream rng(2, model.name);
    for (int i = 0; i < 200; ++i) {
      const RotorWrench wild{{full * rng.Normal(), full * rng.Normal(), full * rng.Normal()}, full * rng.Uniform(-1, 3)};
      const Mixer::Result result = mixer.Allocate(wild);
      for (int k = 0; k < mixer.rotors(); ++k) {
        EXPECT_GE(result.thrust[k], 0);
        EXPECT_LE(result.thrust[k], mixer.max_thrust(k) * (1 + 1e-12));
      }
    }
  }
}

TEST(Mixer, GivesUpYawBeforeThrustAndThrustBeforeRollAndPitch) {
  const DroneModel model = CatalogModel("agilicious");
  const Mixer mixer(model);
  const double full = MaxThrust(model);
  // Roll near the limit, full thrust, much yaw: the roll comes whole, the thrust falls short, no yaw is left.
  const double roll = 0.3 * full * 0.1;
  const RotorWrench given = mixer.WrenchOf(mixer.Allocate({{roll, 0, 0.05 * full}, full}).thrust);
  EXPECT_NEAR(given.torque_B.x, roll, 1e-9 * full);
  EXPECT_NEAR(given.torque_B.y, 0, 1e-9 * full);
  EXPECT_LT(given.thrust, 0.9 * full);
  EXPECT_GT(given.thrust, 0.6 * full);
  EXPECT_LT(given.torque_B.z, 0.001 * full);
  // Half the thrust and too much yaw: roll, pitch and thrust come whole, yaw partly.
  const RotorWrench turned = mixer.WrenchOf(mixer.Allocate({{0, 0, 0.1 * full}, 0.5 * full}).thrust);
  EXPECT_NEAR(turned.thrust, 0.5 * full, 1e-9 * full);
  EXPECT_NEAR(turned.torque_B.x, 0, 1e-9 * full);
  EXPECT_GT(turned.torque_B.z, 0.004 * full);
  EXPECT_LT(turned.torque_B.z, 0.01 * full);
}

TEST(Mixer, ScalesRollAndPitchTogetherWhenEvenTheyDoNotFit) {
  const DroneModel model = CatalogModel("agilicious");
  const Mixer mixer(model);
  const double full = MaxThrust(model);
  const RotorWrench given = mixer.WrenchOf(mixer.Allocate({{full, 0.5 * full, 0}, 0.5 * full}).thrust);
  EXPECT_GT(given.torque_B.x, 0);
  EXPECT_NEAR(given.torque_B.y / given.torque_B.x, 0.5, 1e-9);
}

TEST(Mixer, AHexaThatLostARotorStillGivesRollPitchAndThrust) {
  const DroneModel model = CatalogModel("f550");
  const double weight = model.mass * kGravity;
  for (int lost = 0; lost < 6; ++lost) {
    const Mixer mixer(model, uint64_t{1} << lost);
    ASSERT_TRUE(mixer.usable());
    const Mixer::Result result = mixer.Allocate({{0.005 * weight, -0.005 * weight, 0}, 0.8 * weight});
    EXPECT_EQ(result.thrust[lost], 0);
    const RotorWrench given = mixer.WrenchOf(result.thrust);
    EXPECT_NEAR(given.torque_B.x, 0.005 * weight, 1e-6 * weight);
    EXPECT_NEAR(given.torque_B.y, -0.005 * weight, 1e-6 * weight);
    EXPECT_NEAR(given.thrust, 0.8 * weight, 0.1 * weight);
  }
}

TEST(Mixer, AQuadThatLostARotorGivesUpYaw) {
  const Mixer mixer(CatalogModel("agilicious"), 1);
  EXPECT_TRUE(mixer.usable());
  EXPECT_FALSE(mixer.has_yaw());
}

}  // namespace
}  // namespace airsim360
