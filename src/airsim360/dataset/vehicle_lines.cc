#include "airsim360/dataset/vehicle_lines.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

// Hundredths of a millimetre are more than anybody sees, and half the bytes.
double Rounded(double value) { return std::round(value * 1e5) / 1e5 + 0.0; }
Json Triple(Vec3d v) { return {Rounded(v.x), Rounded(v.y), Rounded(v.z)}; }

Json VehicleJson(const SimTraffic& traffic, const TrafficState& state, size_t i, const RigidTransform& X_WB) {
  const TrafficBody& body = traffic.bodies[i];
  const VehicleShape& shape = traffic.model.vehicles[i].shape;
  const DrivingVehicle& vehicle = state.vehicles[i];
  const Quaternion q = ToQuaternion(X_WB.R);
  return {{"entity", body.entity},
          {"name", body.name},
          {"category", body.kind},
          {"X_WB", {{"p", Triple(X_WB.p)}, {"q_wxyz", {q.w, q.x, q.y, q.z}}}},
          {"size", Triple({shape.length, shape.width, shape.height})},
          {"velocity", Triple(VelocityOf(traffic.model, state, i))},
          {"lane", vehicle.lane},
          {"lane_position", Rounded(vehicle.s)},
          {"indicator", IndicatorName(vehicle)},
          {"braking", vehicle.braking},
          {"stopped", vehicle.stopped_ns >= 0}};
}

// One of the two of a near miss; drones have no entity here.
Json UserJson(const SimTraffic& traffic, const SimPeople* people, const RoadUser& user) {
  if (user.kind == RoadUser::Kind::kVehicle)
    return {{"name", traffic.bodies[user.index].name}, {"entity", traffic.bodies[user.index].entity}};
  if (user.kind == RoadUser::Kind::kDrone || people == nullptr) return {{"name", "drone"}};
  Json json = {{"name", people->cast[user.index].name}};
  if (!people->refs.empty()) json["entity"] = people->refs[user.index].entity;
  return json;
}

// Those after the frame before, up to this one.
Json NearMissesJson(const SimTraffic& traffic, const SimPeople* people, const Flight& flight, size_t frame) {
  const int64_t until = flight.shots[frame].t_ns, after = frame > 0 ? flight.shots[frame - 1].t_ns : INT64_MIN;
  Json list = Json::array();
  for (const NearMiss& miss : flight.near_misses) {
    if (miss.t_ns <= after || miss.t_ns > until) continue;
    list.push_back({{"t_ns", miss.t_ns},
                    {"first", UserJson(traffic, people, miss.a)},
                    {"second", UserJson(traffic, people, miss.b)},
                    {"time_to_collision", Rounded(miss.seconds)},
                    {"braking", Rounded(miss.braking)},
                    {"p", Triple(miss.p)}});
  }
  return list;
}

}  // namespace

std::string VehiclesJsonl(const SimTraffic& traffic, const Flight& flight, const SimPeople* people) {
  std::string lines;
  for (size_t frame = 0; frame < flight.shots.size(); ++frame) {
    const Shot& shot = flight.shots[frame];
    Json vehicles = Json::array();
    for (size_t i = 0; shot.traffic && i < traffic.bodies.size(); ++i) {
      const RigidTransform X_WB = PoseOf(traffic.model, *shot.traffic, i, shot.t_ns + traffic.epoch_ns);
      if (Norm(X_WB.p - shot.body.X_WB.p) <= kVehicleLabelReach) vehicles.push_back(VehicleJson(traffic, *shot.traffic, i, X_WB));
    }
    const Json line = {{"frame", frame},
                       {"t_ns", shot.t_ns},
                       {"vehicles", std::move(vehicles)},
                       {"near_misses", NearMissesJson(traffic, people, flight, frame)}};
    lines += line.dump() + "\n";
  }
  return lines;
}

}  // namespace airsim360
