// State and control of vehicles.
#include <cmath>

#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/coordinates/ned.h"
#include "airsim360/rpc/session/vehicle_state.h"
#include "airsim360/rpc/wire/limits.h"

namespace airsim360 {
namespace {

void SetKinematics(Session& s, const airsim::KinematicsState& state, const std::string& name) {
  const VehicleControl& control = s.control(name);
  Vehicle& vehicle = s.vehicle(control);
  // Told in the client's own frames.
  CheckVelocity("linear_velocity", airsim::FromVector(state.linear_velocity), "m/s");
  CheckVelocity("angular_velocity", airsim::FromVector(state.angular_velocity), "rad/s");
  const Vec3d v_W = NedFromWorld(airsim::FromVector(state.linear_velocity));
  const Vec3d w_B = FrdFromBody(airsim::FromVector(state.angular_velocity));
  s.Teleport(control, airsim::FromPose({state.position, state.orientation}, control.status().origin_W));
  vehicle.motion.v_WB = vehicle.drone.v_WB = v_W;
  vehicle.motion.w_WB_B = vehicle.drone.w_WB_B = w_B;
}

void AddControlCalls(Api& api) {
  api.Change("enableApiControl", [](Session& s, bool enabled, const std::string& vehicle) { s.control(vehicle).EnableApi(enabled); });
  api.Read("isApiControlEnabled",
           [](const Snapshot& now, const std::string& vehicle) { return now.vehicles[now.Find(vehicle)].api_control; });
  api.Change("armDisarm", [](Session& s, bool arm, const std::string& vehicle) { return s.drone(vehicle).Arm(arm); });
  api.Change("cancelLastTask", [](Session& s, const std::string& vehicle) { s.control(vehicle).Cancel(); });
  api.Change("moveByRC", [](Session& s, const airsim::RCData& rc, const std::string& vehicle) { s.control(vehicle).rc() = rc; });
}

void AddStateCalls(Api& api) {
  api.Read("getMultirotorState", [&api](const Snapshot& now, const std::string& vehicle) {
    return MultirotorStateOf(now, now.Find(vehicle), api.session().settings().collision_in_state);
  });
  api.Read("getRotorStates", [](const Snapshot& now, const std::string& vehicle) { return RotorStatesOf(now, now.Find(vehicle)); });
  api.Read("simGetGroundTruthKinematics",
           [](const Snapshot& now, const std::string& vehicle) { return KinematicsOf(now, now.Find(vehicle)); });
  api.Read("simGetPhysicsRawKinematics",
           [](const Snapshot& now, const std::string& vehicle) { return KinematicsOf(now, now.Find(vehicle)); });
  api.Read("simGetGroundTruthEnvironment",
           [](const Snapshot& now, const std::string& vehicle) { return EnvironmentOf(now, now.Find(vehicle)); });
  // Reading the collision ends it.
  api.Change("simGetCollisionInfo", [](Session& s, const std::string& vehicle) {
    VehicleControl& control = s.control(vehicle);
    return CollisionOf(*s.snapshot(), control.index(), control.TakeCollision());
  });
}

void AddVehiclePoseCalls(Api& api) {
  api.Read("simGetVehiclePose", [](const Snapshot& now, const std::string& vehicle) {
    const size_t i = now.Find(vehicle);
    return airsim::ToPose(now.state.vehicles[i].motion.X_WB, now.vehicles[i].origin_W);
  });
  api.Change("simSetVehiclePose", [](Session& s, const airsim::PoseChange& pose, bool /*ignore_collision*/, const std::string& vehicle) {
    const VehicleControl& control = s.control(vehicle);
    s.Teleport(control, airsim::Changed(s.vehicle(control).motion.X_WB, pose, control.status().origin_W));
  });
  api.Change("simSetKinematics", [](Session& s, const airsim::KinematicsState& state, bool /*ignore_collision*/,
                                    const std::string& vehicle) { SetKinematics(s, state, vehicle); });
  api.Change("simSetPhysicsRawKinematics",
             [](Session& s, const airsim::KinematicsState& state, const std::string& vehicle) { SetKinematics(s, state, vehicle); });
  api.Change("simAddVehicle",
             [](Session& s, const std::string& name, const std::string& type, const airsim::Pose& pose, const std::string& /*pawn_path*/) {
               return s.AddVehicle(name, type, airsim::FromPose(pose, s.origin_W()));
             });
}

Vec3d ThreeGains(const std::vector<float>& gains) {
  if (gains.size() != 3) throw std::invalid_argument("gains are three numbers");
  return {gains[0], gains[1], gains[2]};
}

// Integral and derivative gains are not there in our cascade but for the height.
void NoticeGains(const char* name, const std::vector<float>& ki, const std::vector<float>& kd) {
  ThreeGains(ki), ThreeGains(kd);
  for (size_t i = 0; i < 3; ++i) {
    if ((ki[i] != 0 && !(std::string_view(name) == "velocity" && i == 2)) || kd[i] != 0) {
      NoticeOnce(std::string(name) + " controller: integral and derivative gains count for nothing, but the " +
                 "integral of the vertical velocity");
    }
  }
}

void AddGainCalls(Api& api) {
  using Gains = const std::vector<float>&;
  api.Change("setAngleRateControllerGains", [](Session& s, Gains kp, Gains ki, Gains kd, const std::string& vehicle) {
    VehicleControl& control = s.control(vehicle);
    NoticeGains("angle rate", ki, kd);
    control.gains.rate_p = ThreeGains(kp);
    s.GainsChanged(control);
  });
  api.Change("setAngleLevelControllerGains", [](Session& s, Gains kp, Gains ki, Gains kd, const std::string& vehicle) {
    VehicleControl& control = s.control(vehicle);
    NoticeGains("angle level", ki, kd);
    control.gains.level_p = ThreeGains(kp);
    s.GainsChanged(control);
  });
  api.Change("setVelocityControllerGains", [](Session& s, Gains kp, Gains ki, Gains kd, const std::string& vehicle) {
    VehicleControl& control = s.control(vehicle);
    NoticeGains("velocity", ki, kd);
    control.gains.velocity_p = ThreeGains(kp);
    control.gains.velocity_i_z = ki[2];
    s.GainsChanged(control);
  });
  api.Change("setPositionControllerGains", [](Session& s, Gains kp, Gains ki, Gains kd, const std::string& vehicle) {
    VehicleControl& control = s.control(vehicle);
    NoticeGains("position", ki, kd);
    control.gains.position_p = ThreeGains(kp);
    s.GainsChanged(control);
  });
}

}  // namespace

void AddVehicleCalls(Api& api) {
  AddControlCalls(api);
  AddStateCalls(api);
  AddVehiclePoseCalls(api);
  AddGainCalls(api);
}

}  // namespace airsim360
