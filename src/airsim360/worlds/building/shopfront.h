// Ground floors towards the street: shopfronts with recessed doors, fascia and awning, or a lobby.
#pragma once

#include "airsim360/base/random.h"
#include "airsim360/worlds/building/facade.h"

namespace airsim360::internal {

/// What all bays of one ground floor share.
struct GroundFloor {
  const BuildingPlan& plan;
  EntityId entity;
  float height;  ///< to the top of the storey
  Surface wall, trim, frame;
};

/// One shop between x0 and x1 of the pen's wall.
void BuildShop(FacadeContext& context, FacadePen& pen, const GroundFloor& floor, float x0, float x1, RngStream& rng);
/// A glazed lobby with a canopy.
void BuildLobby(FacadePen& pen, const GroundFloor& floor, float x0, float x1);

}  // namespace airsim360::internal
