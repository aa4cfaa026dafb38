#include "airsim360/tasks/gym/vector_environment.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/state_hash.h"

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
    if (!(value > 0 && value <= 1000)) refuse(std::string(name) + ": " + std::to_string(value) + " is not in 0 ... 1000");
  };
  if (o.rgb && o.picture.tier == Tier::kLabels)
    throw InputError("observations: 'rgb' needs light, which tier 'labels' has none of; did you mean tier 'fast'?");
  CheckPictureSettings(o.picture, Equirectangular{o.width, o.height});
  positive("max_speed", o.max_speed);
  positive("max_turn", o.max_turn);
  positive("max_rate", o.max_rate);
}

std::shared_ptr<const SimModel> MakeModel(Stage& stage, const DroneModel& drone) {
  auto model = std::make_shared<SimModel>(stage.Model(kStepNs));
  DroneSetup setup{.name = "drone", .model = drone};
  setup.sensors = SensorSet{};  // panoramas and state are all that is sensed
  setup.airborne = true;
  model->drones.push_back(std::make_shared<const SimDrone>(std::move(setup), model->dt_ns));
  return model;
}

}  // namespace

ActionLevel ParseActionLevel(std::string_view name) { return ParseChoice<ActionLevel>("action", name, kActionLevelNames); }

VectorEnvironment::VectorEnvironment(std::shared_ptr<Stage> stage, const NavigationTask& task, const VectorEnvironmentOptions& options)
    : options_((CheckOptions(options), options)),
      stage_(std::move(stage)),
      world_(stage_->solid(), task),
      model_(MakeModel(*stage_, options.drone)) {
  const auto count = static_cast<size_t>(options_.count);
  const size_t pixels = count * static_cast<size_t>(options_.width) * static_cast<size_t>(options_.height);
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

  const Tier tier = options_.rgb ? options_.picture.tier : Tier::kLabels;
  // A GPU holds the scene once; on the CPU every thread has a renderer.
  const int slots = ChoosesGpu(stage_->device()) ? 1 : std::min(options_.count, ThreadCount());
  for (int i = 0; i < slots; ++i) {
    slots_.push_back(std::make_unique<Slot>());
    slots_.back()->renderer = stage_->NewRenderer(tier);
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

void VectorEnvironment::Reset(std::optional<uint64_t> seed, std::span<const EpisodeWish> wishes) {
  if (wishes.size() > 1 && wishes.size() != lanes_.size()) {
    throw InputError("reset: " + std::to_string(wishes.size()) + " wishes for " + std::to_string(lanes_.size()) + " environments");
  }
  const uint64_t from = seed.value_or(seed_);
  std::vector<NavigationEpisode> episodes(lanes_.size());
  for (size_t i = 0; i < lanes_.size(); ++i) {
    episodes[i] = world_.Sample(from, i, seed ? 0 : lanes_[i].number + 1);
    if (!wishes.empty()) episodes[i] = world_.Wished(episodes[i], wishes[wishes.size() == 1 ? 0 : i]);
  }
  seed_ = from;
  ForAll([&](size_t i, Slot& slot) {
    lanes_[i].number = seed ? 0 : lanes_[i].number + 1;
    Begin(i, episodes[i]);
    Look(i, slot);
    FillState(i);
  });
}

void VectorEnvironment::Step(std::span<const float> actions) {
  const auto size = static_cast<size_t>(action_size());
  if (actions.size() != lanes_.size() * size) {
    throw InputError("actions: " + std::to_string(actions.size()) + " numbers instead of " + std::to_string(lanes_.size()) + " x " +
                     std::to_string(size));
  }
  for (size_t k = 0; k < actions.size(); ++k) {
    if (!std::isfinite(actions[k])) {
      throw InputError("actions[" + std::to_string(k / size) + "][" + std::to_string(k % size) + "] is not a finite number");
    }
  }
  for (size_t i = 0; i < lanes_.size() && !options_.auto_reset; ++i) {
    if (lanes_[i].ended) throw InputError("environment " + std::to_string(i) + " has ended: reset it first");
  }
  ForAll([&](size_t i, Slot& slot) { StepLane(i, actions.subspan(i * size, size), slot); });
}

uint64_t VectorEnvironment::Hash() const {
  StateHasher hasher;
  for (const Lane& lane : lanes_) hasher.Add(HashState(lane.loop->state()));
  return hasher.hash();
}

}  // namespace airsim360
