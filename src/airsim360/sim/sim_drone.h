// One kind of drone of a simulation: everything about it that never changes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/flight/collision/contact.h"
#include "airsim360/flight/control/autopilot.h"
#include "airsim360/flight/dynamics/dynamics.h"
#include "airsim360/sensors/sensor_set.h"

namespace airsim360 {

struct DroneSetup {
  std::string name;  ///< unique among the drones of a simulation
  DroneModel model;
  AutopilotOptions autopilot = {};
  ContactProperties contact = {};
  SensorSet sensors = SensorSet::Standard();
  RigidTransform X_WB = {};     ///< where it starts and where a reset puts it
  bool airborne = false;        ///< starts hovering there; else it stands, disarmed, on what is below
  bool crash_disarms = true;    ///< an impact above contact.crash_speed stops the rotors until a reset
  uint32_t instance = kMiss;    ///< its body in Scene::instances (AddDroneBodies); kMiss = it is not seen
  EntityId entity = kNoEntity;  ///< of the body
};

/// A setup with what is worked out from it once. Immutable; shared by all snapshots.
class SimDrone {
 public:
  /// InputError naming the drone if its model cannot fly, a sensor makes no sense, or the control period is
  /// no multiple of the step.
  SimDrone(DroneSetup setup, int64_t dt_ns);

  const DroneSetup& setup() const { return setup_; }
  const DroneModel& model() const { return setup_.model; }
  const DroneDynamics& dynamics() const { return dynamics_; }
  const Autopilot& autopilot() const { return autopilot_; }
  int64_t control_ns() const { return control_ns_; }
  /// Below this distance from the rotor plane to the ground its effect is felt, metres.
  double ground_range() const { return ground_range_; }
  /// Of a sphere around the box, metres.
  double radius() const { return radius_; }

 private:
  DroneSetup setup_;
  DroneDynamics dynamics_;
  Autopilot autopilot_;
  int64_t control_ns_;
  double ground_range_ = 0, radius_ = 0;
};

}  // namespace airsim360
