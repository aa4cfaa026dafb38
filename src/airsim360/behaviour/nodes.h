// The nodes that behaviour trees are made of: a tested subset of those of BehaviorTree.CPP 4, which every tree may
// use, and leaves by which somebody acts: people (people/behaviour), missions of drones (mission).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airsim360::behaviour {

enum class Node : uint8_t {
  // Controls
  kSequence,
  kSequenceWithMemory,
  kReactiveSequence,
  kFallback,
  kReactiveFallback,
  kParallel,
  kParallelAll,
  kIfThenElse,
  kWhileDoElse,
  // Decorators
  kInverter,
  kForceSuccess,
  kForceFailure,
  kRepeat,
  kRetryUntilSuccessful,
  kKeepRunningUntilFailure,
  kTimeout,
  kDelay,
  kRunOnce,
  // Actions that need nobody
  kAlwaysSuccess,
  kAlwaysFailure,
  kSleep,
  kSetBlackboard,
  // From here on: leaves of a palette, numbered by whom they are for
  kFirstLeaf
};

enum class NodeClass : uint8_t { kControl, kDecorator, kAction, kCondition };
/// "Control" …: tags under which <Tag ID="Name"/> is the same as <Name/>.
inline constexpr const char* kNodeClassNames[] = {"Control", "Decorator", "Action", "Condition"};

struct PortInfo {
  const char* name;
  char kind;             ///< n number, t text, o output; other letters are read by whom the leaves are for (ParsePort)
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
  bool keeps = false;  ///< a leaf that remembers what it noted when it is broken off
};

/// All nodes that a kind of tree may use. Immutable, at one place: trees point into it.
class Palette {
 public:
  /// The common nodes, then `leaves`.
  explicit Palette(std::vector<NodeInfo> leaves);
  Palette(const Palette&) = delete;

  std::span<const NodeInfo> nodes() const { return nodes_; }
  /// nullptr if there is none.
  const NodeInfo* Find(std::string_view name) const;
  /// All names that an element of a tree may have, for messages.
  std::vector<std::string> Names() const;
  /// `<TreeNodesModel>` of what BehaviorTree.CPP does not bring itself: an editor (Groot2) reads it and offers it.
  std::string ModelXml() const;

 private:
  std::vector<NodeInfo> nodes_;
};

}  // namespace airsim360::behaviour
