// The nodes that behaviour trees are made of: a tested subset of those of BehaviorTree.CPP 4, and the leaves by
// which people act. docs/guide/people_behaviour.md has the table.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360::internal {

enum class Node : uint8_t {
  // Controls
  kSequence, kSequenceWithMemory, kReactiveSequence, kFallback, kReactiveFallback, kParallel, kParallelAll,
  kIfThenElse, kWhileDoElse,
  // Decorators
  kInverter, kForceSuccess, kForceFailure, kRepeat, kRetryUntilSuccessful, kKeepRunningUntilFailure, kTimeout, kDelay,
  kRunOnce,
  // Actions that need no person
  kAlwaysSuccess, kAlwaysFailure, kSleep, kSetBlackboard,
  // Actions of people
  kWanderTo, kGoTo, kGoToPlace, kSetState, kEndState, kMeet, kAnswerGreeting, kChat, kSend, kWaitMessage, kFacePerson,
  kLookAtDrone, kStepAway,
  // Conditions
  kChance, kStateIs, kDroneWithin, kPersonWithin, kMessageWaiting, kEvery,
  kCount
};

enum class NodeClass : uint8_t { kControl, kDecorator, kAction, kCondition };

struct PortInfo {
  const char* name;
  char kind;             ///< n number, t text, p point or person, s a state, m a message, k kind of place, a area
  const char* fallback;  ///< where the attribute is missing; nullptr: it must be there
  bool output = false;
  const char* help = "";
};

struct NodeInfo {
  Node node;
  const char* name;
  NodeClass of;
  std::vector<PortInfo> ports;
  const char* help;
};

inline constexpr size_t kMaxPorts = 6;

/// By Node.
std::span<const NodeInfo> NodeInfos();
/// nullptr if there is none.
const NodeInfo* NodeByName(std::string_view name);
/// All names that a tree may use, for messages.
std::vector<std::string> NodeNames();
/// `<TreeNodesModel>` of the leaves: an editor (Groot2) reads it and offers them.
std::string TreeNodesModel();

}  // namespace airsim360::internal
