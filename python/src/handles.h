// Objects that several files of the module know.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/assets/importing/import.h"
#include "airsim360/planning/certificate.h"
#include "airsim360/planning/splines/polynomial_trajectory.h"
#include "airsim360/planning/splines/trajectory_limits.h"
#include "airsim360/render/cuda/cuda_pictures.h"
#include "airsim360/sensors/rig.h"
#include "airsim360/sim/sim_loop.h"
#include "airsim360/stage/stage.h"
#include "convert.h"

namespace airsim360::python {

/// What one trigger gave, as Python holds it.
struct Capture : airsim360::Capture {
  Image<uint8_t> part, sky;  ///< made of the frame; empty where they were not asked for
};

/// A lidar and where it sits.
struct Lidar {
  LidarSpec spec;
  RigidTransform X_BS;
};

struct Rig;

/// A stage, and the categories that were given since.
class World {
 public:
  /// InputError for what makes no sense.
  explicit World(const StageOptions& options) : request_(options.world), stage_(std::make_shared<Stage>(options)) {}
  /// Where W's origin lies on the Earth; none for worlds that are no maps.
  std::optional<GeoPoint> earth() const { return OriginOfWorld(request_); }
  const std::shared_ptr<Stage>& stage() const { return stage_; }
  const Scene& scene() const { return stage_->scene(); }
  const std::string& name() const { return stage_->name(); }
  /// Categories given since the world was loaded; null = none.
  std::shared_ptr<const EntityLabels> labels();
  /// From the next capture on; returns how many entities match. InputError for a malformed category path.
  size_t Relabel(const std::vector<LabelPattern>& patterns, std::vector<std::string>& unused);
  /// Both without the GIL.
  std::shared_ptr<Capture> Render(const Rig& rig, const Kinematics& body);
  std::shared_ptr<LidarScan> Scan(const Lidar& lidar, const Kinematics& body);

 private:
  WorldRequest request_;
  std::shared_ptr<Stage> stage_;
  std::mutex labels_mutex_;  // of labels_; held for a moment only
  std::shared_ptr<const EntityLabels> labels_;
  std::mutex render_mutex_;  // of the stage's renderers; never waited for with the GIL held
};

inline constexpr int64_t kMostPeople = 10000;
/// So many people; InputError outside 0 to kMostPeople.
PeopleRequest PeopleOf(int64_t count, uint64_t seed);

/// Entities of a scene by id, as dictionaries.
py::list EntitiesOf(const Scene& scene, const EntityLabels* labels);

/// A capture that never left the GPU: the images of its frame are empty.
struct CudaCapture : Capture {
  std::shared_ptr<const CudaPictures> pictures;
};

/// What and how a trigger captures.
struct Rig {
  PanoramicRig rig;
  double flow_dt = 0.1;  ///< seconds that optical flow leads on by
  Products shown;        ///< what was asked for; rig.products may be more
};

/// Makes the products that follow from others, and drops what served them alone.
/// `labels` (null: none) take the place of the scene's categories.
void FinishCapture(const Rig& rig, const Scene& scene, const EntityLabels* labels, Capture& capture);
/// What is rendered for a rig under labels: the entity tells the category.
PanoramicRig Rendered(const Rig& rig, const EntityLabels* labels);
/// The same of a scan.
void FinishScan(const EntityLabels* labels, LidarScan& scan);

/// Rig() of Python: a panorama of 1024 x 512.
inline int64_t PixelsOf(const Rig& rig) { return int64_t{Width(rig.rig.camera)} * Height(rig.rig.camera); }
inline Rig DefaultRig() {
  Rig rig;
  rig.rig.camera = Equirectangular{1024, 512};
  return rig;
}

/// A kind of drone and where it starts.
struct Drone {
  DroneModel model;
  std::map<std::string, std::string> laws;
  std::string yaml, name;
  std::optional<Vec3d> p_WB;
  double yaw = 0;
  bool airborne = false;
  ControllerKind controller = ControllerKind::kIndi;
  std::optional<SensorSet> sensors;
};
/// Catalogue name, YAML file, or words.
Drone MakeDrone(const std::string& what);
/// A Drone, or what MakeDrone takes.
Drone ToDrone(const py::handle& value);

/// A vehicle of a snapshot, as Python looks at it.
struct StateView {
  std::shared_ptr<const SimModel> model;
  std::shared_ptr<const SimState> state;
  size_t i = 0;
  const Vehicle& vehicle() const { return state->vehicles[i]; }
};

/// A planned flight.
struct Plan {
  std::shared_ptr<const PolynomialTrajectory> trajectory;
  TrajectoryPeaks peaks;
  std::vector<Vec3d> waypoints;
  std::optional<Certificate> certificate;
  double cost_snap = 0;
};

}  // namespace airsim360::python
