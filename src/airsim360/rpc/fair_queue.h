// Jobs of several clients that wait for one thread.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

namespace airsim360 {

/// Clients take turns, one job each; the jobs of one client come in their order. All functions may be called from any thread.
template <class Job>
class FairQueue {
 public:
  /// Nothing happens after Stop.
  void Post(uint64_t client, Job job) {
    {
      const std::lock_guard lock(mutex_);
      if (stopped_) return;
      std::deque<Job>& jobs = waiting_[client];
      if (jobs.empty()) turns_.push_back(client);
      jobs.push_back(std::move(job));
    }
    wake_.notify_one();
  }

  /// Waits for a job; nullopt after Stop.
  std::optional<Job> Next() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return stopped_ || !turns_.empty(); });
    return TakeLocked();
  }
  /// Waits for a job for so long; nullopt after that, or after Stop.
  template <class Duration>
  std::optional<Job> NextWithin(Duration time) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, time, [&] { return stopped_ || !turns_.empty(); });
    return TakeLocked();
  }

  /// Drops the jobs that wait, and wakes everybody.
  void Stop() {
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
      waiting_.clear();
      turns_.clear();
    }
    wake_.notify_all();
  }
  bool stopped() const {
    const std::lock_guard lock(mutex_);
    return stopped_;
  }

 private:
  std::optional<Job> TakeLocked() {
    if (stopped_ || turns_.empty()) return std::nullopt;
    const uint64_t client = turns_.front();
    turns_.pop_front();
    const auto found = waiting_.find(client);
    std::optional<Job> job(std::move(found->second.front()));
    found->second.pop_front();
    if (found->second.empty()) {
      waiting_.erase(found);
    } else {
      turns_.push_back(client);
    }
    return job;
  }

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::map<uint64_t, std::deque<Job>> waiting_;  // none of them empty
  std::deque<uint64_t> turns_;                   // clients of `waiting_`, the next one first
  bool stopped_ = false;
};

}  // namespace airsim360
