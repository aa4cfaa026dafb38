#include "airsim360/behaviour/nodes.h"

#include <algorithm>

#include "airsim360/behaviour/xml.h"

namespace airsim360::behaviour {
namespace {

using enum Node;
using enum NodeClass;

// Of every palette. `If` and `Retry` are other names, which BehaviorTree.CPP does not have.
std::vector<NodeInfo> CommonNodes() {
  return {
      {kSequence, "Sequence", kControl, {}, "children in order until one fails"},
      {kSequenceWithMemory, "SequenceWithMemory", kControl, {}, "the same, but a failed child is tried again first"},
      {kReactiveSequence, "ReactiveSequence", kControl, {}, "from the first child at every tick"},
      {kFallback, "Fallback", kControl, {}, "children in order until one succeeds"},
      {kReactiveFallback, "ReactiveFallback", kControl, {}, "from the first child at every tick"},
      {kParallel, "Parallel", kControl, {{"success_count", 'n', "-1"}, {"failure_count", 'n', "1"}}, "all at once"},
      {kParallelAll, "ParallelAll", kControl, {{"max_failures", 'n', "1"}}, "all at once, to the end of each"},
      {kIfThenElse, "IfThenElse", kControl, {}, "the second child if the first succeeds, else the third"},
      {kWhileDoElse, "WhileDoElse", kControl, {}, "the same, the first child being asked at every tick"},
      {kInverter, "Inverter", kDecorator, {}, "success <-> failure"},
      {kForceSuccess, "ForceSuccess", kDecorator, {}, ""},
      {kForceFailure, "ForceFailure", kDecorator, {}, ""},
      {kRepeat, "Repeat", kDecorator, {{"num_cycles", 'n', nullptr}}, "-1 = for ever"},
      {kRetryUntilSuccessful, "RetryUntilSuccessful", kDecorator, {{"num_attempts", 'n', nullptr}}, "-1 = for ever"},
      {kKeepRunningUntilFailure, "KeepRunningUntilFailure", kDecorator, {}, ""},
      {kTimeout, "Timeout", kDecorator, {{"msec", 'n', nullptr}}, "fails, and halts its child, after that time"},
      {kDelay, "Delay", kDecorator, {{"delay_msec", 'n', nullptr}}, ""},
      {kRunOnce, "RunOnce", kDecorator, {{"then_skip", 't', "true"}}, ""},
      {kAlwaysSuccess, "AlwaysSuccess", kAction, {}, ""},
      {kAlwaysFailure, "AlwaysFailure", kAction, {}, ""},
      {kSleep, "Sleep", kAction, {{"msec", 'n', nullptr}}, ""},
      {kSetBlackboard, "SetBlackboard", kAction, {{"value", 't', nullptr}, {"output_key", 'o', nullptr, true}}, ""},
      {kIfThenElse, "If", kControl, {}, "another name of IfThenElse"},
      {kRetryUntilSuccessful, "Retry", kDecorator, {{"num_attempts", 'n', nullptr}}, "another name of RetryUntilSuccessful"},
  };
}

bool IsOurs(const NodeInfo& info) {
  return info.node >= kFirstLeaf || std::string_view(info.name) == "If" || std::string_view(info.name) == "Retry";
}

}  // namespace

Palette::Palette(std::vector<NodeInfo> leaves) : nodes_(CommonNodes()) {
  nodes_.insert(nodes_.end(), std::make_move_iterator(leaves.begin()), std::make_move_iterator(leaves.end()));
}

const NodeInfo* Palette::Find(std::string_view name) const {
  const auto found = std::ranges::find_if(nodes_, [&](const NodeInfo& info) { return name == info.name; });
  return found == nodes_.end() ? nullptr : &*found;
}

std::vector<std::string> Palette::Names() const {
  std::vector<std::string> names = {"SubTree", "Action", "Condition", "Control", "Decorator"};
  for (const NodeInfo& info : nodes_) names.push_back(info.name);
  return names;
}

std::string Palette::ModelXml() const {
  std::string xml = "  <TreeNodesModel>\n";
  const auto add = [&](std::initializer_list<std::string_view> parts) {
    for (const std::string_view part : parts) xml += part;
  };
  for (const NodeInfo& info : nodes_) {
    if (!IsOurs(info)) continue;
    const char* const tag = kNodeClassNames[static_cast<size_t>(info.of)];
    add({"    <", tag, " ID=\"", info.name, "\">\n"});
    for (const PortInfo& port : info.ports) {
      const char* const port_tag = port.output ? "output_port" : "input_port";
      add({"      <", port_tag, " name=\"", port.name, "\""});
      if (port.fallback && *port.fallback) add({" default=\"", EscapeXml(port.fallback), "\""});
      add({">", EscapeXml(port.help), "</", port_tag, ">\n"});
    }
    add({"    </", tag, ">\n"});
  }
  return xml + "  </TreeNodesModel>\n";
}

}  // namespace airsim360::behaviour
