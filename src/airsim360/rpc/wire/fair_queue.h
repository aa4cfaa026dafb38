// Jobs of several clients that wait for one thread.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <utility>

#include "airsim360/base/work_queue.h"

namespace airsim360 {

/// Clients take turns, one job each; the jobs of one client come in their order.
template <class Job>
class InTurns {
 public:
  void Add(uint64_t client, Job job) {
    std::deque<Job>& jobs = waiting_[client];
    if (jobs.empty()) turns_.push_back(client);
    jobs.push_back(std::move(job));
  }
  Job Take() {
    const auto found = waiting_.find(turns_.front());
    turns_.pop_front();
    Job job = std::move(found->second.front());
    found->second.pop_front();
    if (found->second.empty())
      waiting_.erase(found);
    else
      turns_.push_back(found->first);
    return job;
  }
  bool empty() const { return turns_.empty(); }
  void Clear() {
    waiting_.clear();
    turns_.clear();
  }

 private:
  std::map<uint64_t, std::deque<Job>> waiting_;  // none of them empty
  std::deque<uint64_t> turns_;                   // clients of `waiting_`, the next one first
};

/// Post(client, job).
template <class Job>
using FairQueue = WorkQueue<Job, InTurns<Job>>;

}  // namespace airsim360
