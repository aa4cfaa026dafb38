// How many vehicles drive in a world.
#pragma once

#include <cstddef>
#include <cstdint>

namespace airsim360 {

struct TrafficRequest {
  size_t count = 0;     ///< vehicles that drive; 0 = none
  uint64_t seed = 0;    ///< of who they are, where they start and where they turn
  double warm_up = 30;  ///< seconds that they drive before the simulation begins

  bool any() const { return count > 0; }
};

}  // namespace airsim360
