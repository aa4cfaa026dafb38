// Any bytes as a behaviour tree either read or throw InputError; what reads can be ticked.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "airsim360/base/error.h"
#include "airsim360/behaviour/tree_run.h"

namespace {

using namespace airsim360;
using namespace airsim360::behaviour;

class Nothing : public Leaves {
 public:
  Status Tick(const Tree&, const TreeNode& node, NodeMemory&, TreeRun&) override {
    return static_cast<Status>(1 + (static_cast<int>(node.node) + ++count_) % 3);
  }
  void Halt(const Tree&, const TreeNode&, NodeMemory&, TreeRun&) override {}

 private:
  int count_ = 0;
};

// A leaf with every kind of port.
const Palette& FuzzPalette() {
  static const Palette palette({{Node::kFirstLeaf,
                                 "Act",
                                 NodeClass::kAction,
                                 {{"to", 'p', nullptr}, {"how", 't', "well"}, {"times", 'n', "1"}, {"found", 'o', "", true}},
                                 ""},
                                {static_cast<Node>(static_cast<int>(Node::kFirstLeaf) + 1), "Ask", NodeClass::kCondition, {}, "", true}});
  return palette;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  TreeSet set;
  try {
    ReadTrees(
        {reinterpret_cast<const char*>(data), size}, "fuzz", FuzzPalette(), [](char, const std::string&) { return Value{}; }, set);
  } catch (const InputError&) {
    return 0;
  }
  Nothing leaves;
  for (const Tree& tree : set.trees) {
    TreeRun run;
    run.Start(tree);
    for (int64_t k = 0; k < 5; ++k) TickTree(tree, run, k * 200'000'000, leaves);
    HaltTree(tree, run, leaves);
  }
  return 0;
}
