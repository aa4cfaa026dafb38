#include <set>

#include "airsim360/assets/import.h"
#include "airsim360/assets/label_rules.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"

namespace airsim360 {

std::shared_ptr<const Scene> Relabelled(std::shared_ptr<const Scene> scene, const std::filesystem::path& labels) {
  if (labels.empty()) return scene;
  const internal::LabelRules rules =
      internal::ParseLabelRules(labels.string(), ReadTextFile(labels, uint64_t{4} << 20));
  auto changed = std::make_shared<Scene>(*scene);
  std::set<std::string> names;
  for (const Entity& entity : changed->entities) names.insert(entity.name);
  for (Entity& entity : changed->entities) {
    for (const internal::LabelRule& rule : rules.rules) {
      // Names of map objects hold '/' themselves: the pattern counts as a whole.
      std::string pattern;
      for (const std::string& part : rule.match) pattern += (pattern.empty() ? "" : "/") + part;
      if (!internal::MatchesGlob(pattern, entity.name)) continue;
      if (!rule.category.empty()) {
        try {
          entity.category = changed->tree.Add(rule.category);
        } catch (const InputError& error) {
          throw InputError(rules.file + ":" + std::to_string(rule.line) + ": " + error.what());
        }
      }
      if (!rule.name.empty()) {
        // Names stay unique, as SceneBuilder makes them.
        std::string name = rule.name;
        for (int number = 2; names.contains(name); ++number) name = rule.name + " " + std::to_string(number);
        names.insert(name);
        entity.name = name;
      }
      break;
    }
  }
  return changed;
}

EntityLabels LabelEntities(const Scene& scene, const EntityLabels* over, std::span<const LabelPattern> patterns, size_t& changed) {
  EntityLabels labels = over ? *over : EntityLabels{scene.tree, std::vector<CategoryId>(scene.entities.size() + 1, kVoid)};
  std::vector<CategoryId> categories;
  for (const LabelPattern& rule : patterns) categories.push_back(labels.tree.Add(rule.category));
  for (const Entity& entity : scene.entities) {
    for (size_t i = 0; i < patterns.size(); ++i) {
      if (!internal::MatchesGlob(patterns[i].pattern, entity.name)) continue;
      labels.of_entity[entity.id] = categories[i];
      ++changed;
      break;
    }
  }
  return labels;
}

}  // namespace airsim360
