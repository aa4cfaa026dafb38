#include "airsim360/behaviour/tree.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/behaviour/xml.h"

namespace airsim360::behaviour {
namespace {

constexpr size_t kMaxNodes = 2000, kMaxSlots = 500;

/// Names of a subtree's blackboard keys to slots of the whole tree.
using Scope = std::map<std::string, uint16_t>;

bool IsKey(const std::string& text) { return text.size() > 2 && text.front() == '{' && text.back() == '}'; }

class Compiler {
 public:
  Compiler(const XmlElement& root, std::string_view file, const Palette& palette, const ParsePort& parse, TreeSet& set)
      : file_(file), palette_(palette), parse_(parse), set_(set) {
    if (set_.texts.empty()) set_.texts.push_back("true");  // text 0, see RunOnce
    if (root.tag != "root") Fail(root, "expected <root BTCPP_format=\"4\">, found <" + root.tag + ">");
    const std::string* format = root.Find("BTCPP_format");
    if (!format || *format != "4") Fail(root, "expected BTCPP_format=\"4\"");
    for (const auto& [name, value] : root.attributes)
      if (name != "BTCPP_format" && name != "main_tree_to_execute")
        Fail(root, UnknownChoiceMessage("attribute", name, std::vector<std::string>{"BTCPP_format", "main_tree_to_execute"}));
    for (const XmlElement& element : root.children) {
      if (element.tag == "TreeNodesModel") continue;
      if (element.tag != "BehaviorTree")
        Fail(element, UnknownChoiceMessage("element", element.tag, std::vector<std::string>{"BehaviorTree", "TreeNodesModel"}));
      const std::string* id = element.Find("ID");
      if (!id || id->empty()) Fail(element, "a BehaviorTree needs an ID");
      if (element.children.size() != 1) Fail(element, "BehaviorTree '" + *id + "' needs exactly one child");
      if (!sources_.emplace(*id, &element).second) Fail(element, "BehaviorTree '" + *id + "' is there twice");
      names_.push_back(*id);
    }
    if (const std::string* main = root.Find("main_tree_to_execute")) {
      if (!sources_.contains(*main)) Fail(root, UnknownChoiceMessage("tree", *main, names_));
      set_.main = *main;
    }
  }

  void Run(const std::shared_ptr<const std::string>& source_text) {
    for (const std::string& name : names_) {
      tree_ = {};
      tree_.name = name;
      tree_.source = source_text;
      tree_.nodes.emplace_back();
      Scope scope;
      const XmlElement& source = *sources_[name];
      path_ = {name};
      Fill(0, source.children[0], scope);
      const auto old = std::find_if(set_.trees.begin(), set_.trees.end(), [&](const Tree& t) { return t.name == name; });
      (old == set_.trees.end() ? set_.trees.emplace_back() : *old) = std::move(tree_);
    }
  }

 private:
  [[noreturn]] void Fail(const XmlElement& at, const std::string& what) const {
    throw InputError(file_ + ":" + std::to_string(at.line) + ": " + what);
  }

  uint16_t Slot(const XmlElement& at, Scope& scope, const std::string& key) {
    const auto found = scope.find(key);
    if (found != scope.end()) return found->second;
    if (tree_.initial.size() >= kMaxSlots) Fail(at, "more than 500 blackboard keys");
    tree_.initial.emplace_back();
    tree_.keys.push_back({KeyName(key)});
    return scope[key] = static_cast<uint16_t>(tree_.initial.size() - 1);
  }

  // With the subtrees that it lies in.
  std::string KeyName(const std::string& key) const {
    std::string name;
    for (size_t i = 1; i < path_.size(); ++i) name.append(path_[i]).append(1, '/');
    return name.append(key);
  }

  Value Text(const std::string& text) {
    const auto found = std::find(set_.texts.begin(), set_.texts.end(), text);
    Value value;
    value.kind = Value::Kind::kText;
    value.index = static_cast<uint32_t>(found - set_.texts.begin());
    if (found == set_.texts.end()) set_.texts.push_back(text);
    // What reads as a number is one, too.
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (!text.empty() && *end == 0 && number - number == 0) {
      value.kind = Value::Kind::kNumber;
      value.number = number;
    }
    return value;
  }

  Value Literal(const XmlElement& at, const PortInfo& port, const std::string& text) {
    try {
      if (port.kind == 't') return Text(text);
      if (port.kind == 'n') {
        char* end = nullptr;
        const double number = std::strtod(text.c_str(), &end);
        if (text.empty() || *end != 0 || !(number - number == 0))
          throw InputError("expected a number, found '" + text.substr(0, 100) + "'");
        Value value;
        value.kind = Value::Kind::kNumber;
        value.number = number;
        return value;
      }
      return parse_(port.kind, text);
    } catch (const InputError& error) {
      Fail(at, at.tag + " " + port.name + ": " + error.what());
    }
  }

  // A subtree is put in place: its keys are its own unless an attribute ties them to a key or a value outside.
  void FillSubTree(size_t index, const XmlElement& element, Scope& scope) {
    const std::string* id = element.Find("ID");
    if (!id) Fail(element, "a SubTree needs an ID");
    const auto source = sources_.find(*id);
    if (source == sources_.end()) Fail(element, UnknownChoiceMessage("tree", *id, names_));
    if (std::find(path_.begin(), path_.end(), *id) != path_.end()) Fail(element, "tree '" + *id + "' contains itself");
    Scope inner;
    for (const auto& [name, value] : element.attributes) {
      if (name == "ID" || name == "name") continue;
      if (name == "_autoremap") {
        if (value == "true" || value == "1") inner.insert(scope.begin(), scope.end());
        continue;
      }
      if (name.starts_with("_")) Fail(element, "attribute '" + name + "' is not among those that are read (ID, name, _autoremap, ports)");
      if (IsKey(value)) {
        inner[name] = Slot(element, scope, value.substr(1, value.size() - 2));
      } else {
        inner.erase(name);
        const uint16_t slot = Slot(element, inner, name);
        tree_.initial[slot] = Text(value);
        tree_.keys[slot].name = KeyName(*id + "/" + name);
      }
    }
    path_.push_back(*id);
    Fill(index, source->second->children[0], inner);
    path_.pop_back();
  }

  void Fill(size_t index, const XmlElement& element, Scope& scope) {
    if (element.tag == "SubTree") return FillSubTree(index, element, scope);
    // <Action ID="Chat"/> is the same as <Chat/>.
    std::string tag = element.tag;
    const bool generic = tag == "Action" || tag == "Condition" || tag == "Control" || tag == "Decorator";
    if (generic) {
      const std::string* id = element.Find("ID");
      if (!id) Fail(element, "<" + tag + "> needs an ID");
      tag = *id;
    }
    const NodeInfo* info = palette_.Find(tag);
    if (!info) Fail(element, UnknownChoiceMessage("node", tag, palette_.Names()));
    CheckAttributes(element, *info, generic);
    TreeNode node{.node = info->node,
                  .info = info,
                  .first_port = static_cast<uint16_t>(tree_.ports.size()),
                  .line = element.line,
                  .order = element.order,
                  .label = info->name};
    if (const std::string* name = element.Find("name")) node.label = name->substr(0, 80);
    if (tree_.ports.size() > 60000) Fail(element, "the tree is too large");
    for (const PortInfo& port : info->ports) AddPort(element, *info, port, scope);
    CheckChildren(element, *info);
    FillChildren(index, std::move(node), element, scope);
  }

  // Attributes are ports.
  void CheckAttributes(const XmlElement& element, const NodeInfo& info, bool generic) {
    std::vector<std::string> valid = {"name"};
    for (const PortInfo& port : info.ports) valid.push_back(port.name);
    for (const auto& [name, value] : element.attributes) {
      if (generic && name == "ID") continue;
      if (std::find(valid.begin(), valid.end(), name) == valid.end())
        Fail(element, info.name + (": " + UnknownChoiceMessage("attribute", name, valid)));
    }
  }

  void CheckChildren(const XmlElement& element, const NodeInfo& info) {
    const size_t n = element.children.size();
    const std::string has = info.name + (" has " + std::to_string(n)) + " children, not ";
    const bool fits = info.of == NodeClass::kControl ? n >= 1 : info.of == NodeClass::kDecorator ? n == 1 : n == 0;
    if (!fits) Fail(element, has + (info.of == NodeClass::kControl ? "one or more" : info.of == NodeClass::kDecorator ? "one" : "none"));
    if ((info.node == Node::kIfThenElse || info.node == Node::kWhileDoElse) && (n < 2 || n > 3)) Fail(element, has + "two or three");
  }

  void AddPort(const XmlElement& element, const NodeInfo& node, const PortInfo& info, Scope& scope) {
    const std::string* text = element.Find(info.name);
    if (!text && !info.fallback) Fail(element, node.name + (" needs the attribute '" + std::string(info.name)) + "'");
    Port port;
    const std::string value = text ? *text : info.fallback;
    if (IsKey(value)) {
      port.is_slot = true;
      port.slot = Slot(element, scope, value.substr(1, value.size() - 2));
      if (info.kind != 'o' && tree_.keys[port.slot].what == 0) tree_.keys[port.slot].what = info.kind;
      // A word that a SubTree was given is read as what this port takes.
      Value& initial = tree_.initial[port.slot];
      if (initial.kind == Value::Kind::kText && info.kind != 't' && info.kind != 'o')
        initial = Literal(element, info, std::string(set_.texts[initial.index]));
    } else if (info.kind == 'o') {
      if (text && !value.empty())
        Fail(element, node.name + (" " + std::string(info.name)) + ": expected a {key}, found '" + value.substr(0, 100) + "'");
    } else if (text || *info.fallback) {
      port.value = Literal(element, info, value);
    }
    tree_.ports.push_back(port);
  }

  void FillChildren(size_t index, TreeNode node, const XmlElement& element, Scope& scope) {
    const size_t n = element.children.size();
    node.first_child = static_cast<uint16_t>(tree_.children.size());
    node.child_count = static_cast<uint16_t>(n);
    if (tree_.nodes.size() + n > kMaxNodes) Fail(element, "more than 2000 nodes in tree '" + tree_.name + "'");
    const size_t first = tree_.nodes.size();
    for (size_t i = 0; i < n; ++i) {
      tree_.children.push_back(static_cast<uint16_t>(first + i));
      tree_.nodes.emplace_back();
    }
    tree_.nodes[index] = std::move(node);
    for (size_t i = 0; i < n; ++i) Fill(first + i, element.children[i], scope);
  }

  std::string file_;
  const Palette& palette_;
  const ParsePort& parse_;
  TreeSet& set_;
  std::map<std::string, const XmlElement*> sources_;
  std::vector<std::string> names_, path_;
  Tree tree_;
};

}  // namespace

void ReadTrees(std::string_view xml, std::string_view name, const Palette& palette, const ParsePort& parse, TreeSet& set) {
  const XmlElement root = ReadXml(xml, name);
  Compiler(root, name, palette, parse, set).Run(std::make_shared<const std::string>(xml));
}

namespace {

std::string NumberText(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

std::string PointText(const Value& value) {
  std::string text = NumberText(value.point.x);
  text.append(1, ';').append(NumberText(value.point.y));
  if (value.has_height) text.append(1, ';').append(NumberText(value.point.z));
  return text;
}

std::string ValueText(char what, const Value& value, const TreeSet& set, const NameValue& name) {
  if (std::string named = name(what, value); !named.empty()) return named;
  switch (value.kind) {
    case Value::Kind::kNumber:
      return NumberText(value.number);
    case Value::Kind::kText:
      return value.index < set.texts.size() ? set.texts[value.index] : "";
    case Value::Kind::kPoint:
      return PointText(value);
    case Value::Kind::kPerson:
      return "person " + std::to_string(value.index);
    case Value::Kind::kEntity:
      return "entity " + std::to_string(value.index);
    case Value::Kind::kVehicle:
      return "vehicle " + std::to_string(value.index);
    case Value::Kind::kNone:
      break;
  }
  return {};
}

}  // namespace

std::vector<BoardEntry> Board(const Tree& tree, const TreeSet& set, const std::vector<Value>& slots, const NameValue& name) {
  std::vector<BoardEntry> board;
  for (size_t i = 0; i < slots.size() && i < tree.keys.size(); ++i)
    if (slots[i].kind != Value::Kind::kNone) board.push_back({tree.keys[i].name, ValueText(tree.keys[i].what, slots[i], set, name)});
  return board;
}

}  // namespace airsim360::behaviour
