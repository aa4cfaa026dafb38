// The parts of new_york_city that its builder puts together.
#pragma once

#include "airsim360/worlds/new_york_city/period.h"
#include "airsim360/worlds/town/district.h"

namespace airsim360::internal {

/// How much of everything, from CityOptions.
struct Density {
  double traffic = 1, trees = 1, furniture = 1;
};

/// Planted islands in the middle of the boulevards.
void LayMedians(District& district, const std::vector<StreetStretch>& streets);
/// Gardens, terraces and soil behind the houses, with fences, trees and seats.
void LayBackYards(District& district, const Manhattan& city);
/// The middle of the blocks, the plaza with its café, the building site.
void BuildOpenLots(District& district, const Manhattan& city);
/// Chooses high bare walls for painted pictures, before the buildings are built.
void MarkMurals(Manhattan& city, const GroundRect& reach, uint64_t seed);
/// Corner walk-ups have either boards or fire escapes, before the buildings are built.
void PartBoardsFromFireEscapes(Manhattan& city, uint64_t seed);
/// Billboards, banners, murals, light boxes and flags on walls and roofs.
void HangSigns(District& district, const Manhattan& city, bool more);
/// What flight instructions name, each once; before the rest of the furniture.
void PlaceLandmarks(District& district, const Manhattan& city);
/// Aerials on the roofs of the low houses; railed stairs on the pavements around the crossing.
void RaiseAerials(District& district, const Manhattan& city);
void PlaceSubwayStairs(District& district);
/// Lamps, trees, bins, newspaper boxes, carts, road works … along the pavements.
void FurnishNewYorkPavements(District& district, const Manhattan& city, const Period& period, const Density& density);
/// Cabs, cars, vans and buses in lanes and bays; covers.
void FurnishNewYorkStreets(District& district, const std::vector<StreetStretch>& streets, const Density& density);
/// Far blocks and streets to 660 m, a skyline to the horizon, the rivers.
void BuildFarManhattan(District& district, const Period& period, const Density& density);

}  // namespace airsim360::internal
