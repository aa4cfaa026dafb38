// A mutex that is had in the order of asking: who holds it most of the time keeps nobody out.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace airsim360 {

/// For std::lock_guard. Not recursive.
class FairMutex {
 public:
  void lock() {
    std::unique_lock guard(mutex_);
    const uint64_t mine = next_++;
    changed_.wait(guard, [&] { return served_ == mine; });
  }
  void unlock() {
    {
      const std::lock_guard guard(mutex_);
      ++served_;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  uint64_t next_ = 0, served_ = 0;
};

}  // namespace airsim360
