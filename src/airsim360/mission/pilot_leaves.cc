#include "airsim360/mission/pilot_leaves.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ranges>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

using behaviour::NodeMemory;
using behaviour::Status;
using behaviour::Tree;
using behaviour::TreeRun;
using behaviour::Value;

constexpr size_t kMostLines = 200;  // of the log

bool IsFlying(MissionNode node) { return node <= MissionNode::kLook; }

}  // namespace

void PilotLeaves::Note(const Node& node, const std::string& what) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f s, line %d, ", Seconds(memory_.start_ns), node.line);
  if (memory_.log.size() == kMostLines) memory_.log.erase(memory_.log.begin());
  memory_.log.push_back(text + node.label + ": " + what);
}

double PilotLeaves::Number(const Node& node, size_t i) const {
  const Value& value = PortOf(mission_.tree(), node, *run_, i);
  const behaviour::PortInfo& port = node.info->ports[i];
  if (value.kind != Value::Kind::kNumber) throw InputError(std::string(port.name) + ": the key holds no number");
  if (const std::string problem = NumberProblem(port.kind, value.number); !problem.empty())
    throw InputError(std::string(port.name) + ": " + problem);
  return value.number;
}

std::string PilotLeaves::Text(const Node& node, size_t i) const {
  const Value& value = PortOf(mission_.tree(), node, *run_, i);
  const bool has_text =
      value.kind == Value::Kind::kText || (value.kind == Value::Kind::kNumber && value.index < mission_.trees.texts.size());
  return has_text ? mission_.trees.texts[value.index] : std::string();
}

Value PilotLeaves::Named(const Node& node, size_t i) const {
  const Value& value = PortOf(mission_.tree(), node, *run_, i);
  if (value.kind == Value::Kind::kText) return ParseThing(mission_.trees.texts[value.index], &mission_.world);
  return value;
}

ThingNow PilotLeaves::Thing(const Node& node, size_t i) const {
  const auto thing = FindThing(model_, state_, Named(node, i));
  if (!thing) throw InputError(std::string(node.info->ports[i].name) + ": it is not in the world now");
  return *thing;
}

Status PilotLeaves::Tick(const Tree&, const Node& node, NodeMemory& memory, TreeRun& run) {
  run_ = &run;
  try {
    return Act(node, memory);
  } catch (const InputError& error) {
    Note(node, error.what());
    return Status::kFailure;
  }
}

Status PilotLeaves::Act(const Node& node, NodeMemory& memory) {
  const auto kind = static_cast<MissionNode>(node.node);
  const bool fresh = memory.status != Status::kRunning;
  if (IsFlying(kind)) return Fly(node, fresh);
  switch (kind) {
    case MissionNode::kGimbal:
      return Gimbal(node, memory, fresh);
    case MissionNode::kCapture:
      return Capture(node, memory, fresh);
    case MissionNode::kWait:
      if (fresh) memory.t_ns = state_.t_ns;
      return Seconds(memory.t_ns) >= Number(node, 0) ? Status::kSuccess : Status::kRunning;
    case MissionNode::kNear: {
      const auto thing = FindThing(model_, state_, Named(node, 0));
      return Yes(thing && DistanceTo(*thing, drone_.motion.X_WB.p) <= Number(node, 1));
    }
    case MissionNode::kBatteryAbove:
      return Yes(drone_.drone.charge > Number(node, 0));
    case MissionNode::kTimeAfter:
      return Yes(Seconds(memory_.start_ns) >= Number(node, 0));
    default:
      return Sees(node);
  }
}

// A node that is broken off leaves the drone hovering.
void PilotLeaves::Halt(const Tree&, const Node& node, NodeMemory&, TreeRun&) {
  if (hand_.owner != &node) return;
  const auto kind = static_cast<MissionNode>(node.node);
  if (!hand_.taken && Flies() && kind != MissionNode::kLook) Command(HoverCommand{});
  hand_.owner = nullptr;
}

Status PilotLeaves::Gimbal(const Node& node, NodeMemory& memory, bool fresh) {
  constexpr double kNear = 0.02, kLongest = 5;  // rad, seconds: a joint may be at its limit
  const auto i = static_cast<size_t>(Number(node, 3));
  const auto& gimbals = model_.drones[mission_.vehicle]->setup().sensors.gimbals;
  if (i >= gimbals.size()) throw InputError("gimbal " + std::to_string(i) + ": the drone has " + std::to_string(gimbals.size()));
  const double degree = M_PI / 180;
  const GimbalAngles wanted{Number(node, 1) * degree, Number(node, 0) * degree, Number(node, 2) * degree};
  if (fresh) {
    memory.t_ns = state_.t_ns;
    commands_.push_back({mission_.vehicle, GimbalCommand{i, wanted}});
    return Status::kRunning;
  }
  const GimbalAngles joints = WantedJoints(gimbals[i].spec, wanted, drone_.motion.X_WB.R), now = drone_.sensors.gimbals[i].joints;
  const auto far = [](double a, double b) { return std::abs(std::remainder(a - b, 2 * M_PI)); };
  const bool there = std::max({far(joints.yaw, now.yaw), far(joints.pitch, now.pitch), far(joints.roll, now.roll)}) < kNear;
  return there || Seconds(memory.t_ns) > kLongest ? Status::kSuccess : Status::kRunning;
}

// Frame k is due k times `every_s` after the first.
Status PilotLeaves::Capture(const Node& node, NodeMemory& memory, bool fresh) {
  if (fresh) {
    memory.count = 0;
    memory.t_ns = state_.t_ns;
  }
  const auto count = static_cast<int32_t>(Number(node, 1));
  const double every = Number(node, 2);
  if (Seconds(memory.t_ns) + 1e-9 < every * memory.count) return Status::kRunning;
  if (memory_.captures.size() >= kMostMissionCaptures)
    throw InputError("the mission has " + std::to_string(kMostMissionCaptures) + " frames already");
  MissionCapture capture{
      Text(node, 0), {}, {.t_ns = state_.t_ns, .body = drone_.motion, .people = state_.people, .traffic = state_.traffic}};
  for (const std::string products = Text(node, 3); const auto part : std::views::split(products, ','))
    capture.products.emplace_back(part.begin(), part.end());
  const bool is_there =
      std::ranges::any_of(memory_.captures, [&](const MissionCapture& c) { return c.shot.t_ns == state_.t_ns && c.to == capture.to; });
  if (!is_there) memory_.captures.push_back(std::move(capture));
  return ++memory.count >= count ? Status::kSuccess : Status::kRunning;
}

Status PilotLeaves::Sees(const Node& node) {
  const Value& value = PortOf(mission_.tree(), node, *run_, 0);
  const Vec3d eye = drone_.motion.X_WB.p;
  const double reach = Number(node, 1);
  std::optional<Value> seen;
  if (const auto thing = FindThing(model_, state_, value)) {
    if (DistanceTo(*thing, eye) <= reach && IsInSight(*model_.tracer, *thing, eye)) seen = value;
  } else {
    seen = FindInSight(model_, state_, Text(node, 0), eye, reach);
  }
  if (seen) SetPort(mission_.tree(), node, *run_, 2, *seen);
  return Yes(seen.has_value());
}

}  // namespace airsim360
