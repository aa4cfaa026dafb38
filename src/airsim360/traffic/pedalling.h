// Wheels and cranks of bicycles, and how they lean.
#pragma once

#include <cstddef>
#include <cstdint>

#include "airsim360/traffic/traffic.h"

namespace airsim360 {

/// Radians that the wheels and cranks of a bicycle have turned, forwards: about +Y of B.
struct Cycling {
  double wheel = 0;
  double crank = 0;  ///< at 0 the left pedal is lowest
};

/// Where they are at t_ns, at most a tick after the state. Wheels roll without slip; cranks turn with them through the gear while
/// the rider pushes, else only on until the pedals are level or the bicycle stands.
Cycling CyclingOf(const TrafficModel& model, const TrafficState& state, size_t vehicle, int64_t t_ns);

namespace internal {

/// Turns cranks on from `crank` over `distance` metres, at speed `v` and acceleration `a`.
double CrankAfter(const VehicleShape& shape, double crank, double distance, double v, double a);
/// Adds the way of a bicycle in a tick: `state` is that after it.
void Pedal(const TrafficModel& model, const TrafficState& before, uint32_t vehicle, TrafficState& state);
/// Radians that a bicycle leans to the left `moved` metres on from where it is: its weight balances the bend,
/// tan(lean) = v^2 k / g.
double LeanInBend(const TrafficModel& model, const DrivingVehicle& own, const VehicleShape& shape, double moved);

}  // namespace internal
}  // namespace airsim360
