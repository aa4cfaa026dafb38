// The traffic at run time: which vehicles drive where, and near misses. Positions are in the global N frame (metres north, east,
// down of the origin), as in AirSim's calls about objects.
#include <stdexcept>

#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/sim/living_world.h"
#include "airsim360/sim/traffic/traffic.h"

namespace airsim360 {
namespace {

/// One vehicle in an answer.
struct TrafficInfo {
  std::string name, category, indicator;
  uint32_t entity_id = 0, track_id = 0, lane = 0;
  float lane_position = 0;  ///< metres from the beginning of the lane to the front
  bool braking = false, stopped = false;
  airsim::Pose pose;  ///< of the ground below its middle
  airsim::Vector3r velocity;
  airsim::Vector3r size;  ///< length, width, height
  template <class V>
  void Visit(V& v) {
    v("name", name), v("category", category), v("entity_id", entity_id), v("track_id", track_id);
    v("pose", pose), v("velocity", velocity), v("size", size);
    v("lane", lane), v("lane_position", lane_position);
    v("indicator", indicator), v("braking", braking), v("stopped", stopped);
  }
};

struct NearMissInfo {
  uint64_t time_stamp = 0;
  std::string first, second;  ///< names of the two
  float time_to_collision = 0, braking = 0;
  airsim::Vector3r position;  ///< of the first
  template <class V>
  void Visit(V& v) {
    v("time_stamp", time_stamp), v("first", first), v("second", second);
    v("time_to_collision", time_to_collision), v("braking", braking), v("position", position);
  }
};

const SimTraffic& TrafficOf(const SimModel& model) {
  if (!model.traffic) throw std::invalid_argument("no vehicles drive in this world; start the server with --traffic N");
  return *model.traffic;
}

TrafficInfo InfoOf(const SimTraffic& traffic, const SimState& state, size_t i, Vec3d origin_W) {
  const DrivingVehicle& vehicle = state.traffic->vehicles[i];
  const VehicleShape& shape = traffic.model.vehicles[i].shape;
  const RigidTransform X_WB = PoseOf(traffic.model, *state.traffic, i, state.t_ns + traffic.epoch_ns);
  TrafficInfo info;
  info.name = traffic.bodies[i].name;
  info.category = traffic.bodies[i].kind;
  info.indicator = IndicatorName(vehicle);
  info.entity_id = traffic.bodies[i].entity;
  info.track_id = static_cast<uint32_t>(i + 1);
  info.lane = vehicle.lane;
  info.lane_position = static_cast<float>(vehicle.s);
  info.braking = vehicle.braking;
  info.stopped = vehicle.stopped_ns >= 0;
  info.pose = airsim::ToPose(X_WB, origin_W);
  info.velocity = airsim::ToVector(NedFromWorld(VelocityOf(traffic.model, *state.traffic, i)));
  info.size = airsim::ToVector({shape.length, shape.width, shape.height});
  return info;
}

NearMissInfo InfoOf(const Snapshot& now, const NearMiss& miss, Vec3d origin_W) {
  NearMissInfo info;
  info.time_stamp = now.epoch_ns + static_cast<uint64_t>(miss.t_ns);
  info.first = NameOfRoadUser(*now.model, miss.a);
  // Vehicles of clients that are no drones have names here alone.
  const bool known = miss.b.kind == RoadUser::Kind::kDrone && miss.b.index < now.vehicles.size();
  info.second = known ? now.vehicles[miss.b.index].name : NameOfRoadUser(*now.model, miss.b);
  info.time_to_collision = static_cast<float>(miss.seconds);
  info.braking = static_cast<float>(miss.braking);
  info.position = airsim::ToVector(NedFromWorld(miss.p - origin_W));
  return info;
}

}  // namespace

void AddTrafficCalls(Api& api) {
  api.Read("simListTraffic", [](const Snapshot& now) {
    std::vector<std::string> names;
    for (const TrafficBody& body : TrafficOf(*now.model).bodies) names.push_back(body.name);
    return names;
  });
  api.Read("simGetTraffic", [&api](const Snapshot& now) {
    const SimTraffic& traffic = TrafficOf(*now.model);
    std::vector<TrafficInfo> list;
    for (size_t i = 0; i < traffic.bodies.size(); ++i) list.push_back(InfoOf(traffic, now.state, i, api.session().origin_W()));
    return list;
  });
  api.Read("simGetNearMisses", [&api](const Snapshot& now) {
    TrafficOf(*now.model);
    std::vector<NearMissInfo> list;
    for (size_t i = 0; now.near_misses && i < now.near_misses->size(); ++i)
      list.push_back(InfoOf(now, (*now.near_misses)[i], api.session().origin_W()));
    return list;
  });
}

}  // namespace airsim360
