#include "airsim360/mpde/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"

namespace airsim360 {

Interval BootstrapMean(std::span<const double> values, uint64_t seed) {
  constexpr int kDraws = 2000, kTail = kDraws / 40;  // 2.5 % on either side
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {kNone, kNone};
  RngStream random(seed, "bootstrap");
  std::vector<double> means;
  for (int i = 0; i < kDraws; ++i) {
    double sum = 0;
    for (size_t k = 0; k < values.size(); ++k) sum += values[random.Index(static_cast<uint32_t>(values.size()))];
    means.push_back(sum / static_cast<double>(values.size()));
  }
  std::ranges::sort(means);
  return {means[kTail], means[kDraws - 1 - kTail]};
}

MpdeReport Judge(std::span<const MpdePrediction> predictions, std::span<const MpdeSample> samples, uint64_t seed) {
  if (samples.empty()) throw InputError("there is nobody to judge by");
  std::vector<PersonPose> predicted, truth;
  for (const MpdePrediction& prediction : predictions) predicted.push_back(prediction.pose);
  for (const MpdeSample& sample : samples) truth.push_back(sample.truth);
  MpdeReport report;
  report.errors = MeasureMpde(predicted, truth);
  report.groups = MeasureMpdeGroups(predicted, truth);
  std::vector<double> misses;
  const auto n = static_cast<double>(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    misses.push_back(std::abs(predicted[i].distance - truth[i].distance));
    report.within_spread += (misses[i] <= predictions[i].spread_m ? 1 : 0) / n;
    report.constant_height_mae_m += std::abs(ConstantHeightDistance(samples[i].rays) - truth[i].distance) / n;
    report.constant_trunk_mae_m += std::abs(ConstantTrunkDistance(samples[i].rays) - truth[i].distance) / n;
  }
  report.distance_interval = BootstrapMean(misses, seed);
  return report;
}

}  // namespace airsim360
