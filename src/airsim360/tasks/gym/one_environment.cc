// One environment of the vector: its beginning, its step, what is seen of it.
#include <algorithm>
#include <cmath>

#include "airsim360/sim/living_world.h"
#include "airsim360/tasks/gym/vector_environment.h"

namespace airsim360 {
namespace {

double Clamped(float value) { return std::clamp(static_cast<double>(value), -1.0, 1.0); }

void Put(Vec3d v, float* out) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

template <class Pixel>
void CopyRow(const Image<Pixel>& image, size_t i, std::vector<Pixel>& rows) {
  if (!rows.empty()) std::ranges::copy(image.pixels(), rows.begin() + static_cast<ptrdiff_t>(i * image.size()));
}

}  // namespace

void VectorEnvironment::Begin(size_t i, const NavigationEpisode& episode) {
  Lane& lane = lanes_[i];
  lane.episode = episode;
  lane.ended = false;
  SimState state;
  state.wind_W = model_->wind.mean_W;
  StartLife(*model_, state);
  state.vehicles.push_back(DroneAt(*model_, state, 0, lane.episode.X_WB, true));
  lane.loop = std::make_unique<SimLoop>(model_, std::move(state));
  reward_[i] = 0;
  steps_[i] = 0;
  terminated_[i] = truncated_[i] = reached_[i] = crashed_[i] = 0;
}

Command VectorEnvironment::CommandOf(std::span<const float> a) const {
  switch (options_.action) {
    case ActionLevel::kVelocity: {
      const Vec3d v = options_.max_speed * Vec3d{Clamped(a[0]), Clamped(a[1]), Clamped(a[2])};
      return VelocityCommand{.v = v, .body_heading = true, .yaw = {YawTarget::Mode::kRate, options_.max_turn * Clamped(a[3])}};
    }
    case ActionLevel::kRates:
      return RateCommand{options_.max_rate * Vec3d{Clamped(a[1]), Clamped(a[2]), Clamped(a[3])},
                         {VerticalTarget::Mode::kThrottle, 0.5 * (Clamped(a[0]) + 1)}};
    case ActionLevel::kRotors:
      break;
  }
  RotorSignalCommand command;
  for (size_t r = 0; r < a.size(); ++r) command.signals[r] = 0.5 * (Clamped(a[r]) + 1);
  return command;
}

void VectorEnvironment::StepLane(size_t i, std::span<const float> action, Slot& slot) {
  Lane& lane = lanes_[i];
  if (lane.ended) {
    ++lane.number;
    Begin(i, world_.Sample(seed_, i, lane.number));
    Look(i, slot);
    FillState(i);
    return;
  }

  // One command, held for the whole step; a crash ends it early.
  SimLoop& loop = *lane.loop;
  const Vec3d before = loop.state().vehicles[0].motion.X_WB.p;
  const uint64_t collisions = loop.state().vehicles[0].collision.count;
  loop.Post({0, FlightCommand{CommandOf(action)}});
  const auto dynamics_steps = std::llround(options_.period * 1e9 / static_cast<double>(model_->dt_ns));
  const auto intact = [&](const SimState& state) { return state.vehicles[0].collision.count == collisions; };
  loop.AdvanceWhile(dynamics_steps, [&](const SimState& state, std::span<const SimEvent>) { return intact(state); });
  const bool crashed = !intact(loop.state());

  const Vehicle& drone = loop.state().vehicles[0];
  const TargetSight sight = Look(i, slot);
  const NavigationScore score = world_.Score(lane.episode, before, drone.motion.X_WB.p, drone.clearance, crashed, sight);
  ++steps_[i];
  reward_[i] = static_cast<float>(score.reward);
  reached_[i] = score.reached;
  crashed_[i] = score.crashed;
  terminated_[i] = score.reached || score.crashed;
  truncated_[i] = !terminated_[i] && static_cast<double>(lane.loop->state().t_ns) * 1e-9 >= world_.task().seconds - 1e-9;
  lane.ended = terminated_[i] || truncated_[i];
  FillState(i);
}

TargetSight VectorEnvironment::Look(size_t i, Slot& slot) {
  const Lane& lane = lanes_[i];
  const bool search = world_.task().kind == NavigationKind::kSearch;
  PanoramicRig rig{options_.picture, Equirectangular{options_.width, options_.height}};
  if (!options_.rgb) rig.tier = Tier::kLabels;
  rig.products = {
      .rgb = options_.rgb, .range = options_.range || search, .semantic = options_.semantic, .entity = options_.entity || search};
  const bool anything = options_.rgb || rig.products.range || rig.products.semantic || rig.products.entity;
  if (!anything) return {};
  if (model_->people) rig.state = SceneStateOf(*model_, lane.loop->state(), 0);
  CaptureRig(rig, lane.loop->state().vehicles[0].motion, lane.loop->state().t_ns, *slot.renderer, slot.capture);
  const Frame& frame = slot.capture.frame;
  CopyRow(frame.rgb, i, rgb_);
  CopyRow(frame.range, i, range_);
  CopyRow(frame.semantic, i, semantic_);
  CopyRow(frame.entity, i, entity_);

  // The target, as the panorama shows it.
  TargetSight sight;
  if (!search) return sight;
  const auto entities = frame.entity.pixels();
  for (size_t k = 0; k < entities.size(); ++k) {
    if (entities[k] != lane.episode.target) continue;
    const double range = frame.range.pixels()[k];
    sight.range = sight.pixels == 0 ? range : std::min(sight.range, range);
    ++sight.pixels;
  }
  return sight;
}

void VectorEnvironment::FillState(size_t i) {
  const Lane& lane = lanes_[i];
  const Vehicle& drone = lane.loop->state().vehicles[0];
  const Mat3d& R_WB = drone.motion.X_WB.R;
  const bool search = world_.task().kind == NavigationKind::kSearch;
  const Vec3d ahead = R_WB.column(0);
  const double heading = std::atan2(ahead.y, ahead.x);
  const Mat3d R_LW = RotationZ(-heading);
  const Vec3d way = lane.episode.goal_W - drone.motion.X_WB.p;

  float* out = &state_[i * StateColumns::kCount];
  Put(search ? Vec3d{} : R_LW * way, out + StateColumns::kGoal);
  Put(R_LW * drone.motion.v_WB, out + StateColumns::kVelocity);
  Put(R_WB.row(2), out + StateColumns::kUp);
  Put(drone.motion.w_WB_B, out + StateColumns::kRates);
  out[StateColumns::kClearance] = drone.clearance;
  const double used = static_cast<double>(lane.loop->state().t_ns) * 1e-9 / world_.task().seconds;
  out[StateColumns::kTimeLeft] = static_cast<float>(std::max(0.0, 1 - used));
  out[StateColumns::kHeading] = static_cast<float>(std::cos(heading));
  out[StateColumns::kHeading + 1] = static_cast<float>(std::sin(heading));
  out[StateColumns::kTarget] = search ? static_cast<float>(world_.tracer().scene().entity(lane.episode.target).category) : 0;
  distance_[i] = static_cast<float>(Norm(way));
}

}  // namespace airsim360
