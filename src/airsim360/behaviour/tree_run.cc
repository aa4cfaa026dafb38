#include "airsim360/behaviour/tree_run.h"

#include <algorithm>

namespace airsim360::behaviour {
namespace {

/// One tick of one person: semantics as BehaviorTree.CPP 4 documents them for each node.
class Ticker {
 public:
  Ticker(const Tree& tree, TreeRun& run, int64_t t_ns, Leaves& leaves) : tree_(tree), run_(run), t_ns_(t_ns), leaves_(leaves) {}

  Status Tick(uint16_t index) {
    const TreeNode& node = tree_.nodes[index];
    NodeMemory& memory = run_.nodes[index];
    const Status status = Run(node, memory);
    memory.status = status == Status::kRunning ? Status::kRunning : Status::kIdle;
    return status;
  }

  void Halt(uint16_t index) {
    const TreeNode& node = tree_.nodes[index];
    NodeMemory& memory = run_.nodes[index];
    if (memory.status != Status::kRunning) return;
    for (uint16_t i = 0; i < node.child_count; ++i) Halt(Child(node, i));
    if (node.node >= Node::kFirstLeaf) leaves_.Halt(tree_, node, memory, run_);
    // What has been done once stays done.
    const bool once = node.node == Node::kRunOnce;
    const NodeMemory kept = memory;
    memory = {};
    if (once) memory.flags = kept.flags;
    if (node.info->keeps) memory = kept;
    memory.status = Status::kIdle;
  }

 private:
  uint16_t Child(const TreeNode& node, uint16_t i) const { return tree_.children[node.first_child + i]; }
  double Number(const TreeNode& node, size_t i) const { return NumberOf(tree_, node, run_, i); }
  void HaltFrom(const TreeNode& node, uint16_t first) {
    for (uint16_t i = first; i < node.child_count; ++i) Halt(Child(node, i));
  }

  // Sequence and Fallback: on to the next child as long as each ends with `pass`.
  Status InOrder(const TreeNode& node, NodeMemory& memory, Status pass, bool reactive, bool keep) {
    if (reactive || (memory.status != Status::kRunning && !keep)) memory.child = 0;
    bool all_skipped = true;
    for (uint16_t i = memory.child; i < node.child_count; ++i) {
      const Status status = Tick(Child(node, i));
      if (status == Status::kSkipped) continue;
      all_skipped = false;
      memory.child = i;
      if (status == Status::kRunning) {
        if (reactive) HaltFrom(node, static_cast<uint16_t>(i + 1));
        return status;
      }
      if (status != pass) {
        if (reactive) HaltFrom(node, static_cast<uint16_t>(i + 1));
        if (!keep) memory.child = 0;
        return status;
      }
    }
    memory.child = 0;
    return all_skipped ? Status::kSkipped : pass;
  }

  // All children that have not ended yet; which ones have is kept in the bits of t_ns (so at most 62).
  Status AtOnce(const TreeNode& node, NodeMemory& memory, bool to_the_end) {
    if (memory.status != Status::kRunning) {
      memory.t_ns = 0;
      memory.count = 0;
      memory.child = 0;
    }
    const auto n = static_cast<int>(std::min<uint16_t>(node.child_count, 62));
    const auto needed = [&](double count) { return count < 0 ? std::max(0, n + 1 + static_cast<int>(count)) : static_cast<int>(count); };
    const int successes = to_the_end ? n + 1 : needed(Number(node, 0));
    const int failures = needed(Number(node, to_the_end ? 0 : 1));
    int& failed = memory.count;
    for (int i = 0; i < n; ++i) {
      if (memory.t_ns >> i & 1) continue;
      const Status status = Tick(Child(node, static_cast<uint16_t>(i)));
      if (status == Status::kRunning) continue;
      memory.t_ns |= int64_t{1} << i;
      if (status == Status::kSuccess) ++memory.child;
      if (status == Status::kFailure) ++failed;
      if (to_the_end) continue;
      if (memory.child >= successes) return HaltFrom(node, 0), Status::kSuccess;
      if (failed >= failures || n - failed < successes) return HaltFrom(node, 0), Status::kFailure;
    }
    if (memory.t_ns != (int64_t{1} << n) - 1) return Status::kRunning;
    return to_the_end ? (failed >= failures ? Status::kFailure : Status::kSuccess) : Status::kFailure;
  }

  Status Branch(const TreeNode& node, NodeMemory& memory, bool reactive) {
    const bool fresh = memory.status != Status::kRunning;
    if (fresh) memory.child = 0;
    if (memory.child == 0 || reactive) {
      const Status condition = Tick(Child(node, 0));
      if (condition == Status::kRunning) return condition;
      const uint16_t branch = condition == Status::kSuccess ? 1 : 2;
      if (memory.child != 0 && memory.child != branch) HaltFrom(node, 1);
      memory.child = branch;
    }
    if (memory.child >= node.child_count) return Status::kFailure;
    return Tick(Child(node, memory.child));
  }

  // Again and again until `stop`, at most `times`; one round a tick, so that no tree hangs.
  Status Loop(const TreeNode& node, NodeMemory& memory, Status stop, double times) {
    if (memory.status != Status::kRunning) memory.count = 0;
    const Status status = Tick(Child(node, 0));
    if (status == Status::kRunning || status == Status::kSkipped || status == stop) return status;
    ++memory.count;
    return times >= 0 && memory.count >= times ? status : Status::kRunning;
  }

  Status Decorate(const TreeNode& node, NodeMemory& memory) {
    const uint16_t child = Child(node, 0);
    switch (node.node) {
      case Node::kInverter: {
        const Status status = Tick(child);
        return status == Status::kSuccess ? Status::kFailure : status == Status::kFailure ? Status::kSuccess : status;
      }
      case Node::kForceSuccess:
      case Node::kForceFailure: {
        const Status status = Tick(child);
        if (status == Status::kRunning || status == Status::kSkipped) return status;
        return node.node == Node::kForceSuccess ? Status::kSuccess : Status::kFailure;
      }
      case Node::kRepeat:
        return Loop(node, memory, Status::kFailure, Number(node, 0));
      case Node::kRetryUntilSuccessful:
        return Loop(node, memory, Status::kSuccess, Number(node, 0));
      case Node::kKeepRunningUntilFailure:
        return Loop(node, memory, Status::kFailure, -1);
      case Node::kTimeout: {
        if (memory.status != Status::kRunning) memory.t_ns = t_ns_;
        if (static_cast<double>(t_ns_ - memory.t_ns) * 1e-6 >= Number(node, 0)) return Halt(child), Status::kFailure;
        return Tick(child);
      }
      case Node::kDelay: {
        if (memory.status != Status::kRunning) memory.t_ns = t_ns_;
        if (static_cast<double>(t_ns_ - memory.t_ns) * 1e-6 < Number(node, 0)) return Status::kRunning;
        return Tick(child);
      }
      default: {  // kRunOnce: flags 1 = done, 2 = it failed
        if (memory.flags & 1) {
          const Value& skip = PortOf(tree_, node, run_, 0);
          // "true" is the default; anything else answers as the child did.
          if (skip.kind == Value::Kind::kText && skip.index == 0) return Status::kSkipped;
          return memory.flags & 2 ? Status::kFailure : Status::kSuccess;
        }
        const Status status = Tick(child);
        if (status == Status::kSuccess || status == Status::kFailure)
          memory.flags = static_cast<uint8_t>(1 | (status == Status::kFailure ? 2 : 0));
        return status;
      }
    }
  }

  Status Run(const TreeNode& node, NodeMemory& memory) {
    switch (node.node) {
      case Node::kSequence:
        return InOrder(node, memory, Status::kSuccess, false, false);
      case Node::kSequenceWithMemory:
        return InOrder(node, memory, Status::kSuccess, false, true);
      case Node::kReactiveSequence:
        return InOrder(node, memory, Status::kSuccess, true, false);
      case Node::kFallback:
        return InOrder(node, memory, Status::kFailure, false, false);
      case Node::kReactiveFallback:
        return InOrder(node, memory, Status::kFailure, true, false);
      case Node::kParallel:
        return AtOnce(node, memory, false);
      case Node::kParallelAll:
        return AtOnce(node, memory, true);
      case Node::kIfThenElse:
        return Branch(node, memory, false);
      case Node::kWhileDoElse:
        return Branch(node, memory, true);
      case Node::kAlwaysSuccess:
        return Status::kSuccess;
      case Node::kAlwaysFailure:
        return Status::kFailure;
      case Node::kSleep:
        if (memory.status != Status::kRunning) memory.t_ns = t_ns_;
        return static_cast<double>(t_ns_ - memory.t_ns) * 1e-6 >= Number(node, 0) ? Status::kSuccess : Status::kRunning;
      case Node::kSetBlackboard:
        SetPort(tree_, node, run_, 1, PortOf(tree_, node, run_, 0));
        return Status::kSuccess;
      default:
        break;
    }
    if (node.node < Node::kAlwaysSuccess) return Decorate(node, memory);
    return leaves_.Tick(tree_, node, memory, run_);
  }

  const Tree& tree_;
  TreeRun& run_;
  int64_t t_ns_;
  Leaves& leaves_;
};

}  // namespace

Status TickTree(const Tree& tree, TreeRun& run, int64_t t_ns, Leaves& leaves) { return Ticker(tree, run, t_ns, leaves).Tick(0); }

void HaltTree(const Tree& tree, TreeRun& run, Leaves& leaves) { Ticker(tree, run, 0, leaves).Halt(0); }

const Value& PortOf(const Tree& tree, const TreeNode& node, const TreeRun& run, size_t i) {
  const Port& port = tree.ports[node.first_port + i];
  return port.is_slot ? run.slots[port.slot] : port.value;
}

double NumberOf(const Tree& tree, const TreeNode& node, const TreeRun& run, size_t i) { return PortOf(tree, node, run, i).number; }

void SetPort(const Tree& tree, const TreeNode& node, TreeRun& run, size_t i, const Value& value) {
  const Port& port = tree.ports[node.first_port + i];
  if (port.is_slot) run.slots[port.slot] = value;
}

}  // namespace airsim360::behaviour
