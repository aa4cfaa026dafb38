// Finds near misses: when road users would touch if they went on as they do.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "airsim360/traffic/occupancy.h"
#include "airsim360/traffic/traffic.h"

namespace airsim360::internal {

/// A rectangle on the ground.
struct GroundBox {
  Vec2d center;
  Vec2d ahead{1, 0};  ///< unit vector along its length
  double half_length = 0, half_width = 0;
};

/// Seconds from now between which two overlap.
struct ContactTimes {
  double begin = 0, end = 0;
};

/// When two rectangles touch of which the second moves with velocity `v` as seen from the first, and neither turns: by the
/// separating axes of both. nullopt: never, before or after now.
std::optional<ContactTimes> ContactOf(const GroundBox& a, const GroundBox& b, Vec2d v);
/// The same of a rectangle and a disc around `center`.
std::optional<ContactTimes> ContactOf(const GroundBox& a, Vec2d center, double radius, Vec2d v);

/// Every pair of vehicles, of a vehicle and a person on the carriageway, and of a vehicle and a drone that is critical at
/// state.t_ns, by a and b. Vehicles are thought to keep their speeds along the ways that they have chosen, others their velocities.
/// Pairs of vehicles: one behind the other, or both let into the same junction.
std::vector<NearMiss> CriticalPairs(const TrafficModel& model, const TrafficState& state, const Occupancy& occupancy,
                                    std::span<const TrafficObstacle> obstacles);

/// Begins, goes on with and ends the encounters of a state. Those that were not critical for half a second are over.
void UpdateEncounters(std::span<const NearMiss> critical, int64_t t_ns, std::vector<Encounter>& encounters, std::vector<NearMiss>* over);

}  // namespace airsim360::internal
