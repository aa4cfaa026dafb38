// What everybody but the simulation's own thread sees: one instant of everything, never changed once
// published.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "airsim360/base/pattern.h"
#include "airsim360/rpc/session/airsim_drone.h"
#include "airsim360/rpc/session/cameras.h"
#include "airsim360/rpc/session/objects.h"
#include "airsim360/rpc/wire/airsim_types.h"
#include "airsim360/scene/environment.h"
#include "airsim360/sim/step.h"

namespace airsim360 {

/// What SetDetectionFilter… calls have asked of one camera.
struct DetectionFilter {
  double radius = 20;                                    ///< metres
  std::vector<std::shared_ptr<const Pattern>> patterns;  ///< wildcards; case counts
};

/// Lines, points and texts that simPlot… calls have drawn: kept, not shown.
struct PlotCounts {
  uint64_t drawn = 0, persistent = 0;
};

/// The part of the world that calls change and steps do not. Copied when it changes.
struct WorldView {
  std::map<EntityId, ObjectPlace> places;                    ///< objects that are not where the scene has them
  ObjectNames names;                                         ///< of drones and objects that calls have added
  std::vector<uint32_t> segmentation;                        ///< id by entity; [0] for what is none
  std::map<std::string, std::vector<uint32_t>> annotations;  ///< Cosys layers: value by entity
  std::vector<CameraMap> cameras;                            ///< by vehicle
  CameraMap external_cameras;
  std::vector<RaySensors> ray_sensors;                                  ///< by vehicle
  std::map<std::pair<size_t, std::string>, DetectionFilter> detection;  ///< by vehicle and camera
  Environment first_environment;                                        ///< the world's own
  Environment base_environment;                                         ///< without the weather of calls
  bool weather_enabled = false;                                         ///< simEnableWeather
  std::array<float, 8> weather{};                                       ///< simSetWeatherParameter, 0 ... 1, by WeatherParameter
  Environment environment;                                              ///< what is rendered
  uint64_t environment_version = 0;                                     ///< grows with every change of `environment`
  PlotCounts plots;
};

/// One vehicle beyond what SimState knows of it.
struct VehicleStatus {
  std::string name;
  bool is_drone = true;
  Vec3d origin_W;  ///< of its N frame: where it started
  bool api_control = false, armed = false;
  airsim::LandedState landed = airsim::LandedState::kLanded;
  bool has_collided = false;  ///< since the last simGetCollisionInfo
  airsim::RCData rc;
};

inline constexpr size_t kMostNearMisses = 1000;

struct Snapshot {
  SimState state;
  std::vector<VehicleStatus> vehicles;
  std::shared_ptr<const SimModel> model;
  std::shared_ptr<const WorldView> world;
  std::shared_ptr<const std::vector<NearMiss>> near_misses;  ///< that are over, the latest kMostNearMisses; null: none
  bool paused = false;
  uint64_t epoch_ns = 0;  ///< sim time 0 on the clients' clock
  double real_time_factor = 1;

  uint64_t time_stamp() const { return epoch_ns + static_cast<uint64_t>(state.t_ns); }
  /// Index of a vehicle; "" is the first. std::runtime_error with AirSim's text if there is none.
  size_t Find(const std::string& name) const;
};
using SnapshotPointer = std::shared_ptr<const Snapshot>;

/// What AirSim says of a vehicle that it does not have.
std::string NoVehicleText(const std::string& name);

}  // namespace airsim360
