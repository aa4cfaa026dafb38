// Survey routes: a tour through the free space of a scene at varied heights, for collecting panoramas.
#pragma once

#include <cstdint>
#include <vector>

#include "airsim360/routes/route.h"
#include "airsim360/trace/ray_tracer.h"

namespace airsim360 {

struct SurveyOptions {
  uint64_t seed = 0;
  double clearance = 1.0;  ///< metres to keep from every surface, all along the route
  double min_height = 1.6,
         max_height = 60;            ///< metres above the ground of the scene, as far as the scene is that high
  int viewpoints = 40;               ///< places the tour visits, spread over the reachable footprint
  std::vector<Vec3d> passages = {};  ///< where narrow ways lead through, such as BuildingRooms::OpenPassages
};

/// Viewpoints of a survey for so many frames: 40, then one for four frames, so that neighbours do not become duplicates; at
/// most 800, more than which are planned better as a dataset (airsim360 dataset plan).
int SurveyViewpoints(int64_t frames);

/// A route that starts at the scene's spawn (or the freest place found) and visits viewpoints spread over the
/// part of the scene that can be reached from there, every point of it at least `clearance` from any surface.
/// In the rooms of a building no more than 0.25 m is kept, so that it leads through doors; in scenes too narrow
/// for that the clearance is halved until there is room. A pure function of scene and
/// options. InputError if there is no free place at all.
Route PlanSurvey(const RayTracer& tracer, const SurveyOptions& options);

}  // namespace airsim360
