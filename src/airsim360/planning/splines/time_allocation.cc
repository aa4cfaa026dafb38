#include "airsim360/planning/splines/time_allocation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/planning/splines/excess_kernel.h"
#include "airsim360/planning/splines/lbfgs.h"

namespace airsim360 {
namespace {

/// One stage of the continuation: exponent 2^squarings of the power mean, samples per segment.
struct Stage {
  int squarings;
  size_t samples;
  double tolerance;
  int max_evaluations;
};

/// The mean tends to the maximum as the exponent grows; each stage starts where the last one ended.
constexpr Stage kStages[] = {{3, 12, 1e-3, 40}, {6, 16, 3e-4, 60}, {9, 32, 1e-4, 120}};

/// Limits that make a flight take longer than this (seconds) are taken for a mistake.
constexpr double kLongestFlight = 1e9;

/// Powers of samples far within the limits are kept from leaving the normal numbers.
constexpr double kLeastExponent = -930, kLeastPower = 0x1p-930;

/// Rows of the first and second derivatives of tau^k at the midpoints of equal parts of [0, 1], as
/// ExcessArguments::basis wants them.
std::vector<double> SampleBasis(size_t samples, size_t share) {
  const size_t size = internal::ExcessBasisSize(share), lanes = size / 16, copies = lanes / share;
  std::vector<double> basis(samples / share * size);
  for (size_t j = 0; j < samples; ++j) {
    const double tau = (static_cast<double>(j) + 0.5) / static_cast<double>(samples);
    double rows[16] = {}, power = 1;  // tau^(k-2) while row k is written
    for (size_t k = 1; k < 8; ++k) {
      rows[k] = static_cast<double>(k) * (k == 1 ? 1 : power * tau);
      if (k < 2) continue;
      rows[8 + k] = static_cast<double>(k * (k - 1)) * power;
      power *= tau;
    }
    double* const at = &basis[j / share * size + j % share * copies];
    for (size_t k = 0; k < 16; ++k) std::fill_n(at + k * lanes, copies, rows[k]);
  }
  return basis;
}

/// That of a stage, made once.
const double* StageBasis(size_t stage, size_t share) {
  static const auto all = [] {
    std::array<std::array<std::vector<double>, 3>, std::size(kStages)> bases;
    for (size_t i = 0; i < bases.size(); ++i) {
      for (const size_t lanes : {1, 2, 4}) bases[i][lanes / 2] = SampleBasis(kStages[i].samples, lanes);
    }
    return bases;
  }();
  return all[stage][share / 2].data();
}

/// F(x) = log(total time) + log(factor by which the path must slow down, smoothed), x = log durations.
/// Unchanged when all durations are multiplied by a factor: nothing to weigh.
class Objective {
 public:
  Objective(std::span<const Vec3d> waypoints, const TrajectoryLimits& limits, SplineKind kind)
      : waypoints_(waypoints),
        limits_(limits),
        kind_(kind),
        durations_(waypoints.size() - 1),
        by_duration_(durations_.size()),
        by_coefficient_(durations_.size() * 3 * static_cast<size_t>(PowersOf(kind))) {}

  void SetStage(size_t stage) {
    stage_ = kStages[stage];
    least_speed_ = std::exp2(kLeastExponent / static_cast<double>(1LL << stage_.squarings));
    share_ = internal::ExcessShare(durations_.size(), stage_.samples);
    basis_ = StageBasis(stage, share_);
  }

  /// Trials whose durations differ far more than these do not count: what the solver says of them is
  /// rounding.
  void SetStart(const std::vector<double>& durations) {
    const auto [least, largest] = std::ranges::minmax(durations);
    most_uneven_ = 1e3 * std::max(10.0, largest / least);
  }

  const std::vector<double>& Durations(const std::vector<double>& x) {
    for (size_t i = 0; i < x.size(); ++i) durations_[i] = std::exp(x[i]);
    return durations_;
  }

  double operator()(const std::vector<double>& x, std::vector<double>& gradient) {
    Durations(x);
    double total = 0;
    for (const double duration : durations_) total += duration;
    const auto [least, largest] = std::ranges::minmax(durations_);
    if (!(largest <= most_uneven_ * least) || !std::isfinite(total)) {
      return std::numeric_limits<double>::infinity();
    }
    solver_.Solve({.waypoints = waypoints_, .durations = durations_, .kind = kind_, .refine = false});
    const double excess = kernels_->excess({.coefficients = solver_.coefficients().data(),
                                            .durations = durations_.data(),
                                            .segments = durations_.size(),
                                            .powers = PowersOf(kind_),
                                            .basis = basis_,
                                            .samples = stage_.samples,
                                            .share = share_,
                                            .squarings = stage_.squarings,
                                            .inverse_speed = 1 / (limits_.speed * limits_.speed),
                                            .inverse_acceleration = 1 / (limits_.acceleration * limits_.acceleration),
                                            .least_speed = least_speed_,
                                            .least_acceleration = least_speed_ * least_speed_,
                                            .weight = 1 / (total * static_cast<double>(stage_.samples)),
                                            .by_coefficient = by_coefficient_.data(),
                                            .by_duration = by_duration_.data()});
    if (!(excess > 4 * kLeastPower) || !std::isfinite(excess)) return std::numeric_limits<double>::infinity();

    // log excess / (2 q), and the share of the total time in the weights.
    solver_.Backpropagate(by_coefficient_, by_duration_, {});
    const double root = 0.5 / static_cast<double>(1LL << stage_.squarings);
    for (size_t i = 0; i < x.size(); ++i) {
      const double by_time = 1 / total + root * (by_duration_[i] / excess - 1 / total);
      gradient[i] = by_time * durations_[i];
      if (!std::isfinite(gradient[i])) return std::numeric_limits<double>::infinity();
    }
    return std::log(total) + root * std::log(excess);
  }

 private:
  std::span<const Vec3d> waypoints_;
  TrajectoryLimits limits_;
  SplineKind kind_;
  Stage stage_ = kStages[0];
  double most_uneven_ = 1e4, least_speed_ = 0;
  size_t share_ = 1;
  const internal::ExcessKernels* kernels_ = AIRSIM360_SELECT_KERNEL(kExcessKernels);
  MinimumSnapSolver solver_;
  std::vector<double> durations_, by_duration_, by_coefficient_;
  const double* basis_ = nullptr;
};

std::vector<double> Chords(std::span<const Vec3d> waypoints) {
  if (waypoints.size() < 2) {
    throw InputError("time allocation: " + std::to_string(waypoints.size()) + " waypoints, at least 2 are needed");
  }
  std::vector<double> chords;
  for (size_t i = 0; i + 1 < waypoints.size(); ++i) {
    chords.push_back(Norm(waypoints[i + 1] - waypoints[i]));
    if (!std::isfinite(chords.back())) {
      throw InputError("time allocation: waypoint " + std::to_string(i) + " or the next is not finite");
    }
    if (!(chords.back() > 0)) {
      throw InputError("time allocation: waypoints " + std::to_string(i) + " and " + std::to_string(i + 1) + " coincide");
    }
  }
  return chords;
}

PolynomialTrajectory Fly(std::span<const Vec3d> waypoints, std::span<const double> durations, SplineKind kind,
                         const TrajectoryLimits& limits) {
  return ScaleToLimits(SolveMinimumSnap({.waypoints = waypoints, .durations = durations, .kind = kind}), limits);
}

/// Slowed down where a path within the limits of speed and acceleration breaks another.
PolynomialTrajectory WithOtherLimits(PolynomialTrajectory path, const TrajectoryLimits& limits) {
  TrajectoryLimits others = limits;
  others.speed = others.acceleration = TrajectoryLimits::kNone;
  if (WithinLimits(path, others)) return path;
  return ScaleToLimits(path, limits);
}

/// Improves the durations of a feasible path stage by stage; returns the number of evaluations.
int Optimise(std::span<const Vec3d> waypoints, const TrajectoryLimits& limits, SplineKind kind, std::vector<double>& durations) {
  Objective objective(waypoints, limits, kind);
  objective.SetStart(durations);
  internal::Lbfgs minimiser;
  std::vector<double> x;
  for (const double duration : durations) x.push_back(std::log(duration));
  int evaluations = 0;
  for (size_t i = 0; i < std::size(kStages); ++i) {
    objective.SetStage(i);
    evaluations +=
        minimiser.Minimise(x, {.max_evaluations = kStages[i].max_evaluations, .tolerance = kStages[i].tolerance}, std::ref(objective));
  }
  durations = objective.Durations(x);
  return evaluations;
}

/// Splits of a leg that are tried, and how much longer than the shortest of them a flight in fewer may take.
constexpr size_t kSplits[] = {2, 4, 6, 8, 10, 12, 16};
constexpr double kWorthASplit = 1.01;

/// Way at time t of the fastest straight flight over `distance` from rest to rest.
double RestToRestWay(double t, double distance, double max_speed, double max_acceleration) {
  const double total = RestToRestTime(distance, max_speed, max_acceleration);
  const double ramp = std::min(max_speed / max_acceleration, total / 2);
  if (t > total / 2) return distance - RestToRestWay(total - t, distance, max_speed, max_acceleration);
  return t < ramp ? max_acceleration * t * t / 2 : max_acceleration * ramp * (t - ramp / 2);
}

/// `count` points between a and b at even times of the fastest straight flight.
std::vector<Vec3d> OnTheWay(Vec3d a, Vec3d b, size_t count, const TrajectoryLimits& limits) {
  const double distance = Norm(b - a), total = RestToRestTime(distance, limits.speed, limits.acceleration);
  std::vector<Vec3d> points = {a};
  for (size_t i = 1; i <= count; ++i) {
    const double t = total * static_cast<double>(i) / static_cast<double>(count + 1);
    points.push_back(a + (b - a) * (RestToRestWay(t, distance, limits.speed, limits.acceleration) / distance));
  }
  points.push_back(b);
  return points;
}

/// The flight through exactly these waypoints.
PolynomialTrajectory Fastest(std::span<const Vec3d> waypoints, const TrajectoryLimits& limits, const AllocationOptions& options,
                             int& evaluations) {
  std::vector<double> durations;
  for (const double chord : Chords(waypoints)) durations.push_back(RestToRestTime(chord, limits.speed, limits.acceleration));
  // As fast as speed and acceleration allow, which is where the objective has its numbers.
  const TrajectoryLimits norms = {.speed = limits.speed, .acceleration = limits.acceleration};
  PolynomialTrajectory best = Fly(waypoints, durations, options.kind, norms);
  if (!options.optimise || durations.size() == 1) return WithOtherLimits(std::move(best), limits);
  durations.assign(best.durations().begin(), best.durations().end());
  evaluations += Optimise(waypoints, limits, options.kind, durations);
  PolynomialTrajectory optimised = WithOtherLimits(Fly(waypoints, durations, options.kind, norms), limits);
  best = WithOtherLimits(std::move(best), limits);
  return optimised.duration() < best.duration() ? optimised : best;
}

/// `whole` flies from a to b in one segment: the flight in the fewest that is nearly as short as any.
PolynomialTrajectory Split(PolynomialTrajectory whole, Vec3d a, Vec3d b, const TrajectoryLimits& limits, const AllocationOptions& options,
                           int& evaluations) {
  std::vector<PolynomialTrajectory> flights = {std::move(whole)};
  for (const size_t count : kSplits) {
    const std::vector<Vec3d> points = OnTheWay(a, b, count, limits);
    if (std::ranges::adjacent_find(points) != points.end()) break;  // too near for so many
    flights.push_back(Fastest(points, limits, options, evaluations));
  }
  double least = std::numeric_limits<double>::infinity();
  for (const PolynomialTrajectory& flight : flights) least = std::min(least, flight.duration());
  return *std::ranges::find_if(flights, [&](const auto& flight) { return flight.duration() <= kWorthASplit * least; });
}

}  // namespace

double RestToRestTime(double distance, double max_speed, double max_acceleration) {
  const double ramp = max_speed * max_speed / max_acceleration;
  return distance >= ramp ? distance / max_speed + max_speed / max_acceleration : 2 * std::sqrt(distance / max_acceleration);
}

AllocatedTrajectory AllocateTimes(std::span<const Vec3d> waypoints, const TrajectoryLimits& limits, const AllocationOptions& options) {
  CheckLimits(limits);
  if (!std::isfinite(limits.speed) || !std::isfinite(limits.acceleration)) {
    throw InputError("time allocation: limits on speed and acceleration must be finite");
  }
  double length = 0;
  for (const double chord : Chords(waypoints)) length += chord;
  int evaluations = 0;
  PolynomialTrajectory best = Fastest(waypoints, limits, options, evaluations);
  if (options.split && options.optimise && waypoints.size() == 2 && best.duration() <= kLongestFlight)
    best = Split(std::move(best), waypoints[0], waypoints[1], limits, options, evaluations);
  if (options.sample_interval > 0) {
    const double steps = std::ceil(best.duration() / options.sample_interval * (1 - 1e-12));
    best = Slowed(best, std::max(1.0, steps * options.sample_interval / best.duration()));
  }
  if (!(best.duration() <= kLongestFlight)) {
    char text[160];
    std::snprintf(text, sizeof(text), "limits: within %g m/s and %g m/s^2 the flight would take %.3g s", limits.speed, limits.acceleration,
                  best.duration());
    throw InputError(text);
  }
  const TrajectoryPeaks peaks = CertifiedPeaks(best);
  const double bound = RestToRestTime(length, limits.speed, limits.acceleration);
  return {std::move(best), peaks, bound, evaluations};
}

}  // namespace airsim360
