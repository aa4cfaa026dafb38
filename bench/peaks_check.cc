// Certified peaks of random trajectories against plain sampling: none may lie below a sample, and none far
// above the largest. Usage: peaks_check [trajectories 10000] [samples 1000000]; two threads; exit 1 on a
// violation.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <vector>

#include "airsim360/base/random.h"
#include "airsim360/planning/splines/trajectory_limits.h"

using namespace airsim360;

namespace {

struct Largest {
  double speed2 = 0, acceleration2 = 0;
};

/// Of one segment at `samples` even times, both ends with it. Eight times at once.
[[gnu::target_clones("avx512f", "avx2", "default")]] Largest Sample(const double (*c)[8], double duration, long samples) {
  using V8 = double __attribute__((vector_size(64)));
  V8 t = {}, speed2 = {}, acceleration2 = {};
  const double step = duration / static_cast<double>(samples - 1);
  for (int lane = 0; lane < 8; ++lane) t[lane] = lane;
  for (long i = 0; i < samples; i += 8) {
    V8 tau = (t + static_cast<double>(i)) * step;
    tau = tau < duration ? tau : V8{} + duration;
    V8 v2 = {}, a2 = {};
    for (int axis = 0; axis < 3; ++axis) {
      V8 v = V8{} + 7 * c[axis][7], a = V8{} + 42 * c[axis][7];
      for (int k = 6; k >= 1; --k) v = v * tau + k * c[axis][k];
      for (int k = 6; k >= 2; --k) a = a * tau + k * (k - 1) * c[axis][k];
      v2 += v * v;
      a2 += a * a;
    }
    speed2 = v2 > speed2 ? v2 : speed2;
    acceleration2 = a2 > acceleration2 ? a2 : acceleration2;
  }
  Largest largest;
  for (int lane = 0; lane < 8; ++lane) {
    largest.speed2 = std::max(largest.speed2, speed2[lane]);
    largest.acceleration2 = std::max(largest.acceleration2, acceleration2[lane]);
  }
  return largest;
}

/// 2 to 9 waypoints in a cube of 32 m, durations of 0.5 to 8 s, every third time moving at the ends.
PolynomialTrajectory RandomTrajectory(uint64_t id) {
  RngStream random(1, "peaks check", id);
  const auto vector = [&](double size) {
    return Vec3d{random.Uniform(-size, size), random.Uniform(-size, size), random.Uniform(-size, size)};
  };
  const size_t segments = 1 + id % 8;
  std::vector<Vec3d> waypoints;
  std::vector<double> durations;
  for (size_t i = 0; i <= segments; ++i) waypoints.push_back(vector(16));
  for (size_t i = 0; i < segments; ++i) durations.push_back(0.5 * std::pow(16, random.Uniform(0, 1)));
  MinimumSnapProblem problem{.waypoints = waypoints, .durations = durations};
  if (id % 3 == 0) problem.start = {vector(5), vector(3), vector(2)};
  return SolveMinimumSnap(problem);
}

struct Margin {
  double below = 0, above = 0;  // certified over sampled, less 1: most negative and largest
  void Add(double certified, double sampled) {
    below = std::min(below, certified / sampled - 1);
    above = std::max(above, certified / sampled - 1);
  }
};

}  // namespace

int main(int argc, char** argv) {
  const uint64_t trajectories = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10'000;
  const long samples = argc > 2 ? std::atol(argv[2]) : 1'000'000;
  std::atomic<uint64_t> next = 0;
  std::mutex mutex;
  Margin speed, acceleration;
  const auto work = [&] {
    Margin own_speed, own_acceleration;
    for (uint64_t id = next++; id < trajectories; id = next++) {
      const PolynomialTrajectory path = RandomTrajectory(id);
      const TrajectoryPeaks peaks = CertifiedPeaks(path);
      Largest largest;
      for (size_t i = 0; i < path.segments(); ++i) {
        double c[3][8];
        for (int axis = 0; axis < 3; ++axis) std::ranges::copy(path.coefficients(i, axis), c[axis]);
        const Largest here = Sample(c, path.durations()[i], samples / static_cast<long>(path.segments()));
        largest.speed2 = std::max(largest.speed2, here.speed2);
        largest.acceleration2 = std::max(largest.acceleration2, here.acceleration2);
      }
      own_speed.Add(peaks.speed.value, std::sqrt(largest.speed2));
      own_acceleration.Add(peaks.acceleration.value, std::sqrt(largest.acceleration2));
    }
    const std::lock_guard lock(mutex);
    for (const auto& [all, own] : {std::pair{&speed, own_speed}, std::pair{&acceleration, own_acceleration}}) {
      all->below = std::min(all->below, own.below);
      all->above = std::max(all->above, own.above);
    }
  };
  std::thread other(work);
  work();
  other.join();
  std::printf(
      "%llu trajectories of %ld samples: certified / sampled - 1: speed %.3g to %.3g, acceleration %.3g to "
      "%.3g\n",
      static_cast<unsigned long long>(trajectories), samples, speed.below, speed.above, acceleration.below, acceleration.above);
  return speed.below < 0 || acceleration.below < 0;
}
