// The rules under which benchmarks of aerial navigation fly. How they score is eval's.
#pragma once

#include <span>
#include <string>

#include "airsim360/eval/navigation/vln_scores.h"
#include "airsim360/vln/agents/answer.h"

namespace airsim360 {

struct FlightRules {
  const char* name;
  const char* scores;                           ///< FindVlnProtocol
  double radius;                                ///< metres of success; 0 = each episode's own
  bool collision_ends;                          ///< touching anything ends the episode
  int64_t steps;                                ///< decisions at most
  Decisions decisions;                          ///< unless asked otherwise
  double forward, lateral, vertical, turn_deg;  ///< of steps; metres, degrees
  const char* source;
};

/// ours, aerialvln, openfly, citynav, traveluav, uavon.
std::span<const FlightRules> AllFlightRules();
/// InputError naming --protocol and the nearest there is.
const FlightRules& FindFlightRules(const std::string& name);

}  // namespace airsim360
