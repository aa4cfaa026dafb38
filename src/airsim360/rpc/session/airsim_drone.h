// AirSim's default quadrotor and its sensors as our drones have them.
#pragma once

#include "airsim360/rpc/settings/settings.h"
#include "airsim360/sim/sim_drone.h"

namespace airsim360 {

/// Distance sensors and lidars are functions of a snapshot; these are their specs by name.
struct RaySensors {
  struct Lidar {
    std::string name;
    LidarSpec spec;
    bool sensor_local_frame = false;
    bool gpu = false;                 ///< of Cosys-AirSim's type: the first that getGPULidarData finds without a name
    double sigma = 0, far_sigma = 0;  ///< metres, of ranges 0 and max_range; in between it grows evenly
  };
  struct Distance {
    std::string name;
    RangeFinderSpec spec;
  };
  std::vector<Lidar> lidars;
  std::vector<Distance> distances;
};

/// Rotors in AirSim's order: front right, rear left, front left, rear right. Figures of
/// microsoft/AirSim, AirLib/include/vehicles/multirotor/MultiRotorParams.hpp and RotorParams.hpp.
DroneModel AirSimQuad();

/// A drone of the settings at its start. `gains`: what set...ControllerGains have changed.
DroneSetup MakeDroneSetup(const std::string& name, const AirSimSettings& settings, const VehicleSettings& vehicle,
                          const SimpleFlightGains& gains, const RigidTransform& X_WB);

/// Lidars and distance sensors of a vehicle.
RaySensors MakeRaySensors(const AirSimSettings& settings, const VehicleSettings& vehicle);

/// Mount of a sensor or camera; what the settings leave out is taken from `otherwise`.
RigidTransform MountOf(const SettingsPose& pose, const SettingsPose& otherwise);

inline constexpr int64_t kPhysicsStepNs = 1'000'000, kControlStepNs = 3'000'000;  ///< AirSim controls at 3 ms

}  // namespace airsim360
