// Row houses of San Francisco: a garage under a bay window, a stoop to a recessed door, cornice or gable; made to stand on slopes.
#pragma once

#include "airsim360/worlds/building/facade.h"

namespace airsim360 {

/// One house in a frame of its own: the street front from (0, 0) to (width, 0) facing -y, the lot behind it, z = 0 the ground at
/// its upper front corner.
struct BayHouse {
  enum class Kind {
    kItalianate,  ///< canted bay, bracketed cornice before a flat roof
    kGabled,      ///< canted bay below a gable to the street
    kStucco,      ///< square bay, strip of roof tiles before a flat roof
  };
  Kind kind = Kind::kItalianate;
  float width = 7.6f, depth = 15;
  int floors = 2;                              ///< above the garage
  bool door_right = true;                      ///< seen from the street; else the door is at the left
  float fall_left = 0, fall_right = 0;         ///< how far below z = 0 the ground lies at both front corners, >= 0
  float foot = 0.5f;                           ///< how far all walls reach below z = 0
  float hidden_left = 0, hidden_right = 0;     ///< a neighbour hides that side up to this height
  float rear_ground = 0;                       ///< of the yard behind the house over z = 0: no windows below it
  bool open_left = false, open_right = false;  ///< that side looks at a street: windows
  Surface wall = Surface::kStuccoWhite, trim = Surface::kTrimWhite, frame = Surface::kFrameWhite, door = Surface::kDoorWood,
          garage = Surface::kShutterGreen;
  bool flat = false;  ///< seen from afar only: no frames, ornaments or stoop
  uint64_t seed = 0;
  float height() const;  ///< of eaves or deck over z = 0
  float top() const;     ///< of the highest point
};

/// Walls, bay and stoop as `building`, what covers it as `roof`, into context.mesh, in the house's frame.
void BuildBayHouse(FacadeContext& context, const BayHouse& house, EntityId building, EntityId roof);

/// Where the stoop lies along the front (its middle), and how far it may reach before it, metres.
float BayHouseStoop(const BayHouse& house);
inline constexpr float kStoopReach = 2.2f;

}  // namespace airsim360
