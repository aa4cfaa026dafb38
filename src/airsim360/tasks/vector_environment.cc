#include "airsim360/tasks/vector_environment.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/state_hash.h"
#include "airsim360/sensors/rig.h"

namespace airsim360 {
namespace {

constexpr int64_t kStepNs = 2'000'000;  // of the dynamics; the autopilot's period
constexpr int kMostEnvironments = 65536;

void CheckOptions(const VectorEnvironmentOptions& o) {
  const auto refuse = [](const std::string& what) { throw InputError("environment." + what); };
  if (o.count < 1 || o.count > kMostEnvironments)
    refuse("count: " + std::to_string(o.count) + " is not in 1 ... " + std::to_string(kMostEnvironments));
  if (o.height < 2 || o.height > 2048 || o.width != 2 * o.height)
    refuse("size: " + std::to_string(o.width) + "x" + std::to_string(o.height) +
           " is not that of a panorama: width = 2 height, height in 2 ... 2048");
  const double steps = o.period * 1e9 / static_cast<double>(kStepNs);
  if (!(o.period > 0 && o.period <= 10) || std::fabs(steps - std::round(steps)) > 1e-6)
    refuse("period: " + std::to_string(o.period) + " s is not a multiple of 0.002 s up to 10 s");
  const auto positive = [&](const char* name, double value) {
    if (!(value > 0 && value <= 1000))
      refuse(std::string(name) + ": " + std::to_string(value) + " is not in 0 ... 1000");
  };
  positive("max_speed", o.max_speed);
  positive("max_turn", o.max_turn);
  positive("max_rate", o.max_rate);
}

std::shared_ptr<const SimModel> MakeModel(std::shared_ptr<const RayTracer> tracer, const DroneModel& drone) {
  auto model = std::make_shared<SimModel>();
  model->tracer = std::move(tracer);
  model->dt_ns = kStepNs;
  DroneSetup setup{.name = "drone", .model = drone};
  setup.sensors = SensorSet{};  // panoramas and state are all that is sensed
  setup.airborne = true;
  model->drones.push_back(std::make_shared<const SimDrone>(std::move(setup), model->dt_ns));
  return model;
}

double Clamped(float value) { return std::clamp(static_cast<double>(value), -1.0, 1.0); }

void Put(Vec3d v, float* out) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(v[i]);
}

template <class Pixel>
void CopyRow(const Image<Pixel>& image, size_t i, std::vector<Pixel>& rows) {
  if (!rows.empty())
    std::ranges::copy(image.pixels(), rows.begin() + static_cast<ptrdiff_t>(i * image.size()));
}

}  // namespace

ActionLevel ParseActionLevel(std::string_view name) {
  const std::vector<std::string> names(std::begin(kActionLevelNames), std::end(kActionLevelNames));
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) throw InputError(UnknownChoiceMessage("action", name, names));
  return static_cast<ActionLevel>(found - names.begin());
}

struct VectorEnvironment::Slot {
  std::unique_ptr<Renderer> renderer;
  Capture capture;
};

VectorEnvironment::VectorEnvironment(std::shared_ptr<const RayTracer> tracer, const NavigationTask& task,
                                     const VectorEnvironmentOptions& options)
    : options_((CheckOptions(options), options)),
      world_(tracer, task),
      model_(MakeModel(tracer, options.drone)) {
  const auto count = static_cast<size_t>(options_.count);
  const size_t pixels = count * static_cast<size_t>(options_.width) * static_cast<size_t>(options_.height);
  options_.rgb = options_.rgb && options_.tier != Tier::kLabels;
  if (options_.rgb) rgb_.resize(pixels);
  if (options_.range) range_.resize(pixels);
  if (options_.semantic) semantic_.resize(pixels);
  if (options_.entity) entity_.resize(pixels);
  state_.resize(count * StateColumns::kCount);
  reward_.resize(count);
  distance_.resize(count);
  for (auto* flags : {&terminated_, &truncated_, &reached_, &crashed_}) flags->resize(count);
  steps_.resize(count);
  lanes_.resize(count);

  const Tier tier = options_.rgb ? options_.tier : Tier::kLabels;
  for (int i = 0; i < std::min(options_.count, ThreadCount()); ++i) {
    slots_.push_back(std::make_unique<Slot>());
    slots_.back()->renderer = MakeCpuRenderer(tracer, {.tier = tier});
  }
  Reset(options_.seed);
}

VectorEnvironment::~VectorEnvironment() = default;

int VectorEnvironment::action_size() const {
  return options_.action == ActionLevel::kRotors ? static_cast<int>(options_.drone.rotors.size()) : 4;
}

template <class Body>
void VectorEnvironment::ForAll(const Body& body) {
  // Environments are handed out one by one; which slot takes one makes no difference to its bytes.
  std::atomic<size_t> next = 0;
  ParallelFor(static_cast<int64_t>(slots_.size()), [&](int64_t s) {
    for (size_t i = next++; i < lanes_.size(); i = next++) body(i, *slots_[static_cast<size_t>(s)]);
  });
}

void VectorEnvironment::Begin(size_t i) {
  Lane& lane = lanes_[i];
  lane.episode = world_.Sample(seed_, i, lane.number);
  lane.ended = false;
  lane.state = {};
  lane.state.vehicles.push_back(DroneAt(*model_, lane.state, 0, lane.episode.X_WB, true));
  reward_[i] = 0;
  steps_[i] = 0;
  terminated_[i] = truncated_[i] = reached_[i] = crashed_[i] = 0;
}

void VectorEnvironment::Reset(std::optional<uint64_t> seed) {
  if (seed) seed_ = *seed;
  ForAll([&](size_t i, Slot& slot) {
    lanes_[i].number = seed ? 0 : lanes_[i].number + 1;
    Begin(i);
    Look(i, slot);
    FillState(i);
  });
}

Command VectorEnvironment::CommandOf(std::span<const float> a) const {
  switch (options_.action) {
    case ActionLevel::kVelocity: {
      const Vec3d v = options_.max_speed * Vec3d{Clamped(a[0]), Clamped(a[1]), Clamped(a[2])};
      return VelocityCommand{
          .v = v, .body_heading = true, .yaw = {YawTarget::Mode::kRate, options_.max_turn * Clamped(a[3])}};
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

void VectorEnvironment::Step(std::span<const float> actions) {
  const auto size = static_cast<size_t>(action_size());
  if (actions.size() != lanes_.size() * size) {
    throw InputError("actions: " + std::to_string(actions.size()) + " numbers instead of " +
                     std::to_string(lanes_.size()) + " x " + std::to_string(size));
  }
  for (size_t k = 0; k < actions.size(); ++k) {
    if (!std::isfinite(actions[k])) {
      throw InputError("actions[" + std::to_string(k / size) + "][" + std::to_string(k % size) +
                       "] is not a finite number");
    }
  }
  for (size_t i = 0; i < lanes_.size() && !options_.auto_reset; ++i) {
    if (lanes_[i].ended) throw InputError("environment " + std::to_string(i) + " has ended: reset it first");
  }
  ForAll([&](size_t i, Slot& slot) { StepLane(i, actions.subspan(i * size, size), slot); });
}

void VectorEnvironment::StepLane(size_t i, std::span<const float> action, Slot& slot) {
  Lane& lane = lanes_[i];
  if (lane.ended) {
    ++lane.number;
    Begin(i);
    Look(i, slot);
    FillState(i);
    return;
  }

  // One command, held for the whole step; a crash ends it early.
  const Vec3d before = lane.state.vehicles[0].motion.X_WB.p;
  const uint64_t collisions = lane.state.vehicles[0].collision.count;
  std::vector<SimCommand> commands = {{0, FlightCommand{CommandOf(action)}}};
  const auto dynamics_steps = std::llround(options_.period * 1e9 / static_cast<double>(kStepNs));
  bool crashed = false;
  for (int64_t s = 0; s < dynamics_steps && !crashed; ++s) {
    airsim360::Step(*model_, commands, lane.state);
    commands.clear();
    crashed = lane.state.vehicles[0].collision.count != collisions;
  }

  const Vehicle& drone = lane.state.vehicles[0];
  const TargetSight sight = Look(i, slot);
  const NavigationScore score =
      world_.Score(lane.episode, before, drone.motion.X_WB.p, drone.clearance, crashed, sight);
  ++steps_[i];
  reward_[i] = static_cast<float>(score.reward);
  reached_[i] = score.reached;
  crashed_[i] = score.crashed;
  terminated_[i] = score.reached || score.crashed;
  truncated_[i] =
      !terminated_[i] && static_cast<double>(lane.state.t_ns) * 1e-9 >= world_.task().seconds - 1e-9;
  lane.ended = terminated_[i] || truncated_[i];
  FillState(i);
}

TargetSight VectorEnvironment::Look(size_t i, Slot& slot) {
  const Lane& lane = lanes_[i];
  const bool search = world_.task().kind == NavigationKind::kSearch;
  PanoramicRig rig;
  rig.camera = Equirectangular{options_.width, options_.height};
  rig.pano_frame = options_.level ? PanoFrame::kLevel : PanoFrame::kBody;
  rig.tier = options_.rgb ? options_.tier : Tier::kLabels;
  rig.products = {.rgb = options_.rgb,
                  .range = options_.range || search,
                  .semantic = options_.semantic,
                  .entity = options_.entity || search};
  const bool anything = options_.rgb || rig.products.range || rig.products.semantic || rig.products.entity;
  if (!anything) return {};
  CaptureRig(rig, lane.state.vehicles[0].motion, lane.state.t_ns, *slot.renderer, slot.capture);
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
  const Vehicle& drone = lane.state.vehicles[0];
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
  const double used = static_cast<double>(lane.state.t_ns) * 1e-9 / world_.task().seconds;
  out[StateColumns::kTimeLeft] = static_cast<float>(std::max(0.0, 1 - used));
  out[StateColumns::kHeading] = static_cast<float>(std::cos(heading));
  out[StateColumns::kHeading + 1] = static_cast<float>(std::sin(heading));
  out[StateColumns::kTarget] =
      search ? static_cast<float>(world_.tracer().scene().entity(lane.episode.target).category) : 0;
  distance_[i] = static_cast<float>(Norm(way));
}

uint64_t VectorEnvironment::Hash() const {
  StateHasher hasher;
  for (const Lane& lane : lanes_) hasher.Add(HashState(lane.state));
  return hasher.hash();
}

}  // namespace airsim360
