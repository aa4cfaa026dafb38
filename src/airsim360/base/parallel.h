// Parallel loops whose result does not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>

namespace airsim360 {

/// Calls body(i) for every i in [0, n), each exactly once, on the worker threads; returns when all are done.
/// The body must write only to places owned by i. Each i is one task: make it big enough (a tile, a row, a
/// file). The first exception thrown by a body is rethrown here.
void ParallelFor(int64_t n, const std::function<void(int64_t)>& body);

/// Limits every ParallelFor of the process to `threads` (0 = all cores) while the object lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// Number of threads that ParallelFor uses now.
int ThreadCount();

}  // namespace airsim360
