#include "airsim360/worlds/props/placed_models.h"

namespace airsim360::internal {

void AddPlacedModels(SceneBuilder& builder, PropShelf& shelf, const std::vector<PlacedModel>& models) {
  for (const PlacedModel& placed : models) {
    const EntityId entity = builder.AddEntity(placed.name, builder.tree().Add(placed.category));
    builder.AddInstance({shelf.Add(placed.model), PlaceUpright(placed.p_W, placed.yaw, placed.scale), entity});
  }
}

}  // namespace airsim360::internal
