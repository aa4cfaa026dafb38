// The running simulation behind a server: one thread that alone changes it, paces it and publishes snapshots.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "airsim360/base/work_queue.h"
#include "airsim360/mission/mission.h"
#include "airsim360/rpc/session/pacer.h"
#include "airsim360/rpc/session/recorder.h"
#include "airsim360/rpc/session/scene_extras.h"
#include "airsim360/rpc/session/snapshot.h"
#include "airsim360/rpc/session/vehicle_control.h"
#include "airsim360/rpc/settings/settings.h"
#include "airsim360/sim/sim_loop.h"
#include "airsim360/stage/stage.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

struct SessionOptions {
  AirSimSettings settings;
  bool lockstep = false;  ///< time passes only in simContinueForTime and simContinueForFrames
};

/// What runs in the session's thread.
class Session {
 public:
  /// Changes the session and returns what is to be done once the change can be seen: answering, mostly.
  using Job = std::function<std::function<void()>(Session&)>;

  /// `extras`: the bodies of `stage`.
  Session(Stage& stage, SceneExtras extras, const SessionOptions& options);
  /// Ends every move with False and joins the thread.
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // From any thread.

  /// Runs `job` between two steps, publishes the changed state, then does what the job has returned.
  void Post(Job job);
  SnapshotPointer snapshot() const;
  const AirSimSettings& settings() const { return options_.settings; }
  const ObjectIndex& objects() const { return objects_; }
  std::vector<std::string> AssetNames() const;
  /// Origin of the global N frame in W, and W on the Earth.
  Vec3d origin_W() const { return origin_W_; }
  const GeoFrame& earth() const { return earth_; }

  // From jobs only.

  SimState& state() { return loop_->Edit(); }
  const SimModel& model() const { return loop_->model(); }
  VehicleControl& control(const std::string& name);
  /// The same; AirSim's error for a vehicle of type ComputerVision, too, which has nothing that could be steered.
  VehicleControl& drone(const std::string& name);
  bool HasVehicle(const std::string& name) const;
  Vehicle& vehicle(const VehicleControl& control) { return state().vehicles[control.index()]; }
  /// The world, to be changed.
  WorldView& world();
  /// The environment was changed: renderers need to be made anew.
  void EnvironmentChanged() { ++world().environment_version; }
  /// Objects were moved: drones meet them in their new places.
  void ObjectsMoved();
  /// Gains of a drone's controllers were changed.
  void GainsChanged(const VehicleControl& control);
  /// A drone added at a place; false, with a notice why, if the name is taken or the type unknown.
  bool AddVehicle(const std::string& name, const std::string& type, const RigidTransform& X_WB);
  /// Brings an object of an asset into the world; its name, which is another one if `name` is taken.
  /// std::runtime_error with AirSim's text for an asset that there is not, or when all copies are in use.
  std::string Spawn(const std::string& name, const std::string& asset, const ObjectPlace& place);
  /// Puts a vehicle somewhere else, at the speed it has. std::invalid_argument for a drone beyond where drones are kept.
  void Teleport(const VehicleControl& control, const RigidTransform& X_WB);
  void Reset();
  /// Has a drone fly a mission from the next step on, instead of what it does.
  void FlyMission(VehicleControl& control, std::shared_ptr<const Mission> mission);
  /// The drone's last mission; nullptr if it had none.
  std::shared_ptr<const MissionPilot> MissionOf(const VehicleControl& control) const;
  /// Ends its mission; the drone hovers.
  void StopMission(const VehicleControl& control);
  std::shared_ptr<const SimModel> shared_model() const { return loop_->shared_model(); }
  /// What has changed so far can be seen.
  void PublishNow() { Publish(); }
  Pacer& pacer() { return pacer_; }
  FlightRecorder& recorder() { return recorder_; }

 private:
  void Run();
  bool RunJobs();
  void StepOnce();
  void NoteNearMisses(std::span<const SimEvent> happened);
  void Publish();
  void BuildVehicles(Stage& stage);
  void RebuildModel();
  void AddToModel(const std::string& name, const VehicleSettings& settings, const RigidTransform& X_WB);
  void MakeRoomAt(size_t index);
  /// std::invalid_argument naming what drones' reach is, in the frame that begins at `origin_W`.
  void CheckReach(Vec3d p_W, Vec3d origin_W) const;
  /// Says in the log that a drone cannot stay where it starts, and the nearest place where it can.
  void NoticeBadStart(const std::string& name, const RigidTransform& X_WB) const;
  RigidTransform StartPose(const VehicleSettings& settings) const;
  /// What the sensors of a drone read before time has passed: as AirSim's they have values at once.
  void SampleSensors(size_t index);

  SessionOptions options_;
  ObjectIndex objects_;
  GeoFrame earth_;
  SceneExtras extras_;
  std::shared_ptr<const RayTracer> base_tracer_;  // without the bodies
  DynamicTracer dynamic_tracer_;
  Vec3d origin_W_;

  // Of the session's thread.
  std::unique_ptr<SimLoop> loop_;
  std::vector<std::unique_ptr<VehicleControl>> controls_;
  std::map<std::string, std::shared_ptr<MissionPilot>> missions_;  // by name of the drone
  std::shared_ptr<const std::vector<NearMiss>> near_misses_;       // in snapshots, too
  std::shared_ptr<const WorldView> world_;
  std::shared_ptr<WorldView> new_world_;  // while a job changes it
  Pacer pacer_;
  FlightRecorder recorder_;

  mutable std::mutex snapshot_mutex_;
  SnapshotPointer snapshot_;
  WorkQueue<Job> jobs_;
  std::thread thread_;
};

}  // namespace airsim360
