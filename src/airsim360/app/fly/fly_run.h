// Flying the tasks of `airsim360 fly`: the loop, and what is noted on the way.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "airsim360/app/fly/fly_script.h"
#include "airsim360/app/sensor_log.h"
#include "airsim360/mission/mission.h"
#include "airsim360/sim/fly_route.h"
#include "airsim360/sim/pacer.h"

namespace airsim360 {

struct FlyJob {
  std::shared_ptr<const SimModel> model;  ///< with one drone
  std::vector<FlyTask> tasks;
  std::shared_ptr<const Mission> mission;       ///< flown instead of tasks; null: none
  double longest = 0;                           ///< seconds that a mission may take
  double speed = 0;                             ///< of the clock, 0 = as fast as the machine can
  int64_t frames = 0;                           ///< pictures, spread evenly over the flight once it is known
  double video_fps = 0;                         ///< of the shots for a video, from the start on; 0 = none
  std::string record_note;                      ///< not empty: the run is recorded
  SensorLog* sensors = nullptr;                 ///< told of every state with a new reading; null: none
  std::function<void(const std::string&)> log;  ///< told of tasks and events
};

struct FlyResult {
  Flight flight;            ///< trajectory at 100 Hz; shots at the times of the frames
  std::vector<Shot> video;  ///< at FlyJob::video_fps, each at the nearest step
  std::vector<SimEvent> events;
  /// Metres from the drone to the nearest surface, between take-off and landing (IsEnRoute) and at most 50; none
  /// if it was never there.
  std::optional<double> least_clearance;
  double tracking_rms = -1, tracking_max = -1;  ///< metres, of trajectory tasks; -1 = there were none
  PaceReport pace;
  uint64_t hash = 0;  ///< of the last state
  int64_t steps = 0;
  double charge = 1;  ///< of the battery at the end
  std::optional<Recording> recording;
  std::vector<std::string> unfinished;     ///< tasks that were given up because they did not end
  std::optional<MissionProgress> mission;  ///< still running: it was stopped at FlyJob::longest
  std::vector<MissionCapture> captures;
};

/// Runs all tasks, or the mission; how they fly does not depend on the sensors. RuntimeError only where `sensors` cannot
/// write: what goes wrong in the air is told by events.
FlyResult RunFlight(const FlyJob& job);

/// "t 12.340 s: collision with 'wall east' at 2.13 m/s".
std::string DescribeEvent(const SimEvent& event, const Scene& scene);

}  // namespace airsim360
