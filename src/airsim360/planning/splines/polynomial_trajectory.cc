#include "airsim360/planning/splines/polynomial_trajectory.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

/// i times an interval; of a short decimal (0.1) the number nearest to the decimal product (0.3, not 0.1 * 3).
class Multiples {
 public:
  explicit Multiples(double interval) : interval_(interval) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof(text), interval, std::chars_format::scientific).ptr;
    const std::string_view decimal(text, static_cast<size_t>(end - text));
    const size_t e = decimal.find('e');
    int exponent = 0;
    std::from_chars(decimal.data() + e + (decimal[e + 1] == '+' ? 2 : 1), end, exponent);
    for (const char c : decimal.substr(0, e)) {
      if (c == '.') continue;
      digits_ = 10 * digits_ + (c - '0');
      ++places_;
    }
    places_ -= 1 + exponent;  // digits after the point
  }

  double operator()(size_t i) const {
    // Exact up to the division, which rounds once.
    constexpr int64_t kExact = int64_t{1} << 53;
    const bool exact = places_ >= 0 && places_ <= 22 && digits_ < kExact && static_cast<int64_t>(i) <= kExact / digits_;
    return exact ? static_cast<double>(static_cast<int64_t>(i) * digits_) / std::pow(10.0, places_) : static_cast<double>(i) * interval_;
  }

 private:
  double interval_;
  int64_t digits_ = 0;
  int places_ = 0;
};

void CheckFinite(std::span<const double> values, const char* what) {
  for (size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      throw InputError(std::string("trajectory: ") + what + " " + std::to_string(i) + " is not finite");
    }
  }
}

/// Derivatives 0 to 4 of one polynomial at t, by Horner's scheme on value and derivatives together.
std::array<double, 5> Evaluate(std::span<const double> c, double t) {
  std::array<double, 5> taylor = {};
  for (size_t k = c.size(); k-- > 0;) {
    for (int d = 4; d > 0; --d) taylor[d] = taylor[d] * t + taylor[d - 1];
    taylor[0] = taylor[0] * t + c[k];
  }
  return {taylor[0], taylor[1], 2 * taylor[2], 6 * taylor[3], 24 * taylor[4]};
}

}  // namespace

PolynomialTrajectory::PolynomialTrajectory(int degree, std::vector<double> durations, std::vector<double> coefficients)
    : degree_(degree), durations_(std::move(durations)), coefficients_(std::move(coefficients)) {
  if (degree != 5 && degree != 7) {
    throw InputError("trajectory: degree " + std::to_string(degree) + ", must be 5 or 7");
  }
  if (durations_.empty() || coefficients_.size() != durations_.size() * 3 * (degree_ + 1)) {
    throw InputError("trajectory: " + std::to_string(durations_.size()) + " durations and " + std::to_string(coefficients_.size()) +
                     " coefficients of degree " + std::to_string(degree_) + " do not agree");
  }
  CheckFinite(durations_, "duration");
  CheckFinite(coefficients_, "coefficient");
  starts_.reserve(durations_.size() + 1);
  double t = 0;
  for (size_t i = 0; i < durations_.size(); ++i) {
    if (!(durations_[i] > 0)) {
      throw InputError("trajectory: duration " + std::to_string(i) + " is " + std::to_string(durations_[i]) + " s, must be positive");
    }
    starts_.push_back(t);
    t += durations_[i];
  }
  starts_.push_back(t);
}

std::span<const double> PolynomialTrajectory::coefficients(size_t segment, int axis) const {
  const size_t powers = static_cast<size_t>(degree_) + 1;
  return std::span(coefficients_).subspan((segment * 3 + static_cast<size_t>(axis)) * powers, powers);
}

TrajectoryPoint PolynomialTrajectory::At(double t) const {
  // The segment whose half-open interval holds t; the last one also holds the end.
  const double clamped = std::clamp(t, 0.0, duration());
  const auto after = std::upper_bound(starts_.begin() + 1, starts_.end() - 1, clamped);
  const size_t segment = static_cast<size_t>(after - starts_.begin()) - 1;
  const double local = std::min(clamped - starts_[segment], durations_[segment]);

  TrajectoryPoint point;
  for (int axis = 0; axis < 3; ++axis) {
    const std::array<double, 5> d = Evaluate(coefficients(segment, axis), local);
    point.p[axis] = d[0];
    point.v[axis] = d[1];
    point.a[axis] = d[2];
    point.jerk[axis] = d[3];
    point.snap[axis] = d[4];
  }
  return point;
}

double IntegralOfSquaredDerivative(const PolynomialTrajectory& trajectory, int derivative) {
  double total = 0;
  for (size_t segment = 0; segment < trajectory.segments(); ++segment) {
    const double duration = trajectory.durations()[segment];
    for (int axis = 0; axis < 3; ++axis) {
      // In the segment's own time the derivative is sum_k g_k tau^k; its square integrates to
      // sum_jk g_j g_k / (j + k + 1), in units of 1 / duration^(2 derivative - 1).
      std::array<double, 8> g = {};
      int terms = 0;
      double power = 1;
      for (int k = 0; k < derivative; ++k) power *= duration;
      for (int k = derivative; k <= trajectory.degree(); ++k, power *= duration) {
        double factor = 1;
        for (int f = k; f > k - derivative; --f) factor *= f;
        g[terms++] = factor * trajectory.coefficients(segment, axis)[k] * power;
      }
      double sum = 0;
      for (int j = 0; j < terms; ++j) {
        for (int k = 0; k < terms; ++k) sum += g[j] * g[k] / (j + k + 1);
      }
      total += sum / std::pow(duration, 2 * derivative - 1);
    }
  }
  return total;
}

PolynomialTrajectory Slowed(const PolynomialTrajectory& trajectory, double factor) {
  std::vector<double> durations(trajectory.durations().begin(), trajectory.durations().end());
  for (double& duration : durations) duration *= factor;
  std::vector<double> coefficients(trajectory.coefficients().begin(), trajectory.coefficients().end());
  const size_t powers = static_cast<size_t>(trajectory.degree()) + 1;
  double scale = 1;
  for (size_t k = 0; k < powers; ++k, scale /= factor) {
    for (size_t i = k; i < coefficients.size(); i += powers) coefficients[i] *= scale;
  }
  return PolynomialTrajectory(trajectory.degree(), std::move(durations), std::move(coefficients));
}

std::vector<double> SampleTimes(double duration, double interval) {
  if (!(duration >= 0) || !std::isfinite(duration)) {
    throw InputError("sampling: duration " + std::to_string(duration) + " s must be finite and not negative");
  }
  if (!(interval > 0) || duration / interval > 1e9) {
    throw InputError("sampling: interval " + std::to_string(interval) + " s must be positive and give at most 1e9 samples");
  }
  const auto whole = static_cast<size_t>(std::floor(duration / interval));
  const Multiples multiple(interval);
  std::vector<double> times;
  times.reserve(whole + 2);
  // A multiple within rounding of the end is the end.
  const double slack = 1e-12 * duration;
  for (size_t i = 0; i <= whole + 1; ++i) {
    const double t = multiple(i);
    if (t <= duration + slack) times.push_back(t);
  }
  if (duration - times.back() > slack) times.push_back(duration);
  return times;
}

}  // namespace airsim360
