// Renderers that the eyes of all flights in one world share.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "airsim360/stage/stage.h"

namespace airsim360 {

/// Thread-safe. A renderer holds tables as large as its world, and draws with all processors: a renderer for each of many flights
/// would spend more time being made than drawing. Pictures do not depend on which one draws them.
class SharedRenderers {
 public:
  explicit SharedRenderers(std::shared_ptr<Stage> stage) : stage_(std::move(stage)) {}

  /// Under `weather` ("" = the world's own; labels have none). Waits where as many as kAtATime pictures of that weather are being
  /// drawn. InputError for an unknown weather.
  void Render(const std::string& weather, const RenderRequest& request, Frame& frame);

 private:
  static constexpr int kAtATime = 2;  ///< one draws where another has no work for all processors
  struct Kind {
    std::vector<std::unique_ptr<Renderer>> idle;
    int made = 0;
  };
  std::unique_ptr<Renderer> Make(const std::string& weather, Tier tier);

  std::shared_ptr<Stage> stage_;
  std::mutex making_;  // one after the other: what one computes of the world the next finds in the cache
  std::mutex mutex_;   // of what follows
  std::condition_variable returned_;
  std::map<std::pair<Tier, std::string>, Kind> kinds_;
};

}  // namespace airsim360
