// What lives in a world without being told: people and traffic.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "airsim360/people/crowd/crowd.h"
#include "airsim360/sim/step.h"
#include "airsim360/traffic/traffic.h"

namespace airsim360 {

/// One tick of the people among vehicles, which they look at where these are; `traffic` is null where nothing drives.
void TickPeopleAmong(const SimModel& model, const TrafficState* traffic, std::span<const CrowdDrone> drones, PeopleState& people,
                     std::vector<CrowdEvent>* events = nullptr);
/// One tick of the traffic, which looks at people (null = nobody) and at what else is in its way. Near misses that are over are
/// added to `over`.
void TickTrafficAmong(const SimModel& model, const PeopleState* people, TrafficState& traffic, std::vector<NearMiss>* over,
                      std::span<const TrafficObstacle> others = {});

/// Puts the people and the traffic of the model where they are at time 0.
void StartLife(const SimModel& model, SimState& state);

/// Brings both to the last of their ticks that is not after the end of the step that begins at state.t_ns. Near passes of
/// drones and people, and near misses on the roads, are added to `events`, if given.
void StepLife(const SimModel& model, SimState& state, std::vector<SimEvent>* events);

/// `traffic/012`, `person/007`, or the name of a drone.
const std::string& NameOfRoadUser(const SimModel& model, const RoadUser& user);
/// `traffic/012 and person/007 0.84 s before a crash`.
std::string TextOfNearMiss(const SimModel& model, const NearMiss& miss);

/// The people as vehicles see them.
std::vector<TrafficObstacle> ObstaclesOf(const PeopleState& people);

/// The vehicles that people may meet soon, as people see them.
std::vector<CrowdVehicle> VehiclesNear(const SimTraffic& traffic, const TrafficState& state, const PeopleState& people);

namespace internal {
/// The people of a state, to be changed: a copy if a snapshot has them too.
PeopleState& OwnPeople(SimState& state);
}  // namespace internal

}  // namespace airsim360
