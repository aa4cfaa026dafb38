// The traffic of a simulation: who drives (constant), what of it is in the scene, one tick of it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "airsim360/people/body/skinning.h"
#include "airsim360/scene/scene.h"
#include "airsim360/scene/scene_state.h"
#include "airsim360/sim/traffic/traffic_request.h"
#include "airsim360/traffic/traffic.h"

namespace airsim360 {

struct BicycleMeasures;

/// Lamps of a vehicle that burn now and then: instances of its entity, which are hidden meanwhile. kNoLamp: it has none.
inline constexpr uint32_t kNoLamp = UINT32_MAX;
struct VehicleLamps {
  uint32_t brake = kNoLamp, left = kNoLamp, right = kNoLamp;
};

/// What turns on a bicycle.
enum class BicyclePart : uint8_t { kFrontWheel, kRearWheel, kCranks, kLeftPedal, kRightPedal };
inline constexpr size_t kBicycleParts = 5;

inline constexpr uint32_t kNoRider = UINT32_MAX;

/// A vehicle in the scene.
struct TrafficBody {
  std::string name;  ///< of its entity: traffic/000
  std::string kind;  ///< path of its category: "vehicle/car"
  uint32_t instance = 0;
  EntityId entity = kNoEntity;
  float scale = 1;
  VehicleLamps lamps = {};
  uint32_t first_part = 0;                    ///< of a bicycle whose parts turn: its front wheel, before the others; 0: none
  const BicycleMeasures* measures = nullptr;  ///< of a bicycle
  uint32_t rider = kNoRider;                  ///< instance of who sits on a bicycle
  EntityId rider_entity = kNoEntity;
  Vec3f offset_M;  ///< from the origin of its mesh to the ground below the middle of its box, metres, unscaled
};

/// What never changes. Shared, read-only. `bodies` is as long as TrafficModel::vehicles.
struct SimTraffic {
  explicit SimTraffic(TrafficModel of) : model(std::move(of)) {}

  TrafficModel model;
  std::vector<TrafficBody> bodies;
  std::vector<PersonInScene> riders;  ///< in the order of their bicycles
  std::vector<PersonRef> rider_refs;
  std::vector<uint32_t> standing;             ///< instances of the scene's own vehicles where others drive or park: not shown
  std::shared_ptr<const TrafficState> start;  ///< at simulation time 0
  int64_t epoch_ns = 0;                       ///< traffic time at simulation time 0
};

struct TrafficScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const SimTraffic> traffic;  ///< null: none
};

/// The scene with vehicles after all that it has: ids of everything else stay, and depend on the request alone. They look
/// like vehicles that the scene has. `people_epoch_ns`: time of the crowd at simulation time 0, by which signals go.
/// InputError for scenes without roads or vehicles, for more than the roads hold, and for a warm-up outside of 0 ... 3600 s.
TrafficScene AddTraffic(std::shared_ptr<const Scene> scene, const TrafficRequest& request, int64_t people_epoch_ns = 0);

/// An instant whose lamps burn: for optical flow, which carries what is seen now to where it will be.
struct LampsAt {
  const TrafficState* state = nullptr;
  int64_t t_ns = 0;
};

/// Adds the vehicles at t_ns of traffic time, at most a tick after the state, to a scene state; hides what stands in their
/// way. Their lamps burn as they do then, or as `lamps` says.
void ShowTraffic(const SimTraffic& traffic, const TrafficState& state, int64_t t_ns, SceneState& scene_state, const LampsAt& lamps = {});
/// The traffic at t_ns or at most a tick before, as it goes on without people and drones.
std::shared_ptr<const TrafficState> TrafficLater(const SimTraffic& traffic, std::shared_ptr<const TrafficState> state, int64_t t_ns);
/// The scene without any vehicles of the traffic.
void HideTraffic(const SimTraffic& traffic, SceneState& scene_state);

/// Index of the vehicle of an entity, which may be a rider's; nullopt: it is none of the traffic.
std::optional<size_t> VehicleOf(const SimTraffic& traffic, EntityId entity);
/// "left", "right" or "off".
const char* IndicatorName(const DrivingVehicle& vehicle);

/// A vehicle as a drone meets it.
struct VehicleBox {
  RigidTransform X_WB;  ///< of the middle of the box
  Vec3d half_size_B;
  Vec3d v_W;
  EntityId entity = kNoEntity;
};
/// Those whose middle is within `reach` metres of p, at t_ns of traffic time.
std::vector<VehicleBox> VehiclesNear(const SimTraffic& traffic, const TrafficState& state, int64_t t_ns, Vec3d p_W, double reach);

}  // namespace airsim360
