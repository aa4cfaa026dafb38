#include "airsim360/flight/dynamics/batch.h"

#include <algorithm>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/flight/dynamics/ground_effect.h"

namespace airsim360 {
namespace {

using internal::DroneBlock;
using internal::kBlockDrones;
using internal::LaneRow;
using internal::SurroundingsBlock;

void Put(Vec3d v, LaneRow* rows, int lane) {
  for (int i = 0; i < 3; ++i) rows[i][lane] = static_cast<float>(v[i]);
}

Vec3d Get(const LaneRow* rows, int lane) { return {rows[0][lane], rows[1][lane], rows[2][lane]}; }

void Put(const DroneSurroundings& s, int lane, SurroundingsBlock& b) {
  Put(s.wind_W, b.wind, lane);
  Put(s.wind_rate_B, b.wind_rate, lane);
  Put(s.force_W, b.force, lane);
  Put(s.torque_B, b.torque, lane);
  b.density[lane] = static_cast<float>(s.air_density / kSeaLevelAirDensity);
  b.ground_distance[lane] = static_cast<float>(s.ground_distance);
}

SurroundingsBlock CalmAir() {
  SurroundingsBlock b;
  for (int lane = 0; lane < kBlockDrones; ++lane) Put(DroneSurroundings{}, lane, b);
  return b;
}

/// Blocks that one thread steps at a time: enough to make a task worth its start.
constexpr int64_t kTaskBlocks = 64;

}  // namespace

DroneBatch::DroneBatch(const DroneModel& model, int count, double dt)
    : count_(count), dt_(dt), constants_(internal::MakeDroneConstants<float>(model, dt)) {
  if (count < 1) throw InputError("DroneBatch: count = " + std::to_string(count) + "; it must be at least 1");
  blocks_.resize((count + kBlockDrones - 1) / kBlockDrones, DroneBlock{});
  surroundings_ = {CalmAir()};
  for (DroneBlock& b : blocks_) {
    std::fill_n(b.q[0], kBlockDrones, 1.0f);
    std::fill_n(b.charge, kBlockDrones, 1.0f);
  }
}

DroneState DroneBatch::state(int i) const {
  const DroneBlock& b = blocks_[i / kBlockDrones];
  const int lane = i % kBlockDrones;
  DroneState s;
  s.p_WB = Get(b.p, lane) + Get(b.p_low, lane);
  s.v_WB = Get(b.v, lane);
  s.q_WB = {b.q[0][lane], b.q[1][lane], b.q[2][lane], b.q[3][lane]};
  s.w_WB_B = Get(b.w, lane);
  for (int r = 0; r < kMaxRotors; ++r) s.rotor_speeds[r] = b.speed[r][lane];
  s.charge = b.charge[lane];
  return s;
}

void DroneBatch::SetState(int i, const DroneState& s) {
  DroneBlock& b = blocks_[i / kBlockDrones];
  const int lane = i % kBlockDrones;
  const double q[4] = {s.q_WB.w, s.q_WB.x, s.q_WB.y, s.q_WB.z};
  Put(s.p_WB, b.p, lane);
  Put(s.p_WB - Get(b.p, lane), b.p_low, lane);
  Put(s.v_WB, b.v, lane);
  Put(s.w_WB_B, b.w, lane);
  for (int k = 0; k < 4; ++k) b.q[k][lane] = static_cast<float>(q[k]);
  for (int r = 0; r < kMaxRotors; ++r) b.speed[r][lane] = static_cast<float>(s.rotor_speeds[r]);
  b.charge[lane] = static_cast<float>(s.charge);
}

void DroneBatch::SetCommands(int i, const RotorSpeeds& commands, const RotorHealth& health) {
  DroneBlock& b = blocks_[i / kBlockDrones];
  for (int r = 0; r < kMaxRotors; ++r) {
    b.command[r][i % kBlockDrones] = static_cast<float>(commands[r] * health[r]);
  }
}

void DroneBatch::SetSurroundings(int i, const DroneSurroundings& s) {
  if (surroundings_.size() < blocks_.size()) surroundings_.resize(blocks_.size(), surroundings_.front());
  Put(s, i % kBlockDrones, surroundings_[i / kBlockDrones]);
  near_ground_ = near_ground_ || internal::FeelsGround(constants_, s.ground_distance);
}

void DroneBatch::Step(int steps) {
  const auto kernel = AIRSIM360_SELECT_KERNEL(StepBlocks);
  const int64_t blocks = static_cast<int64_t>(blocks_.size());
  const bool shared = surroundings_.size() < blocks_.size();
  ParallelFor((blocks + kTaskBlocks - 1) / kTaskBlocks, [&](int64_t task) {
    const int64_t first = task * kTaskBlocks;
    kernel({&constants_, &blocks_[first], &surroundings_[shared ? 0 : first], shared, near_ground_, steps,
            std::min(kTaskBlocks, blocks - first)});
  });
}

}  // namespace airsim360
