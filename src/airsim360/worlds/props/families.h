// The families of props. A new prop is a row and a function in the file of its family; a new family is one
// file that defines its function, declared here and listed in props.cc.
#pragma once

#include <vector>

#include "airsim360/worlds/props/props.h"

namespace airsim360::internal {

inline constexpr float kLawnTile = 1.28f;  ///< edge of a "lawn_tile", metres

std::vector<PropKind> BarrierKinds();  // fences, railings, bollards
std::vector<PropKind> BusKinds();
std::vector<PropKind> CarKinds();  // cars and vans
std::vector<PropKind> CycleKinds();
std::vector<PropKind> FountainKinds();
std::vector<PropKind> LampKinds();
std::vector<PropKind> ParkKinds();  // playground, picnic tables, road works, ivy
std::vector<PropKind> RockKinds();
std::vector<PropKind> RooftopKinds();
std::vector<PropKind> SeatingKinds();  // chairs, tables, benches
std::vector<PropKind> ShadeKinds();    // umbrellas, tarps
std::vector<PropKind> SignageKinds();  // posters, traffic signs
std::vector<PropKind> StreetKinds();   // manholes, bus stops
std::vector<PropKind> TrafficLightKinds();
std::vector<PropKind> UtilityKinds();  // hydrants, mailboxes, meters, boxes
std::vector<PropKind> VendingKinds();
std::vector<PropKind> WasteKinds();
std::vector<PropKind> PlanterKinds();
std::vector<PropKind> GroundPlantKinds();  // grass, litter, flowers
std::vector<PropKind> ShrubKinds();        // shrubs, hedges
std::vector<PropKind> BillboardKinds();
std::vector<PropKind> LandmarkKinds();      // phone booth, flags, food truck, bottle
std::vector<PropKind> NewYorkKinds();       // road works, newspaper boxes, fences, hot dog carts
std::vector<PropKind> SanFranciscoKinds();  // its lamps, poles, bins, ropes and barriers
std::vector<PropKind> Cars1950sKinds();     // and its buses
std::vector<PropKind> Signs1950sKinds();    // painted boards, neon
std::vector<PropKind> Street1950sKinds();   // lamps, signals, call boxes
std::vector<PropKind> Roofs1950sKinds();    // aerials, ventilators
std::vector<PropKind> BroadleafKinds();
std::vector<PropKind> ConiferKinds();
std::vector<PropKind> FurnishingKinds();  // worlds/furnishings: furniture and fittings of interiors

}  // namespace airsim360::internal
