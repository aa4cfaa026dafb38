// The names of all things of a planned dataset: one table over its worlds, each with ids of its own.
#pragma once

#include <functional>

#include "airsim360/dataset/plan/plan.h"
#include "airsim360/scene/scene.h"

namespace airsim360 {

class PlanLabels {
 public:
  explicit PlanLabels(const DatasetPlan& plan);

  /// Entities and categories without geometry, as the files of the dataset know them. Those of worlds not yet told have no name;
  /// the categories are there from the start.
  const Scene& scene() const { return scene_; }
  /// Takes the names of a row's world and its people. RuntimeError if one of its categories has another id here.
  void Fill(size_t row, const Scene& world);
  /// Takes the name and category of one entity of the dataset.
  void Name(EntityId id, const std::string& name, CategoryId category);
  /// From ids in the row's world (with people) to those of the dataset.
  std::function<EntityId(EntityId)> Renumbering(size_t row) const;

 private:
  const DatasetPlan& plan_;
  Scene scene_;
};

}  // namespace airsim360
