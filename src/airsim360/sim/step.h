// The simulation: a constant model, a copyable state and one function that advances it by one fixed step.
// docs/internals/one_step.md walks through the step.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "airsim360/people/crowd/crowd.h"
#include "airsim360/routes/route.h"
#include "airsim360/sensors/sensor_set.h"
#include "airsim360/sim/sim_drone.h"
#include "airsim360/sim/world_wind.h"
#include "airsim360/trace/ray_tracer.h"
#include "airsim360/traffic/near_miss.h"

namespace airsim360 {

struct SimPeople;     // sim/people/people.h
struct PeopleState;   // likewise
struct SimTraffic;    // sim/traffic/traffic.h
struct TrafficState;  // likewise

/// Length of a step of simulations with nothing but vehicles that follow routes.
inline constexpr int64_t kRouteStepNs = 20'000'000;

/// What never changes during a run. Shared, read-only.
struct SimModel {
  std::shared_ptr<const RayTracer> tracer;                   ///< what vehicles touch: the scene without drones' bodies and people
  int64_t dt_ns = 1'000'000;                                 ///< length of a step, > 0
  float contact_range = 2;                                   ///< metres up to which clearance is measured
  std::vector<std::shared_ptr<const SimDrone>> drones = {};  ///< by vehicle; further ones only follow routes
  SensorWorld world = {};                                    ///< place on the Earth, weather, seed
  WorldWind wind = {};
  int64_t trace_period_ns = 100'000'000;                ///< between samples of a vehicle's trace
  size_t trace_samples = 0;                             ///< newest samples that a vehicle keeps; 0 = no trace
  std::shared_ptr<const SimPeople> people = nullptr;    ///< null = nobody
  std::shared_ptr<const SimTraffic> traffic = nullptr;  ///< null = no vehicles drive
};

/// Following a route from the step in which the command was applied.
struct FollowRoute {
  std::shared_ptr<const Route> route;
  int64_t start_ns = 0;
};

/// The last collision of a vehicle (docs/guide/flying.md, Events). Stays until the next one, or a reset.
struct CollisionInfo {
  uint64_t count = 0;  ///< collisions so far; standing, taking off and setting down are none
  int64_t t_ns = 0;
  Vec3d p_W;                    ///< on the surface
  Vec3d normal_W;               ///< unit, away from the surface
  Vec3d p_WB;                   ///< where the vehicle was
  double impact_speed = 0;      ///< m/s along the normal
  double penetration = 0;       ///< metres put right
  EntityId entity = kNoEntity;  ///< Scene::entities, kNoEntity: another drone without a body, or the edge
};

struct TraceSample {
  int64_t t_ns = 0;
  Vec3d p_WB;
  Quaternion q_WB;
};

struct Vehicle {
  Kinematics motion;
  Vec3d a_WB;                            ///< acceleration of B in W, m/s^2: mean over the last step
  float clearance = 0;                   ///< metres to the nearest surface, at most SimModel::contact_range; of flying drones
                                         ///< as it was at the last multiple of kClearancePeriodNs
  std::optional<FollowRoute> following;  ///< set: moved along a route, whatever the dynamics say

  // Of drones. `motion` is the same as `drone`, as sensors want it.
  Vec3d alpha_WB_B;  ///< angular acceleration, mean over the last step
  DroneState drone;
  RotorSpeeds rotor_commands{};
  RotorHealth health = kAllRotorsWork;
  AutopilotState autopilot;
  ActiveCommand command;
  ContactState contact;
  bool touching = false;    ///< in the last step
  int64_t still_ns = 0;     ///< for how long it has lain still, disarmed; see kSleepNs
  int64_t touched_ns = -1;  ///< when it last touched anything; -1 = never
  CollisionInfo collision;
  WindState gusts = StartWind(0, 0);
  double shelter = 1;  ///< factor of the mean wind, follows ShelterFactor within kShelterTime
  Vec3d wind_W;        ///< velocity of the air at the vehicle in the last step
  SensorStates sensors;
  std::vector<TraceSample> trace;  ///< oldest first
};

inline constexpr int64_t kClearancePeriodNs = 10'000'000;
/// A disarmed drone that lies still for so long in calm air is not integrated until something changes: it is
/// armed, the wind rises, or another drone comes near.
inline constexpr int64_t kSleepNs = 500'000'000;

/// Everything that changes. A copy is a snapshot; assigning one back restores it, and the same bytes follow.
struct SimState {
  int64_t step = 0;
  int64_t t_ns = 0;  ///< step * dt_ns
  Vec3d wind_W;      ///< mean wind 10 m above the ground, m/s; WindCommand sets it
  std::vector<Vehicle> vehicles;
  /// Of SimModel::people, at the newest multiple of kCrowdTickNs of their time; null = nobody. Never changed
  /// while a snapshot shares it.
  std::shared_ptr<const PeopleState> people = nullptr;
  /// Of SimModel::traffic, likewise; null = no vehicles drive.
  std::shared_ptr<const TrafficState> traffic = nullptr;
};

/// What a vehicle, or the world, can be told. A drone that is given a Command flies; one that is given a
/// route is moved along it.
struct GimbalCommand {
  size_t gimbal = 0;
  GimbalAngles angles;
};
struct RotorHealthCommand {
  RotorHealth health = kAllRotorsWork;
};
struct ResetCommand {
  std::optional<RigidTransform> X_WB = {};  ///< none: where it started
  std::optional<bool> airborne = {};        ///< none: as it started
};
struct WindCommand {
  Vec3d wind_W;  ///< for the whole world, whatever the vehicle
};
struct PersonCommand {
  PersonIndex person = 0;  ///< of CrowdModel::people, whatever the vehicle
  PersonAction action;
};
struct FlightCommand {
  Command command;
  int64_t timeout_ns = 0;  ///< as ActiveCommand
};

struct SimCommand {
  size_t vehicle = 0;
  std::variant<std::shared_ptr<const Route>, FlightCommand, GimbalCommand, RotorHealthCommand, ResetCommand, WindCommand, PersonCommand>
      action;
};

inline constexpr size_t kNoDrone = SIZE_MAX;

/// Something that happened in a step.
struct SimEvent {
  enum class Kind {
    kCollision,
    kCrash,
    kCommandRefused,
    kCommandLost,
    kCommandDone,
    kFence,
    kRotorFailed,
    kBatteryLow,
    kBatteryEmpty,
    kWorldEdge,
    kNearPerson,
    kNearMiss,
  };
  Kind kind;
  size_t vehicle = 0;  ///< kNoDrone: of kNearMiss without one
  int64_t t_ns = 0;
  CollisionInfo collision = {};    ///< of kCollision and kCrash
  std::string text = {};           ///< of kCommandRefused: why; of kNearPerson and kNearMiss: who, and how near
  PersonIndex person = kNoPerson;  ///< of kNearPerson
  NearMiss near_miss = {};         ///< of kNearMiss; its time is the simulation's
};
inline constexpr const char* kSimEventNames[] = {"collision",     "crash",      "command refused", "command lost",
                                                 "command done",  "fence",      "rotor failed",    "battery low",
                                                 "battery empty", "world edge", "near person",     "near miss"};

/// A vehicle at rest that only follows routes.
Vehicle VehicleAt(const SimModel& model, const RigidTransform& X_WB);
/// Drone `i` of the model at a pose: hovering, or standing disarmed on what is below.
Vehicle DroneAt(const SimModel& model, const SimState& state, size_t i, const RigidTransform& X_WB, bool airborne);
/// All drones of the model at their starts, at time 0.
SimState StartState(const SimModel& model);

/// InputError for a command that Step would refuse with one.
void CheckCommand(const SimModel& model, const SimState& state, const SimCommand& command);

/// Applies `commands` at the state's time, then advances it by one dt. Adds what happened to `events` in the
/// order of the vehicles, if given. InputError for a vehicle, gimbal or person that does not exist, or for a flight
/// command to a vehicle that is no drone; a command that a drone cannot fly is refused with an event.
void Step(const SimModel& model, std::span<const SimCommand> commands, SimState& state, std::vector<SimEvent>* events = nullptr);

/// 64-bit hash of every number of the state: equal states have equal hashes on every machine with the same
/// arithmetic. Routes, paths and trajectories count by their start alone.
uint64_t HashState(const SimState& state);

/// Motion of a vehicle as its sensors feel it.
BodyMotion MotionOf(const Vehicle& vehicle);

}  // namespace airsim360
