// Frames along flights of the waypoint generator.
#pragma once

#include <memory>
#include <vector>

#include "airsim360/dataset/plan/recipe.h"
#include "airsim360/dataset/waypoint_set.h"
#include "airsim360/sim/fly_route.h"

namespace airsim360 {

class FlightFrames {
 public:
  /// Maps the world, which takes seconds. InputError if nothing can be reached from its spawn. `stage` must outlive it.
  FlightFrames(Stage& stage, const RecipeRow& row, uint64_t seed);
  /// The shots of flight `number`: RecipeRow::flight_frames of them, so that from one to the next the world turns by the same
  /// angle (equal parallax: way over the median range). A pure function of the arguments.
  std::vector<Shot> Shots(int64_t number) const;

 private:
  RecipeRow row_;
  uint64_t seed_;
  std::shared_ptr<const RayTracer> tracer_;
  std::unique_ptr<WaypointSpace> space_;
};

}  // namespace airsim360
