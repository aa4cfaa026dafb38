#include "airsim360/eval/mpde_metrics.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

constexpr double kMonolocoDegrees = 180 / 3.14;  // their constant, kept so that figures can be compared

void CheckPoses(const char* what, std::span<const PersonPose> poses) {
  for (size_t i = 0; i < poses.size(); ++i) {
    if (!std::isfinite(poses[i].distance) || !std::isfinite(poses[i].angle))
      throw InputError(std::string(what) + " of person " + std::to_string(i) + ": distance and angle must be finite numbers");
  }
}

}  // namespace

double CheckPersonDistance(double distance, const char* what) {
  if (!(distance >= 0 && std::isfinite(distance)))
    throw InputError(std::string(what) + ": " + std::to_string(distance) + " is not a finite number of at least 0 m");
  return distance;
}

double WrapAngle(double angle) {
  const double wrapped = std::remainder(angle, 2 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? wrapped + 2 * std::numbers::pi : wrapped;
}

MpdeErrors MeasureMpde(std::span<const PersonPose> predicted, std::span<const PersonPose> truth) {
  if (predicted.size() != truth.size())
    throw InputError(std::to_string(predicted.size()) + " persons are predicted, " + std::to_string(truth.size()) + " are true");
  CheckPoses("prediction", predicted);
  CheckPoses("truth", truth);
  MpdeErrors sum{static_cast<int64_t>(truth.size())};
  for (size_t i = 0; i < truth.size(); ++i) {
    sum.distance_mae_m += std::abs(predicted[i].distance - truth[i].distance);
    sum.angle_mae_deg += std::abs(WrapAngle(predicted[i].angle - truth[i].angle)) * 180 / std::numbers::pi;
    sum.angle_unwrapped_mae_deg += std::abs(WrapAngle(predicted[i].angle) - WrapAngle(truth[i].angle)) * kMonolocoDegrees;
  }
  // Nobody: 0 / 0 is the NaN that the header promises.
  const auto n = static_cast<double>(truth.size());
  return {sum.count, sum.distance_mae_m / n, sum.angle_mae_deg / n, sum.angle_unwrapped_mae_deg / n};
}

std::array<MpdeErrors, kMpdeGroupEnds.size() + 1> MeasureMpdeGroups(std::span<const PersonPose> predicted,
                                                                    std::span<const PersonPose> truth) {
  if (predicted.size() != truth.size()) MeasureMpde(predicted, truth);  // says what is wrong
  std::array<std::vector<PersonPose>, kMpdeGroupEnds.size() + 1> groups, true_groups;
  for (size_t i = 0; i < truth.size(); ++i) {
    size_t group = 0;
    while (group < kMpdeGroupEnds.size() && truth[i].distance >= kMpdeGroupEnds[group]) ++group;
    groups[group].push_back(predicted[i]);
    true_groups[group].push_back(truth[i]);
  }
  std::array<MpdeErrors, kMpdeGroupEnds.size() + 1> errors;
  for (size_t group = 0; group < errors.size(); ++group) errors[group] = MeasureMpde(groups[group], true_groups[group]);
  return errors;
}

MpdeErrors PoolMpde(std::span<const MpdeErrors> sets) {
  MpdeErrors sum;
  for (const MpdeErrors& set : sets) {
    if (set.count <= 0) continue;
    const auto weight = static_cast<double>(set.count);
    sum.count += set.count;
    sum.distance_mae_m += weight * set.distance_mae_m;
    sum.angle_mae_deg += weight * set.angle_mae_deg;
    sum.angle_unwrapped_mae_deg += weight * set.angle_unwrapped_mae_deg;
  }
  const auto n = static_cast<double>(sum.count);
  return {sum.count, sum.distance_mae_m / n, sum.angle_mae_deg / n, sum.angle_unwrapped_mae_deg / n};
}

}  // namespace airsim360
