// Polynomials on [0, 1] in the Bernstein basis: the control values bound the polynomial from both sides.
#pragma once

#include <array>
#include <cstddef>

namespace airsim360::internal {

/// Degree at most 20 (the largest that flight limits need: squared body rate against thrust).
struct Bernstein {
  static constexpr int kMaxDegree = 20;
  int degree = 0;
  std::array<double, kMaxDegree + 1> control = {};

  /// The polynomial sum_k c_k tau^k, k <= degree.
  static Bernstein FromPowers(const double* c, int degree);
  double At(double tau) const;
  double Largest() const;  ///< largest control value: an upper bound on [0, 1]
  /// The parts on [0, at] and [at, 1], each over [0, 1] again (de Casteljau).
  void Split(double at, Bernstein& left, Bernstein& right) const;
};

Bernstein operator+(const Bernstein& a, const Bernstein& b);  ///< equal degrees
Bernstein operator-(const Bernstein& a, const Bernstein& b);  ///< equal degrees
Bernstein operator*(const Bernstein& a, const Bernstein& b);
Bernstein operator*(const Bernstein& a, double factor);
/// a + constant.
Bernstein Shifted(const Bernstein& a, double constant);

/// The maximum over [0, 1] if it exceeds `floor`: raises floor to a value that is attained and returns an
/// upper bound at most `tolerance` above the new floor; `at` is where floor is attained. If the maximum does
/// not exceed floor, both stay and floor comes back.
double RaiseMaximum(const Bernstein& polynomial, double tolerance, double& floor, double& at);

}  // namespace airsim360::internal
