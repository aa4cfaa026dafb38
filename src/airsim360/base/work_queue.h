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

/// First come, first served.
template <class Job>
class InOrder {
 public:
  void Add(Job job) { jobs_.push_back(std::move(job)); }
  Job Take() {
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    return job;
  }
  bool empty() const { return jobs_.empty(); }
  void Clear() { jobs_.clear(); }

 private:
  std::deque<Job> jobs_;
};

/// For one thread or several, in the order that `Waiting` keeps. All functions may be called from any thread.
template <class Job, class Waiting = InOrder<Job>>
class WorkQueue {
 public:
  using Clock = std::chrono::steady_clock;

  /// Arguments of Waiting::Add. Nothing happens after Stop.
  template <class... Arguments>
  void Post(Arguments&&... arguments) {
    {
      const std::lock_guard lock(mutex_);
      if (stopped_) return;
      waiting_.Add(std::forward<Arguments>(arguments)...);
    }
    wake_.notify_one();
  }

  /// Waits for a job; nullopt after Stop.
  std::optional<Job> Next() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return stopped_ || !waiting_.empty(); });
    return TakeLocked();
  }
  /// Waits for a job for so long; nullopt after that, or after Stop.
  std::optional<Job> NextWithin(Clock::duration time) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, time, [&] { return stopped_ || !waiting_.empty(); });
    return TakeLocked();
  }
  /// All that wait now, maybe none.
  std::vector<Job> TakeAll() {
    const std::lock_guard lock(mutex_);
    std::vector<Job> all;
    while (!waiting_.empty()) all.push_back(waiting_.Take());
    return all;
  }
  /// Returns once a job waits, Stop was called, or it is `time` (none: never by itself).
  void WaitUntil(std::optional<Clock::time_point> time) {
    std::unique_lock lock(mutex_);
    const auto called = [&] { return stopped_ || !waiting_.empty(); };
    time ? (void)wake_.wait_until(lock, *time, called) : wake_.wait(lock, called);
  }

  /// Drops the jobs that wait, and wakes everybody.
  void Stop() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
      waiting_.Clear();
    }
    wake_.notify_all();
  }
  bool stopped() const {
    const std::lock_guard lock(mutex_);
    return stopped_;
  }

 private:
  std::optional<Job> TakeLocked() {
    if (waiting_.empty()) return std::nullopt;  // as after Stop
    return waiting_.Take();
  }

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Waiting waiting_;
  bool stopped_ = false;
};

}  // namespace airsim360
