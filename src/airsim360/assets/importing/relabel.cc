#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "airsim360/assets/importing/import.h"
#include "airsim360/assets/labels/label_count.h"
#include "airsim360/assets/labels/label_rules.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/base/log.h"

namespace airsim360 {
namespace {

// Index of the first pattern that matches a whole name; their number if none does.
size_t FirstMatch(std::span<const std::string> patterns, const std::string& name) {
  const auto found = std::ranges::find_if(patterns, [&](const std::string& p) { return internal::MatchesGlob(p, name); });
  return static_cast<size_t>(found - patterns.begin());
}

bool MatchesAny(const std::string& pattern, const std::vector<Entity>& entities) {
  return std::ranges::any_of(entities, [&](const Entity& e) { return internal::MatchesGlob(pattern, e.name); });
}

// Names of map objects hold '/' themselves: a pattern counts as a whole.
std::vector<std::string> PatternsOf(const internal::LabelRules& rules) {
  std::vector<std::string> patterns;
  for (const internal::LabelRule& rule : rules.rules) {
    std::string& pattern = patterns.emplace_back();
    for (const std::string& part : rule.match) pattern += (pattern.empty() ? "" : "/") + part;
  }
  return patterns;
}

CategoryId AddCategory(SemanticTree& tree, const internal::LabelRules& rules, const internal::LabelRule& rule) {
  try {
    return tree.Add(rule.category);
  } catch (const InputError& error) {
    throw InputError(rules.file + ":" + std::to_string(rule.line) + ": " + error.what());
  }
}

}  // namespace

LabelCount CountLabelled(const Scene& scene, const std::filesystem::path& labels) {
  const internal::LabelRules rules = internal::ParseLabelRules(labels.string(), ReadTextFile(labels, uint64_t{4} << 20));
  const std::vector<std::string> patterns = PatternsOf(rules);
  SemanticTree tree = scene.tree;
  for (const internal::LabelRule& rule : rules.rules)
    if (!rule.category.empty()) AddCategory(tree, rules, rule);
  LabelCount count{.rules = patterns.size()};
  for (const std::string& pattern : patterns) count.unused += !MatchesAny(pattern, scene.entities);
  for (const Entity& entity : scene.entities) count.entities += FirstMatch(patterns, entity.name) < patterns.size();
  return count;
}

std::shared_ptr<const Scene> Relabelled(std::shared_ptr<const Scene> scene, const std::filesystem::path& labels) {
  if (labels.empty()) return scene;
  const internal::LabelRules rules = internal::ParseLabelRules(labels.string(), ReadTextFile(labels, uint64_t{4} << 20));
  const std::vector<std::string> patterns = PatternsOf(rules);
  auto changed = std::make_shared<Scene>(*scene);
  std::set<std::string> names;
  for (const Entity& entity : changed->entities) names.insert(entity.name);
  std::vector<bool> used(patterns.size());
  for (Entity& entity : changed->entities) {
    const size_t first = FirstMatch(patterns, entity.name);
    if (first == patterns.size()) continue;
    used[first] = true;
    const internal::LabelRule& rule = rules.rules[first];
    if (!rule.category.empty()) entity.category = AddCategory(changed->tree, rules, rule);
    if (!rule.name.empty()) {
      // Names stay unique, as SceneBuilder makes them.
      std::string name = rule.name;
      for (int number = 2; names.contains(name); ++number) name = rule.name + " " + std::to_string(number);
      names.insert(name);
      entity.name = name;
    }
  }
  changed->SettleCategories();
  internal::Warnings warnings;
  for (size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) warnings.Add(internal::UnusedRule(rules, i, MatchesAny(patterns[i], scene->entities)));
  }
  for (const std::string& warning : warnings.Take()) LogWarning(warning);
  return changed;
}

EntityLabels LabelEntities(const Scene& scene, const EntityLabels* over, std::span<const LabelPattern> patterns, size_t& changed,
                           std::vector<std::string>* unused) {
  EntityLabels labels = over ? *over : EntityLabels{scene.tree, std::vector<CategoryId>(scene.entities.size() + 1, kVoid)};
  std::vector<std::string> names;
  std::vector<CategoryId> categories;
  for (const LabelPattern& rule : patterns) {
    names.push_back(rule.pattern);
    categories.push_back(labels.tree.Add(rule.category));
  }
  for (const Entity& entity : scene.entities) {
    const size_t first = FirstMatch(names, entity.name);
    if (first == names.size()) continue;
    labels.of_entity[entity.id] = categories[first];
    ++changed;
  }
  for (const std::string& name : names) {
    if (unused && !MatchesAny(name, scene.entities)) unused->push_back(name);
  }
  return labels;
}

}  // namespace airsim360
