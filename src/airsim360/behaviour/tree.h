// Behaviour trees, compiled from XML: subtrees in place, blackboard keys as numbered slots.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/behaviour/nodes.h"
#include "airsim360/math/vector.h"

namespace airsim360::behaviour {

/// What a port or a slot of the blackboard holds.
struct Value {
  enum class Kind : uint8_t { kNone, kNumber, kText, kPerson, kPoint, kEntity, kVehicle };
  Kind kind = Kind::kNone;
  bool has_height = false;  ///< of a point: z was given
  uint32_t index = 0;       ///< of a text in TreeSet::texts; a person, an entity, a vehicle; a choice of those who act
  double number = 0;
  Vec3d point;
};

struct Port {
  bool is_slot = false;
  uint16_t slot = 0;
  Value value;  ///< if it is no slot
};

struct TreeNode {
  Node node = Node::kSequence;
  const NodeInfo* info = nullptr;             ///< of the palette
  uint16_t first_child = 0, child_count = 0;  ///< into Tree::children
  uint16_t first_port = 0;                    ///< into Tree::ports, as many as info->ports
  int line = 0;
  int order = 0;      ///< XmlElement::order, in Tree::source
  std::string label;  ///< "Chat" or the author's name of it
};

/// A slot of the blackboard as authors know it.
struct Key {
  std::string name;  ///< "who"; of a subtree in place "Ring/who"
  char what = 0;     ///< PortInfo::kind of a port that reads it; 0: none does
};

/// Node 0 is the root; slots start with `initial`.
struct Tree {
  std::string name;
  std::vector<TreeNode> nodes;
  std::vector<uint16_t> children;
  std::vector<Port> ports;
  std::vector<Value> initial;
  std::vector<Key> keys;                      ///< of each slot
  std::shared_ptr<const std::string> source;  ///< the file that it was read from, whole
};

/// Turns the text of a literal into a value; `what` is PortInfo::kind. Throws InputError without a place.
using ParsePort = std::function<Value(char what, const std::string& text)>;

struct TreeSet {
  std::vector<Tree> trees;  ///< one of each <BehaviorTree>, with all its subtrees in it
  std::vector<std::string> texts;
  std::string main;  ///< main_tree_to_execute; may be empty
};

/// Reads `<root BTCPP_format="4">`. Adds to `set`; a tree of a name that is there already replaces it. InputError
/// "name:line: …" with the nearest valid choice for unknown nodes, attributes, subtrees, states and the like,
/// wrong numbers of children, trees that contain themselves, more than 2000 nodes a tree. `set` points into `palette`.
void ReadTrees(std::string_view xml, std::string_view name, const Palette& palette, const ParsePort& parse, TreeSet& set);

/// What a key of a blackboard holds, for people to read.
struct BoardEntry {
  std::string key, value;
};
/// Names persons, entities, vehicles, and choices of a kind of port; "" where it knows none.
using NameValue = std::function<std::string(char what, const Value& value)>;
/// The keys that hold something; `slots` as Tree::initial. Numbers, texts of `set` and points ("x;y;z") are written by this.
std::vector<BoardEntry> Board(const Tree& tree, const TreeSet& set, const std::vector<Value>& slots, const NameValue& name);

}  // namespace airsim360::behaviour
