// Buses halt at stops.
#pragma once

#include <span>
#include <vector>

#include "airsim360/traffic/traffic.h"

namespace airsim360 {

/// Stops of TrafficModel for signs or shelters that stand at these places of W, up to 9 m to the right of a lane between junctions. One
/// beside no such lane, or so near its beginning that a bus would stand in the junction, is none.
std::vector<BusStop> BusStopsBeside(const LaneMap& lanes, std::span<const Vec3d> places);

namespace internal {

/// Metres from the front of a bus to the next stop on its way that it has not served, to halt there; infinite: none within
/// 120 m, none that it can still brake for comfortably, or no bus.
double GapToBusStop(const TrafficModel& model, uint32_t vehicle, const DrivingVehicle& own);

/// Whether it has a stop before it on `lane`, from `s` metres on: a reason to be there.
bool ServesStopOn(const TrafficModel& model, uint32_t vehicle, LaneId lane, double s);

/// A bus that has come to rest at its stop stays for 8 to 20 s, and has then served it. To be called once a tick.
void ServeBusStop(const TrafficModel& model, uint32_t vehicle, int64_t t_ns, DrivingVehicle& own);

}  // namespace internal
}  // namespace airsim360
