#include "airsim360/mpde/evaluate.h"

#include <cmath>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr int kDraws = 2000;  // of the bootstrap

}  // namespace

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
  report.distance_interval = BootstrapIntervals(misses.size(), kDraws, seed, [&](std::span<const uint32_t> draws) {
    double sum = 0;
    for (size_t i = 0; i < misses.size(); ++i) sum += draws[i] * misses[i];
    return std::vector{sum / n};
  })[0];
  return report;
}

}  // namespace airsim360
