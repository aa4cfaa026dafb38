// Vehicles that drive: a constant model, a copyable state and a tick. Pure: nothing of scenes or bodies.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "airsim360/math/transform.h"
#include "airsim360/traffic/car_following.h"
#include "airsim360/traffic/lane_map.h"
#include "airsim360/traffic/near_miss.h"

namespace airsim360 {

/// Length of a tick: that of the crowd (kCrowdTickNs), so that both are at the same instant.
inline constexpr int64_t kTrafficTickNs = 50'000'000;

/// What drives.
struct VehicleShape {
  double length = 4.5, width = 1.8, height = 1.5;  ///< metres
  bool bus = false;                                ///< may use lanes for buses
  bool bicycle = false;                            ///< keeps to the right, and to cycle lanes
  double wheel_radius = 0.345;                     ///< of a bicycle, metres
  double gear = 2.2;                               ///< turns of a bicycle's wheels while its cranks turn once
  /// Metres to the left of the middle of a lane; bicycles keep to the right edge of those that they share.
  double aside(const Lane& lane) const { return bicycle && !lane.cycle ? -1.0 : 0.0; }
  /// Metres from the front to the front axle and between the axles.
  double front_overhang() const { return 0.19 * length; }
  double wheelbase() const { return 0.6 * length; }
};

struct TrafficVehicle {
  VehicleShape shape;
  Driver driver;
};

/// Where buses halt: their front stands `s` metres from the beginning of the lane.
struct BusStop {
  LaneId lane = 0;
  double s = 0;
};

/// Room at the kerb where one may park, between others that stand there. Who has driven in has its front `s` metres from the beginning
/// of the lane and its middle `aside` metres to the left of the lane's; `run` metres behind its front are free.
struct ParkingBay {
  LaneId lane = 0;
  double s = 0, aside = 0, run = 0;
};
inline constexpr uint32_t kNoBay = UINT32_MAX;

/// How far one is with parking.
enum class Parking : uint8_t { kNone, kArriving, kStanding, kBacking, kWaiting, kLeaving };

/// What never changes.
struct TrafficModel {
  LaneMap lanes;
  std::vector<TrafficVehicle> vehicles;
  std::vector<BusStop> bus_stops = {};  ///< by lane, then by s
  std::vector<ParkingBay> bays = {};    ///< by lane, then by s
  uint64_t seed = 0;
  int64_t signal_ns = 0;  ///< time of the signals at traffic time 0
};

inline constexpr int64_t kLaneChangeNs = 3'500'000'000;

/// One vehicle. Its front is `s` metres from the beginning of its lane.
struct DrivingVehicle {
  LaneId lane = 0;
  std::array<LaneId, 2> ahead{kNoLane, kNoLane};            ///< lanes that it has chosen to take next
  std::array<LaneId, 3> behind{kNoLane, kNoLane, kNoLane};  ///< lanes that it came from, the latest first
  double s = 0, v = 0, a = 0;                               ///< m, m/s, m/s^2
  double shift = 0;                                         ///< metres to the left at the beginning of its last lane change
  LaneId left_lane = kNoLane;                               ///< the lane that it is still moving away from
  int64_t changed_ns = INT64_MIN / 2;                       ///< beginning of its last lane change
  int64_t stopped_ns = -1;                                  ///< since when it has stood; -1: it moves
  int64_t halts_until_ns = -1;                              ///< a bus at a stop; -1: it does not halt
  double served_s = -1;                                     ///< of its lane's bus stops: served up to here, m
  uint32_t bay = kNoBay;                                    ///< where it parks
  Parking parking = Parking::kNone;
  int64_t parks_until_ns = -1;  ///< while it stands in its bay
  double leaves_s = 0;          ///< where its front was when it left its bay, m
  uint32_t choices = 0;         ///< turns chosen so far: key of the next random number
  bool granted = false;         ///< the junction ahead, or around it, is held free for it
  bool braking = false;         ///< brake lamps
  int8_t indicator = 0;         ///< +1 left, -1 right
  double rolled = 0;            ///< of a bicycle: metres that its middle has come, forwards
  double crank = 0;             ///< of a bicycle: radians that its cranks have turned; at 0 the left pedal is lowest
};

/// Whether it is in a bay and out of the way of those who drive.
inline bool IsParked(const DrivingVehicle& vehicle) {
  return vehicle.parking == Parking::kStanding || vehicle.parking == Parking::kBacking || vehicle.parking == Parking::kWaiting;
}

struct TrafficState {
  int64_t t_ns = 0;
  std::vector<DrivingVehicle> vehicles;
  std::vector<Encounter> encounters = {};  ///< near misses under way, by a and b
};

/// Somebody or something in the street that vehicles stop for.
struct TrafficObstacle {
  Vec3d p;  ///< in W, at the height of the ground below it
  Vec3d v;
  double radius = 0.3;
  RoadUser who = {.kind = RoadUser::Kind::kPerson, .index = 0};
};

/// Vehicles at their starts: spread over all lanes outside of junctions, at rest apart from each other. InputError for more
/// than fit, naming how many do.
TrafficState StartTraffic(const TrafficModel& model);
/// How many vehicles of 5 m fit.
size_t TrafficCapacity(const LaneMap& lanes);

/// One tick. The same bytes for the same model, state and obstacles. Near misses that are over by now are added to `over`, if
/// given.
void TickTraffic(const TrafficModel& model, std::span<const TrafficObstacle> obstacles, TrafficState& state,
                 std::vector<NearMiss>* over = nullptr);

/// Body of a vehicle at t_ns, at most a tick after the state: origin on the ground below the middle, +X forward, +Z away
/// from the ground, as both axles stand on their lanes; bicycles lean into bends.
RigidTransform PoseOf(const TrafficModel& model, const TrafficState& state, size_t vehicle, int64_t t_ns);
/// Velocity of the same point, m/s in W.
Vec3d VelocityOf(const TrafficModel& model, const TrafficState& state, size_t vehicle);

/// Hash of every number.
uint64_t HashTraffic(const TrafficState& state);

}  // namespace airsim360
