// The simulation that Python holds.
#pragma once

#include "airsim360/sim/capture.h"
#include "handles.h"

namespace airsim360::python {

class Simulation {
 public:
  Simulation(std::shared_ptr<World> world, const py::object& drones, const py::object& people, const py::object& seed, double dt,
             const py::object& wind);

  SimLoop& loop() { return *loop_; }
  const std::shared_ptr<const SimModel>& model() const { return model_; }
  const std::shared_ptr<World>& world() const { return world_; }
  const std::vector<std::string>& names() const { return names_; }
  /// Index of a drone by number or name; InputError naming the nearest.
  size_t Find(const py::object& drone) const;
  /// InputError for a command that the drone cannot fly.
  void Post(const py::object& drone, Command command, double timeout);
  /// Without the GIL.
  std::shared_ptr<Capture> Take(const Rig& rig, size_t i) { return TakeAt(rig, i, nullptr); }
  /// As it was in a snapshot of the loop; null: now.
  std::shared_ptr<Capture> TakeAt(const Rig& rig, size_t i, std::shared_ptr<const SimState> state);
  /// The same with the pictures left in memory of the GPU, for CUDA; without the GIL.
  std::shared_ptr<CudaCapture> TakeCuda(const Rig& rig, size_t i);
  /// One turn of a lidar now, with bodies of others; without the GIL.
  std::shared_ptr<LidarScan> Scan(const Lidar& lidar, size_t i);
  /// The same of a lidar of the drone's sensor set, by name ("" = the first); InputError naming the nearest.
  std::shared_ptr<LidarScan> Scan(const std::string& lidar, size_t i);
  py::list Events();
  /// Where everybody is.
  py::list People() const;
  py::list Vehicles() const;
  /// With bodies of drones and people.
  const Scene& scene() const { return stage_->scene(); }

 private:
  void Build(std::vector<DroneSetup> setups, const PeopleRequest& people, uint64_t seed, double dt, const std::optional<Vec3d>& wind);

  std::shared_ptr<World> world_;
  std::shared_ptr<Stage> stage_;  ///< the world's, with bodies and people of its own
  std::shared_ptr<const SimModel> model_;
  std::unique_ptr<SimLoop> loop_;
  std::vector<std::string> names_;
  std::mutex render_mutex_;             // of what follows; never waited for with the GIL held
  std::unique_ptr<CudaRenderer> cuda_;  // made when first asked for
  std::unique_ptr<SnapshotSensors> sensors_;
  SnapshotSensors& SensorsLocked();
  void CaptureLocked(const Rig& rig, size_t i, const EntityLabels* labels, Renderer& renderer, Capture& capture,
                     std::shared_ptr<const SimState> state = nullptr);
};

/// The commands of Simulation (simulation_commands.cc).
void BindCommands(py::class_<Simulation>& simulation);
/// What it sees: capture (capture.cc) and scan (lidar.cc).
void BindCapturing(py::class_<Simulation>& simulation);
void BindScanning(py::class_<Simulation>& simulation);
/// Its missions (simulation_mission.cc).
void BindMissions(py::class_<Simulation>& simulation);

}  // namespace airsim360::python
