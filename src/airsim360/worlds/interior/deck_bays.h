// Where cars stand and drive on the decks of a car park.
#pragma once

#include <vector>

#include "airsim360/worlds/interior/building_plan.h"

namespace airsim360::internal {

/// A parking bay of 2.5 m: cars stand along y, nose to the wall or to the row behind.
struct DeckBay {
  PlanRect rect;
  bool nose_north;
};
inline constexpr float kBayDepth = 5.1f, kBayWidth = 2.5f;

/// Bays of a storey: four rows between the columns of the deck, none where ramps begin and end.
std::vector<DeckBay> DeckBays(const InteriorPlan& plan, int storey);
/// The two driving lanes along x; the same on all storeys.
std::vector<PlanRect> DeckAisles(const InteriorPlan& plan);

}  // namespace airsim360::internal
