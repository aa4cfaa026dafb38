// What years leave on walls: fallen and mended render, damp above the ground, pipes, grilles, cables.
#pragma once

#include <vector>

#include "airsim360/worlds/building/facade_bays.h"

namespace airsim360::internal {

/// A part of a wall that wear keeps off: an opening with its sill and frame.
struct Kept {
  float x0, x1, z0, z1;
};

/// An outline with a rough edge about (x, z), `half` (x, z) wide, flat on the wall and `proud` metres before it.
void RoughPatch(FacadePen& pen, Vec2f at, Vec2f half, float proud, RngStream& rng);

/// Render that has come off or was mended where the ground splashes, from x0 to x1. The ground lies at z `ground`; the rough upper edge
/// ends at `top` at most. Only walls of brick, render or stone have it.
void DampFoot(FacadePen& pen, const Dress& dress, float x0, float x1, float ground, float top, RngStream& rng);

/// Marks all over a wall from z `from` to `top`, off what is `kept`: patches of other render and bared brick, grilles and flues,
/// pipes that run up between openings, a cable that sags along. `amount` 1 is a wall towards a yard, less are better kept.
void WearWall(FacadePen& pen, const Dress& dress, float from, float top, const std::vector<Kept>& kept, float amount, RngStream& rng);

}  // namespace airsim360::internal
