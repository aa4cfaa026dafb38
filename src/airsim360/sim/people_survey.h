// Surveys of a world with people: a tour from place to place near them, a little above their heads.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "airsim360/routes/route.h"
#include "airsim360/sim/step.h"

namespace airsim360 {

struct PeopleSurveyOptions {
  uint64_t seed = 0;
  double clearance = 1.0;                 ///< metres to keep from every surface of the world; in rooms no more than 0.25
  double min_height = 2, max_height = 6;  ///< metres above the ground that people walk on
  int viewpoints = 40;                    ///< stops of the tour, 1 to kMostPeopleStops
  std::vector<Vec3d> passages = {};       ///< as SurveyOptions::passages
};
inline constexpr int kMostPeopleStops = 200;

struct PeopleSurvey {
  Route route;
  std::vector<int64_t> stop_times_ns;  ///< when the body hovers and looks at people; ascending
};

/// A tour that hovers at viewpoints from which people are seen near and not hidden by the world, at the time when the body
/// is there: the people are simulated ahead, without the body that they may notice. People not yet seen count more. The body
/// faces them at every stop. Where few places are free the clearance is halved. nullopt if nobody is in the world at its start,
/// or no free place near anybody. A pure function of the model and the options.
std::optional<PeopleSurvey> PlanPeopleSurvey(const SimModel& model, const PeopleSurveyOptions& options);

/// How well people are seen from a place: the sum over those within 15 m whose face is not hidden of a weight that is 1 up to
/// 4.5 m and falls with the square of the distance. nullopt inside of something solid, and where a face is nearer than 2 m.
/// `people`: their ground points, nullopt for who is not in the world.
std::optional<double> RatePeopleView(const RayTracer& world, Vec3d p_W, std::span<const std::optional<Vec3d>> people);

}  // namespace airsim360
