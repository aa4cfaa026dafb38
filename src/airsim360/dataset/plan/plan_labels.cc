#include "airsim360/dataset/plan/plan_labels.h"

#include <algorithm>
#include <set>

#include "airsim360/base/error.h"
#include "airsim360/people/skeleton.h"

namespace airsim360 {
namespace {

constexpr char kPersonCategory[] = "human/person";
// Of what people carry.
constexpr const char* kCarriedCategories[] = {"object/phone", "object/bag", "object/umbrella", "object/stroller"};
static_assert(kEntitiesOfPerson == kPropCount && std::size(kCarriedCategories) + 1 == kPropCount);  // Prop::kNone counts too

}  // namespace

PlanLabels::PlanLabels(const DatasetPlan& plan) : plan_(plan) {
  scene_.name = plan.recipe.name;
  std::set<std::string> attributions;
  for (const auto& [key, world] : plan.worlds) {
    for (const std::string& path : world.categories) scene_.tree.Add(path);
    attributions.insert(world.attributions.begin(), world.attributions.end());
  }
  scene_.tree.SettleIds();
  scene_.attributions.assign(attributions.begin(), attributions.end());
  scene_.entities.resize(static_cast<size_t>(EntityCount(plan)));
  for (size_t i = 0; i < scene_.entities.size(); ++i) {
    scene_.entities[i].id = static_cast<EntityId>(i + 1);
  }
  // Behind all ids of the dataset one for each category, so that the list of categories is whole, whatever is told later.
  std::set<CategoryId> used;
  for (const auto& [key, world] : plan.worlds) {
    for (const std::string& path : world.categories) used.insert(scene_.tree.At(path));
  }
  const CategoryId first = used.empty() ? scene_.tree.At(kPersonCategory) : *used.begin();
  const bool people = std::ranges::any_of(plan.recipe.rows, [](const RecipeRow& row) { return row.people > 0; });
  if (people) {
    for (const char* path : kCarriedCategories) used.insert(scene_.tree.At(path));
  }
  for (Entity& entity : scene_.entities) entity.category = people ? scene_.tree.At(kPersonCategory) : first;
  for (const CategoryId category : used)
    scene_.entities.push_back({.id = static_cast<EntityId>(scene_.entities.size() + 1), .name = {}, .category = category, .bounds = {}});
}

std::function<EntityId(EntityId)> PlanLabels::Renumbering(size_t row) const {
  const EntityBase base = EntityBaseOf(plan_, row);
  const int64_t own = plan_.facts(plan_.recipe.rows[row]).entities;
  return [base, own](EntityId id) {
    const int64_t n = id;
    return static_cast<EntityId>(n <= own ? base.world + n : base.people + n - own);
  };
}

void PlanLabels::Name(EntityId id, const std::string& name, CategoryId category) {
  Entity& entity = scene_.entities.at(id - 1);
  entity.name = name;
  entity.category = category;
}

void PlanLabels::Fill(size_t row, const Scene& world) {
  const auto renumber = Renumbering(row);
  for (const Entity& entity : world.entities) {
    const Category& category = world.tree[entity.category];
    const auto here = scene_.tree.Find(category.path);
    if (here != entity.category) {
      throw RuntimeError("dataset: category '" + category.path + "' has another id in world '" + plan_.recipe.rows[row].world +
                         "' than in others of the plan; put them in plans of their own");
    }
    Name(renumber(entity.id), entity.name, entity.category);
  }
  scene_.sky_entity = world.sky_entity == kNoEntity ? kNoEntity : renumber(world.sky_entity);
}

}  // namespace airsim360
