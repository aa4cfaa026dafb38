// Doors: leaves of several makes in their frames, and what hangs on the wall around a back door.
#pragma once

#include "airsim360/base/random.h"
#include "airsim360/worlds/building/facade_bays.h"

namespace airsim360::internal {

enum class DoorMake {
  kFlush,          ///< sheet steel with a kick plate and a closer
  kPanelled,       ///< stiles, rails and raised panels
  kHalfGlazed,     ///< panes over panels
  kBoarded,        ///< upright boards on strap hinges
  kRollerShutter,  ///< slats between two guides
  kCount
};

/// Fills an opening with a door and its frame. The back of the opening lies `y` behind the wall; what stands before it
/// keeps within `kDoorRelief`.
void HangDoor(FacadePen& pen, DoorMake make, Surface leaf, Surface frame, float x0, float x1, float z0, float z1, float y);
inline constexpr float kDoorRelief = 0.12f;  // metres

/// Whether a back door has room in a bay and can be where the ground lies `fall` metres below the floor: steps lead down to it along the wall.
bool TakesDoor(const FacadePen& pen, const Bay& bay, float fall);
/// A back door in a bay of the ground floor, from the floor to `bay.z1`, with its steps, lamp, canopy, meters and pipes by
/// chance.
void BuildBackDoor(FacadePen& pen, const BuildingPlan& plan, const Dress& dress, const Bay& bay, float fall, RngStream& rng);

}  // namespace airsim360::internal
