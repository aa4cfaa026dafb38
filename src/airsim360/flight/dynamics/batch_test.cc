#include "airsim360/flight/dynamics/batch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"
#include "airsim360/flight/dynamics/drone_step.h"
#include "airsim360/flight/dynamics/dynamics.h"
#include "airsim360/flight/test_drones.h"

namespace airsim360 {
namespace {

DroneState RandomState(RngStream& rng, double speed) {
  const auto vector = [&](double r) { return Vec3d{rng.Uniform(-r, r), rng.Uniform(-r, r), rng.Uniform(-r, r)}; };
  DroneState s;
  s.p_WB = vector(50);
  s.v_WB = vector(10);
  s.w_WB_B = vector(4);
  const Vec3d tilt = vector(0.5);
  const double norm = std::sqrt(1 + Dot(tilt, tilt));
  s.q_WB = {1 / norm, tilt.x / norm, tilt.y / norm, tilt.z / norm};
  for (double& w : s.rotor_speeds) w = speed * rng.Uniform(0.7, 1.3);
  return s;
}

DroneSurroundings RandomAir(RngStream& rng) {
  DroneSurroundings s;
  s.wind_W = {rng.Uniform(-5, 5), rng.Uniform(-5, 5), rng.Uniform(-1, 1)};
  s.wind_rate_B = {rng.Uniform(-0.3, 0.3), 0, 0.1};
  s.air_density = rng.Uniform(0.9, 1.3);
  s.ground_distance = rng.Uniform(0, 1);
  s.force_W = {0, rng.Uniform(-1, 1), 0};
  s.torque_B = {0, 0, rng.Uniform(-0.01, 0.01)};
  return s;
}

DroneBatch RandomBatch(const DroneModel& model, int count) {
  DroneBatch batch(model, count);
  for (int i = 0; i < count; ++i) {
    RngStream rng(7, "batch", i);
    batch.SetState(i, RandomState(rng, HoverSpeed(model)));
    RotorSpeeds commands;
    for (double& c : commands) c = HoverSpeed(model) * rng.Uniform(0.5, 1.5);
    batch.SetCommands(i, commands);
    batch.SetSurroundings(i, RandomAir(rng));
  }
  return batch;
}

/// All bits of a state.
std::string Bits(const DroneState& s) {
  double all[14 + kMaxRotors] = {s.p_WB.x, s.p_WB.y, s.p_WB.z, s.v_WB.x,   s.v_WB.y,   s.v_WB.z,   s.q_WB.w,
                                 s.q_WB.x, s.q_WB.y, s.q_WB.z, s.w_WB_B.x, s.w_WB_B.y, s.w_WB_B.z, s.charge};
  for (int i = 0; i < kMaxRotors; ++i) all[14 + i] = s.rotor_speeds[i];
  return {reinterpret_cast<const char*>(all), sizeof all};
}

std::string Bits(const DroneBatch& batch) {
  std::string all;
  for (int i = 0; i < batch.size(); ++i) all += Bits(batch.state(i));
  return all;
}

std::vector<DroneModel> Models() {
  DroneModel powered = DroneWithEveryTerm();
  powered.name = "powered";
  powered.battery = {.cells = 4, .capacity_ah = 1.5, .resistance = 0.03, .efficiency = 0.75, .idle_power = 5};
  DroneModel tilted = DroneWithEveryTerm();
  tilted.name = "tilted";
  for (size_t i = 0; i < 4; ++i) tilted.rotors[i].axis_B = Normalized(Vec3d{0.1, i % 2 ? 0.2 : -0.2, 1});
  return {AgiliciousDrone(), DroneWithEveryTerm(), powered, tilted};
}

/// One drone in single precision, by the same equations without lanes.
template <class Drive>
DroneState StepScalar(const DroneModel& model, const DroneState& start, const RotorSpeeds& commands, const DroneSurroundings& air,
                      int steps) {
  const auto c = internal::MakeDroneConstants<float>(model, 1e-3);
  internal::BodyState<float> s;
  s.p = VecCast<float>(start.p_WB);
  s.p_low = VecCast<float>(start.p_WB - VecCast<double>(s.p));
  s.v = VecCast<float>(start.v_WB);
  s.w = VecCast<float>(start.w_WB_B);
  const double q[] = {start.q_WB.w, start.q_WB.x, start.q_WB.y, start.q_WB.z};
  for (int i = 0; i < 4; ++i) s.q[i] = float(q[i]);
  s.charge = float(start.charge);
  float command[kMaxRotors];
  for (int i = 0; i < c.rotors; ++i) s.speed[i] = float(start.rotor_speeds[i]), command[i] = float(commands[i]);
  const internal::LaneSurroundings<float> around = {VecCast<float>(air.wind_W),
                                                    VecCast<float>(air.wind_rate_B),
                                                    VecCast<float>(air.force_W),
                                                    VecCast<float>(air.torque_B),
                                                    float(air.air_density / kSeaLevelAirDensity),
                                                    float(air.ground_distance)};
  internal::StepLanes<Drive>(c, around, true, command, steps, s);
  DroneState out = start;
  out.p_WB = VecCast<double>(s.p) + VecCast<double>(s.p_low);
  out.v_WB = VecCast<double>(s.v);
  out.w_WB_B = VecCast<double>(s.w);
  out.q_WB = {s.q[0], s.q[1], s.q[2], s.q[3]};
  for (int i = 0; i < c.rotors; ++i) out.rotor_speeds[i] = s.speed[i];
  out.charge = s.charge;
  return out;
}

TEST(Batch, EveryDroneHasTheBitsOfTheScalarPath) {
  for (const DroneModel& model : Models()) {
    DroneBatch batch = RandomBatch(model, 37);
    batch.Step(200);
    for (int i = 0; i < batch.size(); ++i) {
      RngStream rng(7, "batch", i);
      DroneState start = RandomState(rng, HoverSpeed(model));
      for (double& w : start.rotor_speeds) w = float(w);
      RotorSpeeds commands;
      for (double& c : commands) c = HoverSpeed(model) * rng.Uniform(0.5, 1.5);
      const DroneSurroundings air = RandomAir(rng);
      const DroneState alone = model.name == "tilted" ? StepScalar<internal::TiltedDrive<float>>(model, start, commands, air, 200)
                                                      : StepScalar<internal::UprightDrive<float>>(model, start, commands, air, 200);
      ASSERT_EQ(Bits(batch.state(i)), Bits(alone)) << model.name << " drone " << i;
    }
  }
}

TEST(Batch, StaysNearTheDoublePrecisionPath) {
  const DroneModel model = DroneWithEveryTerm();
  const DroneDynamics drone(model);
  DroneBatch batch = RandomBatch(model, 16);
  batch.Step(500);
  for (int i = 0; i < batch.size(); ++i) {
    RngStream rng(7, "batch", i);
    DroneState s = RandomState(rng, HoverSpeed(model));
    RotorSpeeds commands;
    for (double& c : commands) c = HoverSpeed(model) * rng.Uniform(0.5, 1.5);
    const DroneSurroundings air = RandomAir(rng);
    for (int k = 0; k < 500; ++k) drone.Step(air, commands, kAllRotorsWork, s);
    EXPECT_LT(Norm(s.p_WB - batch.state(i).p_WB), 1e-3) << i;
    EXPECT_LT(Norm(s.v_WB - batch.state(i).v_WB), 5e-3) << i;
  }
}

TEST(Batch, InstructionSetsAgreeBitForBit) {
  using internal::KernelIsa;
  for (const DroneModel& model : Models()) {
    const auto constants = internal::MakeDroneConstants<float>(model, 1e-3);
    std::vector<internal::DroneBlock> blocks(3);
    internal::SurroundingsBlock around{};
    RngStream rng(11, "isa");
    const auto fill = [&](internal::LaneRow* row, int rows, float low, float high) {
      for (int i = 0; i < rows * internal::kBlockDrones; ++i) row[0][i] = float(rng.Uniform(low, high));
    };
    for (auto& b : blocks) {
      fill(b.p, 3, -50, 50), fill(b.p_low, 3, 0, 0), fill(b.v, 3, -10, 10), fill(b.q, 4, 0.49f, 0.51f);
      fill(b.w, 3, -5, 5), fill(&b.charge, 1, 0.01f, 1), fill(b.speed, 8, 300, 1500), fill(b.command, 8, -100, 2600);
    }
    fill(around.wind, 12, -1, 1), fill(&around.density, 1, 0.8f, 1.1f), fill(&around.ground_distance, 1, 0, 1);
    const auto end = [&](auto kernel) {
      std::vector<internal::DroneBlock> copy = blocks;
      kernel({&constants, copy.data(), &around, true, true, 300, 3});
      return std::string(reinterpret_cast<const char*>(copy.data()), copy.size() * sizeof copy[0]);
    };
    const std::string bits = end(internal::isa_sse42::StepBlocks);
    const KernelIsa isa = internal::CurrentKernelIsa();
    if (isa >= KernelIsa::kAvx2) {
      EXPECT_TRUE(bits == end(internal::isa_avx2::StepBlocks)) << model.name;
    }
    if (isa >= KernelIsa::kAvx512) {
      EXPECT_TRUE(bits == end(internal::isa_avx512::StepBlocks)) << model.name;
    }
  }
}

TEST(Batch, SingleDroneInstructionSetsAgreeBitForBit) {
  using internal::KernelIsa;
  const auto constants = internal::MakeDroneConstants<double>(DroneWithEveryTerm(), 1e-3);
  RngStream rng(3, "isa");
  const DroneState start = RandomState(rng, 1000);
  const DroneSurroundings air = RandomAir(rng);
  const auto end = [&](internal::StepOneKernel* kernel) {
    DroneState s = start;
    for (int i = 0; i < 1000; ++i) kernel(constants, air, {1200, 900, 1500, 1100}, kAllRotorsWork, s);
    return Bits(s);
  };
  const std::string bits = end(internal::isa_sse42::StepOne);
  const KernelIsa isa = internal::CurrentKernelIsa();
  if (isa >= KernelIsa::kAvx2) {
    EXPECT_EQ(bits, end(internal::isa_avx2::StepOne));
  }
  if (isa >= KernelIsa::kAvx512) {
    EXPECT_EQ(bits, end(internal::isa_avx512::StepOne));
  }
}

TEST(Batch, ThreadsSnapshotsAndCallSizesDoNotChangeTheBits) {
  for (const DroneModel& model : Models()) {
    const DroneBatch start = RandomBatch(model, 3000);
    DroneBatch whole = start;
    whole.Step(60);
    {
      const ThreadLimit one(1);
      DroneBatch single = start;
      single.Step(60);
      EXPECT_TRUE(Bits(whole) == Bits(single)) << model.name;
    }
    DroneBatch pieces = start;
    for (int i = 0; i < 23; ++i) pieces.Step();
    const DroneBatch snapshot = pieces;
    pieces.Step(5);
    pieces = snapshot;
    pieces.Step(37);
    EXPECT_TRUE(Bits(whole) == Bits(pieces)) << model.name;
  }
}

TEST(Batch, ADroneDoesNotNoticeWhichOthersAreInTheBatch) {
  const DroneModel model = AgiliciousDrone();
  RngStream rng(2, "alone");
  DroneState s = RandomState(rng, 900);
  DroneSurroundings air = RandomAir(rng);
  air.ground_distance = 9 * model.rotors[0].diameter / 2;  // just out of the ground's reach
  DroneSurroundings low;
  low.ground_distance = 0.05;
  const auto end = [&](int drones) {
    DroneBatch batch(model, drones);
    for (int i = 1; i < drones; ++i) batch.SetSurroundings(i, low);
    batch.SetState(0, s);
    batch.SetSurroundings(0, air);
    batch.SetCommands(0, {1000, 1100, 900, 950});
    batch.Step(100);
    return Bits(batch.state(0));
  };
  EXPECT_EQ(end(1), end(20));
}

// In plain float a step of 1e-6 m at 100 m would be lost.
TEST(Batch, SmallStepsFarFromTheOriginAreKept) {
  DroneModel model = AgiliciousDrone();
  model.quadratic_drag_B = {};
  for (RotorModel& r : model.rotors) r.in_plane_drag = 0;
  DroneBatch batch(model, 1);
  DroneState s;
  s.p_WB = {1000, -1000, 500};
  s.v_WB = {1e-3, 0, 0};
  DroneSurroundings air;
  batch.SetState(0, s);
  batch.SetSurroundings(0, air);
  batch.Step(10000);
  EXPECT_NEAR(batch.state(0).p_WB.x - 1000, 1e-2, 1e-6);
}

TEST(Batch, StatesComeBackAsTheyWereSet) {
  DroneBatch batch(AgiliciousDrone(), 20);
  RngStream rng(1, "state");
  const DroneState s = RandomState(rng, 1000);
  batch.SetState(17, s);
  EXPECT_LT(Norm(batch.state(17).p_WB - s.p_WB), 1e-12);
  EXPECT_LT(Norm(batch.state(17).v_WB - s.v_WB), 1e-5);
  EXPECT_NEAR(batch.state(17).q_WB.y, s.q_WB.y, 1e-7);
  EXPECT_EQ(batch.state(16).p_WB, (Vec3d{}));
}

}  // namespace
}  // namespace airsim360
