#include "airsim360/rpc/session/vehicle_state.h"

#include "airsim360/math/standard_atmosphere.h"
#include "airsim360/rpc/coordinates/ned.h"

namespace airsim360 {

using airsim::ToVector;

airsim::GeoPoint GeoPointOf(const Snapshot& now, Vec3d p_W) {
  const GeoPoint point = now.model->world.frame.ToGeodetic(p_W);
  return {point.latitude_deg, point.longitude_deg, static_cast<float>(point.altitude)};
}

airsim::KinematicsState KinematicsOf(const Snapshot& now, size_t vehicle) {
  const Vehicle& state = now.state.vehicles[vehicle];
  const airsim::Pose pose = airsim::ToPose(state.motion.X_WB, now.vehicles[vehicle].origin_W);
  return {pose.position,
          pose.orientation,
          ToVector(NedFromWorld(state.motion.v_WB)),
          ToVector(FrdFromBody(state.motion.w_WB_B)),
          ToVector(NedFromWorld(state.a_WB)),
          ToVector(FrdFromBody(state.alpha_WB_B))};
}

airsim::CollisionInfo CollisionOf(const Snapshot& now, size_t vehicle, bool has_collided) {
  const CollisionInfo& last = now.state.vehicles[vehicle].collision;
  airsim::CollisionInfo info;
  info.has_collided = has_collided;
  if (last.count == 0) return info;
  const Vec3d origin_W = now.vehicles[vehicle].origin_W;
  info.penetration_depth = static_cast<float>(last.penetration);
  info.time_stamp = now.epoch_ns + static_cast<uint64_t>(last.t_ns);
  info.normal = ToVector(NedFromWorld(last.normal_W));
  info.impact_point = ToVector(NedFromWorld(last.p_W - origin_W));
  info.position = ToVector(NedFromWorld(last.p_WB - origin_W));
  if (last.entity != kNoEntity) {
    const auto given = now.world->names.find(last.entity);
    info.object_name = given != now.world->names.end() ? given->second : now.model->tracer->scene().entity(last.entity).name;
    info.object_id = static_cast<int>(now.world->segmentation[last.entity]);
  }
  return info;
}

airsim::MultirotorState MultirotorStateOf(const Snapshot& now, size_t vehicle, bool collision) {
  airsim::MultirotorState state;
  // AirSim never fills this one.
  if (collision) state.collision = CollisionOf(now, vehicle, now.vehicles[vehicle].has_collided);
  state.kinematics_estimated = KinematicsOf(now, vehicle);
  state.gps_location = GeoPointOf(now, now.state.vehicles[vehicle].motion.X_WB.p);
  state.timestamp = now.time_stamp();
  state.landed_state = now.vehicles[vehicle].landed;
  state.rc_data = now.vehicles[vehicle].rc;
  return state;
}

airsim::RotorStates RotorStatesOf(const Snapshot& now, size_t vehicle) {
  airsim::RotorStates states;
  states.timestamp = now.time_stamp();
  if (vehicle >= now.model->drones.size()) return states;
  const auto& rotors = now.model->drones[vehicle]->model().rotors;
  for (size_t i = 0; i < rotors.size(); ++i) {
    const double speed = now.state.vehicles[vehicle].drone.rotor_speeds[i];
    const double thrust = ThrustAtSpeed(rotors[i], speed);
    // Torque about F's down axis, with the sign of the turning direction.
    states.rotors.push_back({static_cast<float>(thrust), static_cast<float>(-rotors[i].direction * thrust * rotors[i].torque_ratio),
                             static_cast<float>(speed)});
  }
  return states;
}

airsim::EnvironmentState EnvironmentOf(const Snapshot& now, size_t vehicle) {
  const RigidTransform& X_WB = now.state.vehicles[vehicle].motion.X_WB;
  airsim::EnvironmentState state;
  state.position = ToVector(NedFromWorld(X_WB.p - now.vehicles[vehicle].origin_W));
  state.geo_point = GeoPointOf(now, X_WB.p);
  state.gravity = {0, 0, static_cast<float>(kGravity)};
  const Air air = StandardAir(state.geo_point.altitude, now.model->world.sea_level_pressure);
  state.air_pressure = static_cast<float>(air.pressure);
  state.temperature = static_cast<float>(air.temperature);
  state.air_density = static_cast<float>(air.density);
  return state;
}

}  // namespace airsim360
