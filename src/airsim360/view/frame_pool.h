// Frames whose memory is used again: a picture follows the other, and each would otherwise be paid for in fresh pages.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "airsim360/render/renderer.h"

namespace airsim360 {

/// Thread-safe. What it gives comes back by itself when its last holder lets it go, in any thread, also after the pool's end.
class FramePool {
 public:
  /// A frame of any content, to be rendered into.
  std::shared_ptr<Frame> Take() {
    std::unique_ptr<Frame> frame = Pop();
    if (!frame) frame = std::make_unique<Frame>();
    const auto home = [rest = std::weak_ptr(rest_)](Frame* used) { Return(rest, std::unique_ptr<Frame>(used)); };
    return {frame.release(), home};
  }
  size_t resting() const {
    const std::lock_guard lock(rest_->mutex);
    return rest_->frames.size();
  }

  /// Gives up everything but colours, range, semantic and entity, which every picture has: memory does not depend on what was
  /// looked at before. Those four are not touched; others may read them meanwhile.
  static void DropProducts(Frame& frame) {
    frame.normal = {}, frame.position = {}, frame.albedo = {}, frame.material = {};
    frame.flow = {}, frame.coverage = {}, frame.radiance = {}, frame.light = {};
  }

 private:
  static constexpr size_t kMostResting = 2;
  struct Rest {
    std::mutex mutex;
    std::vector<std::unique_ptr<Frame>> frames;
  };

  std::unique_ptr<Frame> Pop() {
    const std::lock_guard lock(rest_->mutex);
    if (rest_->frames.empty()) return nullptr;
    auto frame = std::move(rest_->frames.back());
    rest_->frames.pop_back();
    return frame;
  }
  static void Return(const std::weak_ptr<Rest>& home, std::unique_ptr<Frame> used) {
    const auto rest = home.lock();
    if (!rest) return;
    DropProducts(*used);
    const std::lock_guard lock(rest->mutex);
    if (rest->frames.size() < kMostResting) rest->frames.push_back(std::move(used));
  }

  std::shared_ptr<Rest> rest_ = std::make_shared<Rest>();
};

}  // namespace airsim360
