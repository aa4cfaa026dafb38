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
          {"velocity", Triple(X_WB.R.column(0) * vehicle.v)},
          {"indicator", vehicle.indicator > 0   ? "left"
                        : vehicle.indicator < 0 ? "right"
                                                : "off"},
          {"braking", vehicle.braking},
          {"stopped", vehicle.stopped_ns >= 0}};
}

}  // namespace

std::string VehiclesJsonl(const SimTraffic& traffic, const Flight& flight) {
  std::string lines;
  for (size_t frame = 0; frame < flight.shots.size(); ++frame) {
    const Shot& shot = flight.shots[frame];
    Json vehicles = Json::array();
    for (size_t i = 0; shot.traffic && i < traffic.bodies.size(); ++i) {
      const RigidTransform X_WB = PoseOf(traffic.model, *shot.traffic, i, shot.t_ns + traffic.epoch_ns);
      if (Norm(X_WB.p - shot.body.X_WB.p) <= kVehicleLabelReach) vehicles.push_back(VehicleJson(traffic, *shot.traffic, i, X_WB));
    }
    lines += Json{{"frame", frame}, {"t_ns", shot.t_ns}, {"vehicles", std::move(vehicles)}}.dump() + "\n";
  }
  return lines;
}

}  // namespace airsim360
