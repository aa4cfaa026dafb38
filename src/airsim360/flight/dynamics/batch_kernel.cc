#include "airsim360/flight/dynamics/batch_blocks.h"
#include "airsim360/flight/dynamics/drone_step.h"
#include "airsim360/flight/dynamics/lane_vector.h"

namespace airsim360::internal::AIRSIM360_ISA {
namespace {

namespace stdx = std::experimental;
using Lanes = stdx::native_simd<float>;
constexpr int kLanes = static_cast<int>(Lanes::size());

AIRSIM360_LANES Lanes Get(const float* row) { return Lanes(row, stdx::vector_aligned); }
AIRSIM360_LANES void Put(Lanes v, float* row) { v.copy_to(row, stdx::vector_aligned); }
AIRSIM360_LANES Vec3<Lanes> Get3(const LaneRow* rows, int k) { return {Get(rows[0] + k), Get(rows[1] + k), Get(rows[2] + k)}; }
AIRSIM360_LANES void Put3(const Vec3<Lanes>& v, LaneRow* rows, int k) {
  Put(v.x, rows[0] + k);
  Put(v.y, rows[1] + k);
  Put(v.z, rows[2] + k);
}

AIRSIM360_LANES void Load(const DroneBlock& b, int k, int rotors, BodyState<Lanes>& s) {
  s.p = Get3(b.p, k);
  s.p_low = Get3(b.p_low, k);
  s.v = Get3(b.v, k);
  s.w = Get3(b.w, k);
  for (int i = 0; i < 4; ++i) s.q[i] = Get(b.q[i] + k);
  for (int i = 0; i < rotors; ++i) s.speed[i] = Get(b.speed[i] + k);
  s.charge = Get(b.charge + k);
}

AIRSIM360_LANES void Store(const BodyState<Lanes>& s, int k, int rotors, DroneBlock& b) {
  Put3(s.p, b.p, k);
  Put3(s.p_low, b.p_low, k);
  Put3(s.v, b.v, k);
  Put3(s.w, b.w, k);
  for (int i = 0; i < 4; ++i) Put(s.q[i], b.q[i] + k);
  for (int i = 0; i < rotors; ++i) Put(s.speed[i], b.speed[i] + k);
  Put(s.charge, b.charge + k);
}

AIRSIM360_LANES LaneSurroundings<Lanes> Load(const SurroundingsBlock& b, int k) {
  return {Get3(b.wind, k), Get3(b.wind_rate, k), Get3(b.force, k), Get3(b.torque, k), Get(b.density + k), Get(b.ground_distance + k)};
}

template <class Drive>
AIRSIM360_LANES void StepBlock(const BatchWork& work, const SurroundingsBlock& around, int k, DroneBlock& block) {
  const DroneConstants<float>& c = *work.constants;
  const int rotors = Drive::Layout::Rotors(c);
  BodyState<Lanes> s;
  Lanes command[kMaxRotors];
  Load(block, k, rotors, s);
  for (int r = 0; r < rotors; ++r) command[r] = Get(block.command[r] + k);
  StepLanes<Drive>(c, Load(around, k), work.near_ground, command, work.steps, s);
  Store(s, k, rotors, block);
}

}  // namespace

void StepBlocks(const BatchWork& work) {
  ChooseDrive<Lanes>(*work.constants, [&]<class Drive>(Drive*) {
    for (int64_t i = 0; i < work.count; ++i) {
      const SurroundingsBlock& around = work.surroundings[work.shared ? 0 : i];
      for (int k = 0; k < kBlockDrones; k += kLanes) StepBlock<Drive>(work, around, k, work.blocks[i]);
    }
  });
}

}  // namespace airsim360::internal::AIRSIM360_ISA
