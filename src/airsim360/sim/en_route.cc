#include "airsim360/sim/en_route.h"

#include "airsim360/flight/control/return_phase.h"

namespace airsim360 {

bool IsEnRoute(const Vehicle& vehicle) {
  const FlightMode mode = vehicle.autopilot.mode;
  if (mode == FlightMode::kReturn) return vehicle.autopilot.phase < kReturnDown;
  return mode == FlightMode::kCommanded || mode == FlightMode::kHold;
}

}  // namespace airsim360
