// Whole-path maxima of speed and acceleration by bounding all segments first and refining only those whose
// bound exceeds what is known to be attained.
#include <algorithm>
#include <array>
#include <cmath>

#include "airsim360/planning/splines/aligned_buffer.h"
#include "airsim360/planning/splines/hull_kernel.h"
#include "airsim360/planning/splines/trajectory_limits.h"

namespace airsim360 {
namespace {

using internal::kAccelerationControls;
using internal::kSpeedControls;

/// Width of the certified bracket, relative, of the squares.
constexpr double kPeakWidth = 2e-11;

/// Bernstein control values on a part of a segment.
template <int n>
struct Part {
  std::array<double, n + 1> control;
  double from, length;
};

/// Derivatives d, d + 1 and d + 2 of a segment at tau, in units of its duration.
struct LocalDerivatives {
  Vec3d first, second, third;
};

LocalDerivatives Evaluate(const PolynomialTrajectory& trajectory, size_t segment, int derivative, double tau) {
  const double t = tau * trajectory.durations()[segment];
  LocalDerivatives out;
  for (int axis = 0; axis < 3; ++axis) {
    const std::span<const double> c = trajectory.coefficients(segment, axis);
    // Horner's scheme for the polynomial sum_k f_k c_k t^(k - d) and its two derivatives over 1 and 2.
    double p = 0, s = 0, h = 0;
    for (int k = trajectory.degree(); k >= derivative; --k) {
      const double factor = derivative == 1 ? k : k * (k - 1);
      h = h * t + s;
      s = s * t + p;
      p = p * t + factor * c[static_cast<size_t>(k)];
    }
    out.first[axis] = p;
    out.second[axis] = s;
    out.third[axis] = 2 * h;
  }
  return out;
}

/// The peak of one quantity over one path.
template <int n, int derivative>
class PeakSearch {
 public:
  PeakSearch(const PolynomialTrajectory& trajectory, const double* bounds, const double* controls, size_t controls_per_segment)
      : trajectory_(trajectory), bounds_(bounds), controls_(controls), stride_(controls_per_segment) {}

  CertifiedPeak Run() {
    // Attained for certain: the values at waypoints.
    const size_t segments = trajectory_.segments();
    for (size_t i = 0; i < segments; ++i) {
      Attain(Control(i, 0), i, 0);
      Attain(Control(i, n), i, 1);
    }
    double bound = 0;
    static thread_local std::vector<size_t> open;
    open.clear();
    for (size_t i = 0; i < segments; ++i) {
      if (bounds_[i] > Ceiling()) {
        open.push_back(i);
      } else {
        bound = std::max(bound, bounds_[i]);
      }
    }
    // The most promising segment first: it lifts the floor over most others.
    while (!open.empty()) {
      const auto top = std::max_element(open.begin(), open.end(), [&](size_t a, size_t b) { return bounds_[a] < bounds_[b]; });
      const size_t segment = *top;
      if (bounds_[segment] <= Ceiling()) {
        bound = std::max(bound, bounds_[segment]);
        break;
      }
      *top = open.back();
      open.pop_back();
      double largest = 0;
      for (int k = 0; k <= n; ++k) largest = std::max(largest, Control(segment, k));
      const double allowance = bounds_[segment] - largest;
      bound = std::max(bound, Refine(segment) + allowance);
    }
    return {std::sqrt(std::max(bound, floor_)), time_};
  }

 private:
  double Control(size_t segment, int k) const { return controls_[(segment / 8 * stride_ + static_cast<size_t>(k)) * 8 + segment % 8]; }
  double Ceiling() const { return floor_ * (1 + kPeakWidth); }

  void Attain(double value, size_t segment, double tau) {
    if (value <= floor_) return;
    floor_ = value;
    time_ = trajectory_.start(segment) + tau * trajectory_.durations()[segment];
  }

  /// Upper bound of the segment, at most kPeakWidth above the floor, which it raises.
  double Refine(size_t segment) {
    Part<n> whole = {{}, 0, 1};
    for (int k = 0; k <= n; ++k) whole.control[static_cast<size_t>(k)] = Control(segment, k);
    double bound = 0;
    // Depth first; every split at least thins the part by a thousandth, so this stays small.
    std::array<Part<n>, 64> stack;
    size_t size = 0;
    stack[size++] = whole;
    while (size > 0) {
      const Part<n> part = stack[--size];
      const double largest = *std::max_element(part.control.begin(), part.control.end());
      if (largest <= Ceiling() || part.length < 1e-12 || size + 2 > stack.size()) {
        bound = std::max(bound, largest);
        continue;
      }
      const double at = SplitPoint(segment, part);
      Split(part, at, stack[size], stack[size + 1]);
      Attain(stack[size + 1].control[0], segment, stack[size + 1].from);
      size += 2;
    }
    return bound;
  }

  /// Where |d|^2 has its maximum on a part whose control values rise and then fall (Newton's method from the
  /// largest one), or the middle.
  double SplitPoint(size_t segment, const Part<n>& part) {
    const auto& c = part.control;
    const auto top = std::max_element(c.begin(), c.end());
    const bool one_hill =
        top != c.begin() && top + 1 != c.end() && std::is_sorted(c.begin(), top + 1) && std::is_sorted(top, c.end(), std::greater<>());
    const double duration = trajectory_.durations()[segment];
    double low = part.from, high = part.from + part.length;
    if (!one_hill) return 0.5;
    double tau = low + part.length * static_cast<double>(top - c.begin()) / n;
    for (int i = 0; i < 12; ++i) {
      const LocalDerivatives d = Evaluate(trajectory_, segment, derivative, tau);
      const double slope = Dot(d.first, d.second);
      const double curvature = (Dot(d.second, d.second) + Dot(d.first, d.third)) * duration;
      (slope > 0 ? low : high) = tau;
      double next = tau - slope / curvature;
      if (!(curvature < 0) || !(next > low && next < high)) next = 0.5 * (low + high);
      const double moved = std::abs(next - tau);
      tau = next;
      // The value at a maximum depends on the square of the distance from it.
      if (moved < 1e-7) break;
    }
    const LocalDerivatives d = Evaluate(trajectory_, segment, derivative, tau);
    Attain(Dot(d.first, d.first), segment, tau);
    return std::clamp((tau - part.from) / part.length, 1e-3, 1 - 1e-3);
  }

  static void Split(const Part<n>& part, double at, Part<n>& left, Part<n>& right) {
    std::array<double, n + 1> b = part.control;
    const double from = part.from, length = part.length;
    for (int level = n; level >= 0; --level) {
      left.control[static_cast<size_t>(n - level)] = b[0];
      right.control[static_cast<size_t>(level)] = b[static_cast<size_t>(level)];
      for (size_t i = 0; i < static_cast<size_t>(level); ++i) b[i] += at * (b[i + 1] - b[i]);
    }
    left.from = from;
    left.length = at * length;
    right.from = from + at * length;
    right.length = length - at * length;
  }

  const PolynomialTrajectory& trajectory_;
  const double* bounds_;
  const double* controls_;
  size_t stride_;
  double floor_ = 0, time_ = 0;
};

}  // namespace

TrajectoryPeaks CertifiedPeaks(const PolynomialTrajectory& trajectory) {
  const size_t groups = (trajectory.segments() + 7) / 8;
  static thread_local internal::AlignedBuffer memory;
  double* const speed_bounds = memory.Reserve(groups * 8 * (2 + kSpeedControls + kAccelerationControls));
  double* const acceleration_bounds = speed_bounds + groups * 8;
  double* const speed_controls = acceleration_bounds + groups * 8;
  double* const acceleration_controls = speed_controls + groups * 8 * kSpeedControls;
  AIRSIM360_SELECT_KERNEL(kHullKernels)
      ->hulls({.coefficients = trajectory.coefficients().data(),
               .durations = trajectory.durations().data(),
               .segments = trajectory.segments(),
               .powers = trajectory.degree() + 1,
               .speed_bounds = speed_bounds,
               .acceleration_bounds = acceleration_bounds,
               .speed_controls = speed_controls,
               .acceleration_controls = acceleration_controls});
  const auto search = [&]<int n, int derivative>(const double* bounds, const double* controls, size_t stride) {
    return PeakSearch<n, derivative>(trajectory, bounds, controls, stride).Run();
  };
  if (trajectory.degree() == 7) {
    return {search.template operator()<12, 1>(speed_bounds, speed_controls, kSpeedControls),
            search.template operator()<10, 2>(acceleration_bounds, acceleration_controls, kAccelerationControls)};
  }
  return {search.template operator()<8, 1>(speed_bounds, speed_controls, kSpeedControls),
          search.template operator()<6, 2>(acceleration_bounds, acceleration_controls, kAccelerationControls)};
}

}  // namespace airsim360
