// A world that is flown in the browser: the real drone of a simulation, and pictures from where it is.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "airsim360/sensors/rig.h"
#include "airsim360/sim/fly_route.h"
#include "airsim360/sim/sim_loop.h"
#include "airsim360/stage/stage.h"
#include "airsim360/view/live_source.h"

namespace airsim360 {

struct LiveOptions {
  RenderSettings picture = {};
  std::string drone = "hummingbird";  ///< of DroneCatalog
  std::string source = {};            ///< what opens the world again: its name, or its file
  std::string source_text = {};       ///< of a world file: what it says
  /// Renders what was kept into a dataset, under an environment, and says where; none: nothing is kept.
  std::function<std::string(const Flight& kept, const Environment& environment)> save = {};
  /// Seconds since any instant; the clock that the drone flies by.
  std::function<double()> clock = {};
};

/// Thread-safe. Time passes while pictures are asked for, never faster than the clock. A drone that is told nothing for
/// half a second stops and stays.
class LiveWorld : public LiveSource {
 public:
  LiveWorld(std::shared_ptr<Stage> stage, LiveOptions options);
  ~LiveWorld() override;

  std::string DescriptionJson() const override;
  std::string EntitiesJson() const override;
  SocketMessage Answer(std::string_view message, const std::string& token) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360
