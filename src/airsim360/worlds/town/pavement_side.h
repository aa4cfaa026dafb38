// The pavement along one side of a block, between the ramps at its ends: where street life stands.
#pragma once

#include "airsim360/worlds/town/district.h"

namespace airsim360::internal {

struct PavementSide {
  BlockSide line;
  float s0, s1, depth;                                  ///< metres along the side from ramp to ramp; from the kerb to the walls
  Vec2f street() const { return line.inward * -1.0f; }  ///< towards it
  Vec3f At(float s, float d) const {
    const Vec2f p = line.At(s, d);
    return {p.x, p.y, 0};
  }
};

/// Side `k` of a block, as SideOf counts them.
PavementSide SideBetweenRamps(const Block& block, int k);

/// Café tables in a row along the wall, from `s` on, each under an umbrella between two chairs.
struct CafeRow {
  int tables = 4;
  float pitch = 2.7f, from_wall = 1.45f;   ///< metres
  float umbrella = 0.9f, to_chair = 0.9f;  ///< size of the umbrella; metres from a table to its chairs
};
void PlaceCafeRow(District& d, const PavementSide& side, float s, const CafeRow& row, RngStream& rng);

}  // namespace airsim360::internal
