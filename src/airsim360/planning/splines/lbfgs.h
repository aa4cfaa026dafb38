// Limited-memory BFGS (Nocedal, Wright: Numerical Optimization, 2nd ed., algorithm 7.4) with the weak Wolfe
// line search of Lewis and Overton (2013), which also copes with nearly nonsmooth functions.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace airsim360::internal {

struct LbfgsOptions {
  size_t memory = 10;
  int max_evaluations = 100;
  /// Stops when the last `patience` steps together lower the value by less than this.
  double tolerance = 1e-6;
  int patience = 3;
};

class Lbfgs {
 public:
  /// Minimises from x, in place. `objective(x, gradient)` returns the value and fills the gradient; a value
  /// that is not finite makes the step shorter. Returns the number of evaluations.
  template <class Objective>
  int Minimise(std::vector<double>& x, const LbfgsOptions& options, Objective objective) {
    const size_t n = x.size();
    pairs_.assign(options.memory, {});
    count_ = 0;
    gradient_.resize(n);
    std::vector<double> past;
    double value = objective(x, gradient_);
    int evaluations = 1;
    if (!std::isfinite(value)) return evaluations;
    while (evaluations < options.max_evaluations) {
      past.push_back(value);
      const size_t window = static_cast<size_t>(options.patience);
      if (past.size() > window && past[past.size() - 1 - window] - value < options.tolerance) break;
      Direction();
      double slope = Dot(direction_, gradient_);
      if (!(slope < 0)) {
        // The curvature has misled: start again from steepest descent.
        count_ = 0;
        for (size_t i = 0; i < n; ++i) direction_[i] = -gradient_[i];
        slope = Dot(direction_, gradient_);
        if (!(slope < 0)) break;
      }
      // Unscaled first steps must not jump: variables are logarithms.
      const double largest = Largest(direction_);
      double step = count_ == 0 ? std::min(1.0, 0.1 / largest) : std::min(1.0, 1.0 / largest);
      const bool moved = Search(x, value, slope, step, options.max_evaluations, evaluations, objective);
      if (!moved) break;
    }
    return evaluations;
  }

 private:
  struct Pair {
    std::vector<double> s, y;
    double rho = 0;
  };

  static double Dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }
  static double Largest(const std::vector<double>& a) {
    double largest = 1e-300;
    for (const double v : a) largest = std::max(largest, std::abs(v));
    return largest;
  }

  /// direction = -H gradient by the two-loop recursion.
  void Direction() {
    const size_t n = gradient_.size(), memory = pairs_.size(), kept = std::min(count_, memory);
    direction_.resize(n);
    for (size_t i = 0; i < n; ++i) direction_[i] = -gradient_[i];
    std::vector<double> alpha(kept);
    for (size_t j = 0; j < kept; ++j) {
      const Pair& pair = pairs_[(count_ - 1 - j) % memory];
      alpha[j] = pair.rho * Dot(pair.s, direction_);
      for (size_t i = 0; i < n; ++i) direction_[i] -= alpha[j] * pair.y[i];
    }
    if (kept > 0) {
      const Pair& last = pairs_[(count_ - 1) % memory];
      const double scale = 1 / (last.rho * Dot(last.y, last.y));
      for (double& d : direction_) d *= scale;
    }
    for (size_t j = kept; j-- > 0;) {
      const Pair& pair = pairs_[(count_ - 1 - j) % memory];
      const double beta = pair.rho * Dot(pair.y, direction_);
      for (size_t i = 0; i < n; ++i) direction_[i] += (alpha[j] - beta) * pair.s[i];
    }
  }

  /// Moves x to a point of sufficient decrease and curvature by bisection; false if none was found.
  template <class Objective>
  bool Search(std::vector<double>& x, double& value, double slope, double step, int max_evaluations, int& evaluations,
              Objective& objective) {
    constexpr double kDecrease = 1e-4, kCurvature = 0.9;
    const size_t n = x.size();
    double low = 0, high = INFINITY;
    trial_.resize(n);
    trial_gradient_.resize(n);
    for (int i = 0; i < 30; ++i) {
      for (size_t j = 0; j < n; ++j) trial_[j] = x[j] + step * direction_[j];
      const double trial_value = objective(trial_, trial_gradient_);
      ++evaluations;
      if (!(trial_value <= value + kDecrease * step * slope)) {
        high = step;
      } else if (Dot(trial_gradient_, direction_) < kCurvature * slope) {
        low = step;
      } else {
        Remember(x);
        x.swap(trial_);
        gradient_.swap(trial_gradient_);
        value = trial_value;
        return true;
      }
      if (evaluations >= max_evaluations) return false;
      step = high < INFINITY ? 0.5 * (low + high) : 2 * low;
    }
    return false;
  }

  void Remember(const std::vector<double>& x) {
    const size_t n = x.size();
    Pair& pair = pairs_[count_ % pairs_.size()];
    pair.s.resize(n);
    pair.y.resize(n);
    for (size_t i = 0; i < n; ++i) {
      pair.s[i] = trial_[i] - x[i];
      pair.y[i] = trial_gradient_[i] - gradient_[i];
    }
    const double curvature = Dot(pair.s, pair.y);
    if (curvature <= 1e-16 * Dot(pair.y, pair.y)) return;
    pair.rho = 1 / curvature;
    ++count_;
  }

  std::vector<Pair> pairs_;
  size_t count_ = 0;
  std::vector<double> gradient_, direction_, trial_, trial_gradient_;
};

}  // namespace airsim360::internal
