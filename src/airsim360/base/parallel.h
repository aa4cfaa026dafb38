// Parallel loops whose result does not depend on the number of threads.
#pragma once

#include <cstdint>

namespace airsim360 {

namespace internal {
/// Calls call(body, i) for every i in [0, n).
void RunParallel(int64_t n, void (*call)(const void* body, int64_t i), const void* body);
}  // namespace internal

/// Calls body(i) for every i in [0, n), each exactly once, on the worker threads; returns when all are done.
/// The body must write only to places owned by i. Each i is one task: make it big enough (a tile, a row, a
/// file). The first exception thrown by a body is rethrown here. Takes no memory of its own.
template <class Body>
void ParallelFor(int64_t n, const Body& body) {
  internal::RunParallel(
      n, [](const void* pointer, int64_t i) { (*static_cast<const Body*>(pointer))(i); }, &body);
}

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
