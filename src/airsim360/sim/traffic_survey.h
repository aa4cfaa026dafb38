// How the traffic of a world does: speeds, standstills, near misses, and whether anybody drives through another.
#pragma once

#include <vector>

#include "airsim360/sim/step.h"

namespace airsim360 {

/// Of the times from the start of a simulation to some seconds later. A look is taken once a second.
struct TrafficSurvey {
  double seconds = 0;
  double mean_speed = 0;          ///< m/s, of all vehicles at all looks
  double standing = 0;            ///< share of vehicles that stand, of all looks
  double longest_standstill = 0;  ///< seconds, of the vehicle that stood longest
  double hardest_braking = 0;     ///< m/s^2, positive
  int64_t overlaps = 0;           ///< pairs of vehicles that were in each other at a look, by more than 0.1 m in length and width
  int64_t people_hit = 0;         ///< people whose middle was inside of a vehicle that moved at a look
  std::vector<NearMiss> near_misses;
  double tick_ms = 0, people_ms = 0;  ///< of the machine, a tick of 50 ms on the average; not for comparing results
};

/// Lets people and traffic of the model live for so long, without drones. The model has traffic.
TrafficSurvey SurveyTraffic(const SimModel& model, double seconds);

}  // namespace airsim360
