// The place of one who acts in a tree, and the tick.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/behaviour/tree.h"

namespace airsim360::behaviour {

enum class Status : uint8_t { kIdle, kRunning, kSuccess, kFailure, kSkipped };

/// What a node remembers between ticks. `t_ns`, `count` and `data` are for the leaf or decorator itself.
struct NodeMemory {
  Status status = Status::kIdle;
  uint8_t flags = 0;
  uint16_t child = 0;
  int32_t count = 0;
  int64_t t_ns = 0;
};

/// Copyable; part of the state of a simulation.
struct TreeRun {
  std::vector<NodeMemory> nodes;
  std::vector<Value> slots;

  void Start(const Tree& tree) {
    nodes.assign(tree.nodes.size(), {});
    slots = tree.initial;
  }
};

/// The leaves that act: everything from Node::kFirstLeaf on.
class Leaves {
 public:
  virtual ~Leaves() = default;
  /// Ticks a leaf; `memory.status` is kRunning if it ran before, else this is its first tick.
  virtual Status Tick(const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run) = 0;
  /// A running leaf is broken off.
  virtual void Halt(const Tree& tree, const TreeNode& node, NodeMemory& memory, TreeRun& run) = 0;
};

/// Ticks a tree at time t; a tree that ends starts anew at the next tick.
Status TickTree(const Tree& tree, TreeRun& run, int64_t t_ns, Leaves& leaves);
/// Breaks off everything that runs.
void HaltTree(const Tree& tree, TreeRun& run, Leaves& leaves);

/// Port `i` of a node: its literal or what the slot holds now.
const Value& PortOf(const Tree& tree, const TreeNode& node, const TreeRun& run, size_t i);
double NumberOf(const Tree& tree, const TreeNode& node, const TreeRun& run, size_t i);
/// Writes to an output port, if it is tied to a key.
void SetPort(const Tree& tree, const TreeNode& node, TreeRun& run, size_t i, const Value& value);

}  // namespace airsim360::behaviour
