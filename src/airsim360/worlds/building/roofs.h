// Roofs: decks with parapets, coping and clutter, hip roofs with eaves. Every roof is an entity.
#pragma once

#include "airsim360/scene/scene.h"
#include "airsim360/worlds/building/massing.h"
#include "airsim360/worlds/kit/mesh_builder.h"
#include "airsim360/worlds/props/props.h"
#include "airsim360/worlds/texture/surfaces.h"

namespace airsim360 {

/// The roof of a building into `mesh`; parapet backs and bulkheads belong to the building. `shelf` gives the
/// clutter, or null for a bare roof.
void BuildRoof(SceneBuilder& builder, MeshBuilder& mesh, const Surfaces& surfaces, PropShelf* shelf, const BuildingPlan& building,
               EntityId building_entity, EntityId roof_entity);

}  // namespace airsim360
