#include "airsim360/mission/mission.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "airsim360/base/error.h"
#include "airsim360/base/nearest_name.h"
#include "airsim360/mission/mission_nodes.h"
#include "airsim360/render/products.h"

namespace airsim360 {
namespace {

using behaviour::NumberOf;
using behaviour::Port;
using behaviour::Tree;
using behaviour::TreeNode;
using behaviour::TreeSet;
using behaviour::Value;

constexpr size_t kLongestName = 64;

std::vector<std::string> SplitProducts(const std::string& text) {
  std::vector<std::string> names;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    names.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

Value NumberValue(char kind, const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0 || !std::isfinite(number)) throw InputError("expected a number, found '" + text.substr(0, 100) + "'");
  if (const std::string problem = NumberProblem(kind, number); !problem.empty()) throw InputError(problem);
  Value value;
  value.kind = Value::Kind::kNumber;
  value.number = number;
  return value;
}

// Texts that must be words of some kind, kept in TreeSet::texts.
class Literals {
 public:
  Literals(const MissionWorld* world, TreeSet& set) : world_(world), set_(set) {}

  Value operator()(char kind, const std::string& text) {
    if (RangeOf(kind)) return NumberValue(kind, text);
    if (kind == 'w') return ParseThing(text, world_);
    if (kind == 'f') CheckFolder(text);
    if (kind == 'x') WithProducts({}, SplitProducts(text));
    Value value;
    value.kind = Value::Kind::kText;
    value.index = static_cast<uint32_t>(std::ranges::find(set_.texts, text) - set_.texts.begin());
    if (value.index == set_.texts.size()) set_.texts.push_back(text);
    return value;
  }

 private:
  static void CheckFolder(const std::string& text) {
    const bool fits = !text.empty() && text.size() <= kLongestName &&
                      std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
    if (text == "frames" || text == "sensors") throw InputError("'" + text + "' is what fly itself writes; choose another name");
    if (!fits) throw InputError("'" + text.substr(0, 100) + "' is no name of a folder: 1 to 64 letters, digits, _ and -");
  }

  const MissionWorld* world_;
  TreeSet& set_;
};

[[noreturn]] void Fail(std::string_view name, const TreeNode& node, const std::string& what) {
  throw InputError(std::string(name) + ":" + std::to_string(node.line) + ": " + node.info->name + ": " + what);
}

const std::string& TextOf(const Mission& mission, const TreeNode& node, size_t port) {
  static const std::string none;
  const Port& of = mission.tree().ports[node.first_port + port];
  return of.value.kind == Value::Kind::kText ? mission.trees.texts[of.value.index] : none;
}

// What a mission looks for is a thing of the world, or part of a category path: else it would be looked for in vain. "" if it is.
std::string SeenProblem(const std::string& what, const MissionWorld& world) {
  const Scene& scene = world.model->tracer->scene();
  std::vector<std::string> words;
  for (const auto& [id, category] : scene.tree.categories()) {
    if (("/" + category.path + "/").find("/" + what + "/") != std::string::npos) return {};
    words.push_back(category.path.substr(category.path.rfind('/') + 1));
  }
  for (const Entity& entity : scene.entities) words.push_back(entity.name);
  try {
    if (ParseThing(what, &world).kind != Value::Kind::kPoint) return {};
  } catch (const InputError&) {
  }
  return "no thing, person, vehicle or category '" + what.substr(0, 100) + "' in the world" + DidYouMean(what, words);
}

// What follows from several nodes, or from the drone.
void CheckNodes(const Mission& mission, std::string_view name) {
  std::map<std::string, std::string> products;
  for (const TreeNode& node : mission.tree().nodes) {
    const auto kind = static_cast<MissionNode>(node.node);
    if (kind == MissionNode::kCapture) {
      const std::string &to = TextOf(mission, node, 0), &wanted = TextOf(mission, node, 3);
      const auto [before, is_new] = products.emplace(to, wanted);
      if (!is_new && before->second != wanted)
        Fail(name, node,
             "products '" + wanted + "' of the dataset '" + to + "', which has '" + before->second +
                 "' elsewhere; give it another name with `to`");
    }
    if (!mission.world.model) continue;
    if (kind == MissionNode::kSees) {
      const std::string& what = TextOf(mission, node, 0);
      const std::string problem = what.empty() ? "" : SeenProblem(what, mission.world);
      if (!problem.empty()) Fail(name, node, problem);
    }
    if (kind != MissionNode::kGimbal) continue;
    const auto& gimbals = mission.world.model->drones[mission.vehicle]->setup().sensors.gimbals;
    const Port& port = mission.tree().ports[node.first_port + 3];
    if (port.is_slot || port.value.number < static_cast<double>(gimbals.size())) continue;
    Fail(name, node,
         gimbals.empty()
             ? "the drone has no gimbal; a sensor file gives it one (docs/reference/sensors.md)"
             : "gimbal " + std::to_string(static_cast<int>(port.value.number)) + " is not in 0 … " + std::to_string(gimbals.size() - 1));
  }
}

Mission Compile(std::string_view xml, std::string_view name, MissionWorld world, size_t vehicle) {
  Mission mission{std::move(world), vehicle, {}, 0};
  Literals literals(mission.world.model ? &mission.world : nullptr, mission.trees);
  ReadTrees(xml, name, MissionPalette(), std::ref(literals), mission.trees);
  const std::vector<Tree>& trees = mission.trees.trees;
  if (trees.empty()) throw InputError(std::string(name) + ":1: there is no BehaviorTree in it");
  mission.main = trees.size() - 1;
  if (!mission.trees.main.empty())
    mission.main = static_cast<size_t>(std::ranges::find(trees, mission.trees.main, &Tree::name) - trees.begin());
  CheckNodes(mission, name);
  return mission;
}

}  // namespace

void CheckMission(std::string_view xml, std::string_view name) { Compile(xml, name, {}, 0); }

std::shared_ptr<const Mission> ReadMission(std::string_view xml, std::string_view name, MissionWorld world, size_t vehicle) {
  if (vehicle >= world.model->drones.size())
    throw InputError(std::string(name) + ": drone " + std::to_string(vehicle) + " of " + std::to_string(world.model->drones.size()) +
                     " (from 0)");
  return std::make_shared<const Mission>(Compile(xml, name, std::move(world), vehicle));
}

}  // namespace airsim360
