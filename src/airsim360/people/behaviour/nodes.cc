#include "airsim360/people/behaviour/nodes.h"

namespace airsim360::internal {
namespace {

using enum Node;
using enum NodeClass;

const std::vector<NodeInfo>& Table() {
  static const std::vector<NodeInfo> table = {
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
      {kWanderTo, "WanderTo", kAction,
       {{"area", 'a', "", false, "name of an area; empty: their own"}, {"speed", 'n', "0", false, "m/s; 0: as they like"}},
       "walks to a place drawn from an area; taken up again where it was broken off"},
      {kGoTo, "GoTo", kAction, {{"point", 'p', nullptr, false, "x;y or x;y;z"}, {"speed", 'n', "0"}}, "walks to a point"},
      {kGoToPlace, "GoToPlace", kAction,
       {{"kind", 'k', nullptr, false, "bench, shop, food, sight or stop"}, {"distance", 'n', "60", false, "metres"}},
       "walks to a free place nearby and faces it (a bench: turns its back to it)"},
      {kSetState, "SetState", kAction,
       {{"state", 's', nullptr}, {"min_s", 'n', "-1"}, {"max_s", 'n', "-1"}, {"wait", 't', "true", false, "until it ends"}},
       "enters a state, if the state machine lets them"},
      {kEndState, "EndState", kAction, {}, "back to the state that follows"},
      {kMeet, "Meet", kAction,
       {{"distance", 'n', "3"}, {"chance", 'n', "0.3"}, {"cooldown_s", 'n', "60"}, {"person", 'o', "", true}},
       "greets someone free who is near and waits for the answer"},
      {kAnswerGreeting, "AnswerGreeting", kAction, {{"chance", 'n', "0.6"}, {"person", 'o', "", true}},
       "accepts or declines a greeting that waits"},
      {kChat, "Chat", kAction, {{"min_s", 'n', "8"}, {"max_s", 'n', "40"}}, "talks with the group until somebody says bye"},
      {kSend, "Send", kAction,
       {{"message", 'm', nullptr}, {"to", 't', "radius", false, "person, group or radius"}, {"person", 'p', ""}, {"distance", 'n', "10"}},
       "sends a message"},
      {kWaitMessage, "WaitMessage", kAction, {{"message", 'm', nullptr}, {"timeout_s", 'n', "5"}, {"person", 'o', "", true}},
       "until a message comes"},
      {kFacePerson, "FacePerson", kAction, {{"person", 'p', nullptr}}, "turns towards someone"},
      {kLookAtDrone, "LookAtDrone", kAction, {{"distance", 'n', "12"}, {"min_s", 'n', "3"}, {"max_s", 'n', "8"}},
       "stops, looks up at the nearest drone; some point at it or take a photo"},
      {kStepAway, "StepAway", kAction, {{"distance", 'n', "5"}}, "walks away from the nearest drone until it is that far"},
      {kChance, "Chance", kCondition, {{"p", 'n', nullptr}}, "true with probability p"},
      {kStateIs, "StateIs", kCondition, {{"state", 's', nullptr}}, ""},
      {kDroneWithin, "DroneWithin", kCondition, {{"distance", 'n', nullptr}}, "metres from the head"},
      {kPersonWithin, "PersonWithin", kCondition, {{"distance", 'n', nullptr}, {"person", 'o', "", true}}, "nearest person"},
      {kMessageWaiting, "MessageWaiting", kCondition, {{"message", 'm', nullptr}}, ""},
      {kEvery, "Every", kCondition, {{"seconds", 'n', nullptr}, {"first_s", 'n', "-1", false, "-1: as seconds"}},
       "true once, then not for that long; the first time within first_s, at random"},
  };
  return table;
}

}  // namespace

std::span<const NodeInfo> NodeInfos() { return Table(); }

const NodeInfo* NodeByName(std::string_view name) {
  for (const NodeInfo& info : Table())
    if (name == info.name) return &info;
  return nullptr;
}

std::vector<std::string> NodeNames() {
  std::vector<std::string> names = {"SubTree", "Action", "Condition", "Control", "Decorator"};
  for (const NodeInfo& info : Table()) names.push_back(info.name);
  return names;
}

std::string TreeNodesModel() {
  std::string xml = "  <TreeNodesModel>\n";
  for (const NodeInfo& info : Table()) {
    if (info.node < kWanderTo) continue;
    const std::string tag = info.of == kAction ? "Action" : "Condition";
    xml += "    <" + tag + " ID=\"" + info.name + "\">\n";
    for (const PortInfo& port : info.ports)
      xml += std::string("      <") + (port.output ? "output_port" : "input_port") + " name=\"" + port.name + "\"" +
             (port.fallback && *port.fallback ? " default=\"" + std::string(port.fallback) + "\"" : "") + ">" + port.help +
             (port.output ? "</output_port>\n" : "</input_port>\n");
    xml += "    </" + tag + ">\n";
  }
  return xml + "  </TreeNodesModel>\n";
}

}  // namespace airsim360::internal
