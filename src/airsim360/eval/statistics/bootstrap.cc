#include "airsim360/eval/statistics/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "airsim360/base/error.h"
#include "airsim360/base/parallel.h"
#include "airsim360/base/random.h"

namespace airsim360 {
namespace {

constexpr int kMostReplicates = 100000;

double Percentile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(at);
  const double rest = at - static_cast<double>(below);
  return below + 1 < sorted.size() ? sorted[below] + rest * (sorted[below + 1] - sorted[below]) : sorted[below];
}

}  // namespace

std::vector<Interval> BootstrapIntervals(size_t items, int replicates, uint64_t seed,
                                         const std::function<std::vector<double>(std::span<const uint32_t>)>& statistic) {
  if (replicates < 1 || replicates > kMostReplicates)
    throw InputError("--bootstrap " + std::to_string(replicates) + ": must be 1 to " + std::to_string(kMostReplicates));
  if (items == 0) throw InputError("--bootstrap: there is nothing to draw from");
  std::vector<std::vector<double>> drawn(static_cast<size_t>(replicates));
  ParallelFor(replicates, [&](int64_t r) {
    RngStream random(seed, "bootstrap", static_cast<uint64_t>(r));
    std::vector<uint32_t> draws(items, 0);
    for (size_t i = 0; i < items; ++i) ++draws[random.Index(static_cast<uint32_t>(items))];
    drawn[static_cast<size_t>(r)] = statistic(draws);
  });
  std::vector<Interval> intervals;
  for (size_t figure = 0; figure < drawn[0].size(); ++figure) {
    std::vector<double> values;
    for (const auto& replicate : drawn) {
      if (std::isfinite(replicate[figure])) values.push_back(replicate[figure]);
    }
    std::sort(values.begin(), values.end());
    intervals.push_back({Percentile(values, 0.025), Percentile(values, 0.975)});
  }
  return intervals;
}

}  // namespace airsim360
