#include "airsim360/sim/sim_loop.h"

#include <algorithm>

namespace airsim360 {

SimLoop::SimLoop(std::shared_ptr<const SimModel> model) : model_(std::move(model)), state_(StartState(*model_)) {}
SimLoop::SimLoop(std::shared_ptr<const SimModel> model, SimState start) : model_(std::move(model)), state_(std::move(start)) {}

void SimLoop::Post(SimCommand command) {
  const std::lock_guard lock(mutex_);
  CheckCommand(*model_, state_, command);
  waiting_.push_back(std::move(command));
}

void SimLoop::StepOnce() {
  for (const auto& pilot : pilots_) pilot->BeforeStep(*model_, state_, happened_, waiting_);
  if (recorder_) recorder_->Before(state_, waiting_);
  const size_t before = events_.size();
  Step(*model_, waiting_, state_, &events_);
  if (!pilots_.empty()) happened_.assign(events_.begin() + static_cast<std::ptrdiff_t>(before), events_.end());
  waiting_.clear();
  if (recorder_) recorder_->After(state_);
  if (events_.size() > kMostEvents) events_.erase(events_.begin(), events_.end() - kMostEvents);
}

void SimLoop::Advance(int64_t steps) {
  // The lock is given back between steps, so that others are not kept waiting.
  for (int64_t i = 0; i < steps; ++i) {
    const std::lock_guard lock(mutex_);
    StepOnce();
  }
}

int64_t SimLoop::AdvanceWhile(int64_t steps, const AfterStep& go_on) {
  for (int64_t i = 0; i < steps; ++i) {
    const std::lock_guard lock(mutex_);
    const size_t before = events_.size();
    StepOnce();
    const bool further = go_on(state_, std::span(events_).subspan(std::min(before, events_.size())));
    events_.resize(std::min(before, events_.size()));
    if (!further) return i + 1;
  }
  return steps;
}

SimState& SimLoop::Edit() {
  const std::lock_guard lock(mutex_);
  recorder_.reset();
  return state_;
}

void SimLoop::SetModel(std::shared_ptr<const SimModel> model) {
  const std::lock_guard lock(mutex_);
  recorder_.reset();
  model_ = std::move(model);
}

int64_t SimLoop::AdvanceUnlessPaused(int64_t steps) {
  for (int64_t i = 0; i < steps; ++i) {
    const std::lock_guard lock(mutex_);
    if (allowed_ == 0) return i;
    if (allowed_ > 0) --allowed_;
    StepOnce();
  }
  return steps;
}

void SimLoop::Attach(std::shared_ptr<SimPilot> pilot) {
  const std::lock_guard lock(mutex_);
  if (pilots_.empty()) happened_.clear();
  pilots_.push_back(std::move(pilot));
}

void SimLoop::Detach(const SimPilot* pilot) {
  const std::lock_guard lock(mutex_);
  std::erase_if(pilots_, [&](const auto& attached) { return attached.get() == pilot; });
}

std::shared_ptr<const SimState> SimLoop::Snapshot() const {
  const std::lock_guard lock(mutex_);
  return std::make_shared<const SimState>(state_);
}

void SimLoop::Restore(const SimState& snapshot) {
  const std::lock_guard lock(mutex_);
  state_ = snapshot;
  waiting_.clear();
  pilots_.clear();
  recorder_.reset();
}

int64_t SimLoop::t_ns() const {
  const std::lock_guard lock(mutex_);
  return state_.t_ns;
}

std::vector<SimEvent> SimLoop::TakeEvents() {
  const std::lock_guard lock(mutex_);
  return std::exchange(events_, {});
}

void SimLoop::Pause() {
  const std::lock_guard lock(mutex_);
  allowed_ = 0;
}

void SimLoop::Continue(int64_t steps) {
  const std::lock_guard lock(mutex_);
  allowed_ = steps > 0 ? steps : -1;
}

bool SimLoop::paused() const {
  const std::lock_guard lock(mutex_);
  return allowed_ == 0;
}

void SimLoop::StartRecording(std::string note, int64_t hash_every) {
  const std::lock_guard lock(mutex_);
  recorder_.emplace(*model_, state_, std::move(note), hash_every);
}

std::optional<Recording> SimLoop::StopRecording() {
  const std::lock_guard lock(mutex_);
  if (!recorder_) return std::nullopt;
  const Recording recording = recorder_->Finish(state_);
  recorder_.reset();
  return recording;
}

}  // namespace airsim360
