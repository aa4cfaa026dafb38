#include "airsim360/people/crowd/tree_editing.h"

#include <algorithm>

#include "airsim360/base/error.h"
#include "airsim360/people/behaviour/person_nodes.h"
#include "airsim360/people/crowd/agent.h"

namespace airsim360 {

using namespace internal;

std::vector<std::string> TreeNames(const CrowdModel& model) {
  std::vector<std::string> names;
  for (const Tree& tree : model.plan->trees.trees) names.push_back(tree.name);
  return names;
}

std::string TreeSource(const CrowdModel& model, std::string_view tree) {
  const auto& trees = model.plan->trees.trees;
  const auto found = std::ranges::find(trees, tree, &Tree::name);
  if (found == trees.end()) throw InputError(UnknownChoiceMessage("tree", tree, TreeNames(model)));
  return *found->source;
}

std::shared_ptr<const CrowdModel> WithTrees(const CrowdModel& model, std::string_view xml, std::string_view name) {
  CrowdPlan plan = *model.plan;
  TreeVocabulary words{{}, plan.messages, {}};
  for (const StateDef& state : plan.states) words.states.push_back(state.name);
  for (const CrowdArea& area : model.areas) words.areas.push_back(area.name);
  ReadTrees(xml, name, PersonPalette(), PersonPorts(std::move(words)), plan.trees);
  auto changed = std::make_shared<CrowdModel>(model);
  changed->plan = std::make_shared<const CrowdPlan>(std::move(plan));
  return changed;
}

void AdoptTrees(const CrowdModel& before, const CrowdModel& after, CrowdState& state) {
  CrowdTick tick{before, *before.plan, state, *state.internals, {}, nullptr, state.t_ns};
  for (PersonIndex i = 0; i < state.internals->agents.size(); ++i) {
    Agent& agent = state.internals->agents[i];
    const Tree& tree = after.plan->trees.trees[agent.tree];
    if (tree.source == before.plan->trees.trees[agent.tree].source) continue;
    HaltPerson(tick, i);
    agent.run.Start(tree);
  }
}

namespace {

std::vector<behaviour::BoardEntry> BoardOf(const CrowdModel& model, const Tree& tree, const TreeRun& run) {
  const CrowdPlan& plan = *model.plan;
  return behaviour::Board(tree, plan.trees, run.slots, [&](char what, const Value& value) -> std::string {
    if (value.kind == Value::Kind::kPerson && value.index < model.people.size()) return model.people[value.index].name;
    const auto choice = static_cast<size_t>(value.number);
    if (what == 's' && choice < plan.states.size()) return plan.states[choice].name;
    if (what == 'm' && choice < plan.messages.size()) return plan.messages[choice];
    if (what == 'k' && choice < std::size(kPlaceKindNames)) return kPlaceKindNames[choice];
    return what == 'a' && choice < model.areas.size() ? model.areas[choice].name : "";
  });
}

}  // namespace

PersonMind MindOf(const CrowdModel& model, const CrowdState& state, PersonIndex person) {
  if (person >= state.internals->agents.size()) throw InputError("no person " + std::to_string(person));
  const Agent& agent = state.internals->agents[person];
  const Tree& tree = model.plan->trees.trees[agent.tree];
  PersonMind mind{tree.name, agent.commanded, {}, {}, {}, BoardOf(model, tree, agent.run)};
  for (size_t i = 0; i < tree.nodes.size(); ++i) {
    if (agent.run.nodes[i].status != Status::kRunning) continue;
    mind.active.push_back(tree.nodes[i].order);
    mind.labels.push_back(tree.nodes[i].label);
  }
  for (const Message& message : agent.inbox) mind.inbox.push_back({model.plan->messages[message.type], message.from, message.t_ns});
  return mind;
}

}  // namespace airsim360
