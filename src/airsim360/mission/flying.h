// Ways of a mission: proved free of collisions, planned when a node begins.
#pragma once

#include <memory>
#include <string>

#include "airsim360/mission/things.h"
#include "airsim360/planning/splines/trajectory_limits.h"
#include "airsim360/routes/world_clearance.h"

namespace airsim360 {

/// A way, or why there is none.
struct MissionWay {
  std::shared_ptr<const PolynomialTrajectory> path;  ///< null: none is needed, or `problem` says why there is none
  Vec3d goal;
  std::string problem;
};

/// Plans for one drone; keeps the map of where it flies. A pure function of what it is asked.
class MissionPlanner {
 public:
  explicit MissionPlanner(std::shared_ptr<const RayTracer> tracer) : tracer_(std::move(tracer)), space_(tracer_) {}

  struct GotoRequest {
    double distance = 3, height = 0;  ///< metres from a thing's box, and above its middle
    TrajectoryLimits limits;
    double clearance = 0.5;
  };
  /// To a point, or to the free place around a thing that is the least turn away from where the drone is.
  MissionWay Goto(Vec3d from, const ThingNow& to, const GotoRequest& request);

  struct OrbitRequest {
    double radius = 10, height = 2, turns = 1;
    TrajectoryLimits limits;
    double clearance = 0.5;
  };
  /// To the nearest point of the circle.
  MissionWay ToOrbit(Vec3d from, const ThingNow& around, const OrbitRequest& request);
  /// Around, begun and ended at rest at `from`, a point of the circle.
  MissionWay Orbit(Vec3d from, const ThingNow& around, const OrbitRequest& request);

 private:
  MissionWay Free(Vec3d from, Vec3d to, const TrajectoryLimits& limits, double clearance);

  std::shared_ptr<const RayTracer> tracer_;
  FlightSpace space_;
};

/// Middle of the circle that an orbit is flown on.
Vec3d OrbitCenter(const ThingNow& around, double height);

}  // namespace airsim360
