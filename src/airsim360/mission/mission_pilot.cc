#include <algorithm>

#include "airsim360/mission/pilot_leaves.h"

namespace airsim360 {

using behaviour::Status;
using behaviour::TreeRun;

struct MissionPilot::Impl {
  explicit Impl(std::shared_ptr<const Mission> of) : mission(std::move(of)) { run.Start(mission->tree()); }

  void Observe(const Vehicle& drone, std::span<const SimEvent> happened);
  void Tick(const SimModel& model, const SimState& state, std::vector<SimCommand>& commands);

  std::shared_ptr<const Mission> mission;
  std::shared_ptr<const RayTracer> planned_in;  // where `planner` plans
  std::optional<MissionPlanner> planner;
  mutable std::mutex mutex;  // of what follows
  TreeRun run;
  MissionMemory memory;
  MissionProgress::Result result = MissionProgress::Result::kRunning;
  bool begun = false;
  int64_t next_ns = 0, now_ns = 0;
};

// A command that the mission did not give takes the drone from it.
void MissionPilot::Impl::Observe(const Vehicle& drone, std::span<const SimEvent> happened) {
  for (const SimEvent& event : happened) {
    if (event.vehicle != mission->vehicle || event.kind != SimEvent::Kind::kCommandRefused) continue;
    memory.refused = event.text.empty() ? "no reason given" : event.text;
  }
  DroneInHand& hand = memory.hand;
  if (!hand.commanded) return;
  if (!hand.command_id) hand.command_id = drone.command.id;
  hand.taken |= *hand.command_id != drone.command.id;
}

void MissionPilot::Impl::Tick(const SimModel& model, const SimState& state, std::vector<SimCommand>& commands) {
  // Things may have been moved.
  if (planned_in != model.tracer) planner.emplace(planned_in = model.tracer);
  PilotLeaves leaves(*mission, model, state, *planner, memory, commands);
  const Status status = TickTree(mission->tree(), run, state.t_ns, leaves);
  if (status == Status::kRunning) return;
  result = status == Status::kFailure ? MissionProgress::Result::kFailure : MissionProgress::Result::kSuccess;
}

MissionPilot::MissionPilot(std::shared_ptr<const Mission> mission) : impl_(std::make_unique<Impl>(std::move(mission))) {}
MissionPilot::~MissionPilot() = default;

void MissionPilot::BeforeStep(const SimModel& model, const SimState& state, std::span<const SimEvent> happened,
                              std::vector<SimCommand>& commands) {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->result != MissionProgress::Result::kRunning || impl_->mission->vehicle >= model.drones.size()) return;
  if (!impl_->begun) {
    impl_->begun = true;
    impl_->memory.start_ns = impl_->next_ns = state.t_ns;
  } else {
    impl_->Observe(state.vehicles[impl_->mission->vehicle], happened);
  }
  impl_->now_ns = state.t_ns;
  if (state.t_ns < impl_->next_ns) return;
  impl_->next_ns = state.t_ns + kMissionTickNs;
  impl_->Tick(model, state, commands);
}

const Mission& MissionPilot::mission() const { return *impl_->mission; }

bool MissionPilot::done() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->result != MissionProgress::Result::kRunning;
}

MissionProgress MissionPilot::progress() const {
  const std::lock_guard lock(impl_->mutex);
  MissionProgress progress;
  progress.result = impl_->result;
  progress.log = impl_->memory.log;
  progress.captures = impl_->memory.captures.size();
  progress.seconds = 1e-9 * static_cast<double>(impl_->now_ns - impl_->memory.start_ns);
  const auto& nodes = impl_->mission->tree().nodes;
  for (size_t i = 0; i < nodes.size(); ++i)
    if (impl_->run.nodes[i].status == Status::kRunning) progress.active.push_back({nodes[i].line, nodes[i].order, nodes[i].label});
  const Mission& mission = *impl_->mission;
  progress.board = behaviour::Board(mission.tree(), mission.trees, impl_->run.slots,
                                    [&](char, const behaviour::Value& value) { return NameOfThing(*mission.world.model, value); });
  return progress;
}

std::vector<MissionCapture> MissionPilot::CapturesFrom(size_t first) const {
  const std::lock_guard lock(impl_->mutex);
  const auto& captures = impl_->memory.captures;
  return {captures.begin() + static_cast<std::ptrdiff_t>(std::min(first, captures.size())), captures.end()};
}

}  // namespace airsim360
