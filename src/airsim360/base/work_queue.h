// Jobs that wait for a thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace airsim360 {

/// First come, first served, by one thread or several. All functions may be called from any thread.
template <class Job>
class WorkQueue {
 public:
  using Clock = std::chrono::steady_clock;

  /// Nothing happens after Stop.
  void Post(Job job) {
    {
      const std::lock_guard lock(mutex_);
      if (stopped_) return;
      jobs_.push_back(std::move(job));
    }
    wake_.notify_one();
  }

  /// Waits for a job; nullopt after Stop.
  std::optional<Job> Next() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return stopped_ || !jobs_.empty(); });
    return TakeLocked();
  }
  /// Waits for a job for so long; nullopt after that, or after Stop.
  std::optional<Job> NextWithin(Clock::duration time) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, time, [&] { return stopped_ || !jobs_.empty(); });
    return TakeLocked();
  }
  /// All that wait now, maybe none.
  std::vector<Job> TakeAll() {
    const std::lock_guard lock(mutex_);
    std::vector<Job> all(std::make_move_iterator(jobs_.begin()), std::make_move_iterator(jobs_.end()));
    jobs_.clear();
    return all;
  }
  /// Returns once a job waits, Stop was called, or it is `time` (none: never by itself).
  void WaitUntil(std::optional<Clock::time_point> time) {
    std::unique_lock lock(mutex_);
    const auto called = [&] { return stopped_ || !jobs_.empty(); };
    time ? (void)wake_.wait_until(lock, *time, called) : wake_.wait(lock, called);
  }

  /// Drops the jobs that wait, and wakes everybody.
  void Stop() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
      jobs_.clear();
    }
    wake_.notify_all();
  }
  bool stopped() const {
    const std::lock_guard lock(mutex_);
    return stopped_;
  }

 private:
  std::optional<Job> TakeLocked() {
    if (stopped_ || jobs_.empty()) return std::nullopt;
    std::optional<Job> job(std::move(jobs_.front()));
    jobs_.pop_front();
    return job;
  }

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Job> jobs_;
  bool stopped_ = false;
};

}  // namespace airsim360
