// A picture that nobody wants any more ends early.
#pragma once

#include <atomic>

namespace airsim360 {

/// Thrown by a capture that was given up. What it has filled of its frame means nothing; the renderer is as good as before.
struct Interrupted {};

/// While it lives, captures that its own thread asks for end with Interrupted once `wanted` is false, in tiers `fast` and `labels`
/// after a few tiles. Other threads may set it. Others' captures go on; scopes of one thread do not nest.
class InterruptibleScope {
 public:
  explicit InterruptibleScope(const std::atomic<bool>& wanted);
  ~InterruptibleScope();
  InterruptibleScope(const InterruptibleScope&) = delete;
  InterruptibleScope& operator=(const InterruptibleScope&) = delete;
};

/// For the loops of a renderer: taken in the thread that captures, asked by those that help it.
class Interruption {
 public:
  Interruption();
  /// Whether the rest may be left out.
  bool came() const { return wanted_ != nullptr && !wanted_->load(std::memory_order_relaxed); }
  /// After a loop that may have left something out.
  void Check() const {
    if (came()) throw Interrupted{};
  }

 private:
  const std::atomic<bool>* wanted_;
};

}  // namespace airsim360
