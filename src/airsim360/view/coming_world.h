// A world that is still being opened: its page is served meanwhile, and says so.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "airsim360/view/live_source.h"

namespace airsim360 {

/// Thread-safe. What is asked of the world waits until it is there; DescriptionJson() not longer than a moment, and says
/// {"coming": name} then, so that a page can tell what it waits for.
class ComingWorld : public LiveSource {
 public:
  explicit ComingWorld(std::string name) : name_(std::move(name)) {}

  /// One of the two, once. After Fail() everything is answered with that it could not be opened.
  void Come(std::shared_ptr<LiveSource> world);
  void Fail();

  std::string DescriptionJson() const override;
  std::string EntitiesJson() const override;
  SocketMessage Answer(std::string_view message, const std::string& token) override;

 private:
  // Once it is there or has failed; null for one that has failed.
  LiveSource* Wait() const;

  const std::string name_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::shared_ptr<LiveSource> world_;
  bool failed_ = false;
};

}  // namespace airsim360
