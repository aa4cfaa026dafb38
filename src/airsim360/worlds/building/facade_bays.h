// One bay of one storey, per style.
#pragma once

#include "airsim360/base/random.h"
#include "airsim360/worlds/building/facade.h"

namespace airsim360::internal {

/// Surfaces and proportions of one building.
struct Dress {
  Surface wall, trim, frame, shutter, glass, party, far;
  float cornice = 0;                  ///< scale of the cornice, 0 = none
  Surface crown = trim, base = wall;  ///< of the cornice, and of the lowest storeys where they are of another stone
};
Dress DressOf(const BuildingPlan& plan);
bool IsBrick(Surface surface);

/// A cell of the wall: x and z range, storey number above the ground floor.
struct Bay {
  float x0, x1, z0, z1;
  int floor, floors;
  float middle() const { return (x0 + x1) / 2; }
};

/// Where the opening of a style sits in its bay.
struct Opening {
  float x0, x1, z0, z1, depth;
};
Opening OpeningOf(FacadeStyle style, const Bay& bay);
/// An air conditioner on the sill of a `share` of windows, a little off the middle.
void HangCooler(FacadeContext& context, FacadePen& pen, const Opening& opening, double share, RngStream& rng);
/// What hangs behind a pane: blind, curtain, light, nothing.
void Furnish(FacadePen::Sash& sash, RngStream& rng);

void BuildBay(FacadeContext& context, FacadePen& pen, FacadeStyle style, const Dress& dress, const Bay& bay, RngStream& rng);
/// Recessed opening with frame and pane, no ornament.
void BuildSimpleBay(FacadePen& pen, FacadeStyle style, const Dress& dress, const Bay& bay, RngStream& rng);
void SimpleOpening(FacadePen& pen, const Dress& dress, float x0, float x1, float z0, float z1, float ox0, float ox1, float oz0, float oz1,
                   float depth, RngStream& rng);

void BuildTerracottaBay(FacadePen& pen, const Dress& dress, const Bay& bay, const Opening& o, RngStream& rng);
void BuildGlazedDecoBay(FacadePen& pen, const Dress& dress, const Bay& bay, const Opening& o, RngStream& rng);
/// Bays of the New York styles; the wall around a brownstone's opening stands already.
void BuildDecoBay(FacadePen& pen, const Dress& dress, const Bay& bay, RngStream& rng);
void BuildBrownstoneBay(FacadePen& pen, const Dress& dress, const Opening& o, RngStream& rng);
/// Ground floor of a brownstone: raised entrance with a stoop, parlour windows, cellar windows.
void BuildParlourFloor(FacadePen& pen, const Dress& dress, float height, RngStream& rng);
/// What hangs on a whole street wall: fire escapes, braces.
void BuildWallExtras(FacadeContext& context, FacadePen& pen, const BuildingPlan& plan, RngStream& rng);
/// Red drapes at both sides of the bay's pane, an entity "red curtains".
void HangRedCurtains(FacadeContext& context, FacadePen& pen, FacadeStyle style, const Bay& bay);

}  // namespace airsim360::internal
