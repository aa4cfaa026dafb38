// What lives in a world without being told: people and traffic.
#pragma once

#include <vector>

#include "airsim360/sim/step.h"
#include "airsim360/traffic/traffic.h"

namespace airsim360 {

/// Puts the people and the traffic of the model where they are at time 0.
void StartLife(const SimModel& model, SimState& state);

/// Brings both to the last of their ticks that is not after the end of the step that begins at state.t_ns. Near passes of
/// drones and people are added to `events`, if given.
void StepLife(const SimModel& model, SimState& state, std::vector<SimEvent>* events);

/// The people as vehicles see them.
std::vector<TrafficObstacle> ObstaclesOf(const PeopleState& people);

namespace internal {
/// The people of a state, to be changed: a copy if a snapshot has them too.
PeopleState& OwnPeople(SimState& state);
}  // namespace internal

}  // namespace airsim360
