#include "airsim360/projection/fisheye_radius.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace airsim360::internal {
namespace {

double Slope(const Fisheye& c, double theta) {
  const double t = theta * theta;
  return 1 + t * (3 * c.k[0] + t * (5 * c.k[1] + t * (7 * c.k[2] + t * 9 * c.k[3])));
}

using Bernstein = std::array<double, 5>;  // a polynomial of degree 4 on an interval, as Bezier ordinates

// Whether the polynomial is positive on its interval. It lies between the least and the largest ordinate;
// halving the interval (de Casteljau) brings the ordinates to the curve.
bool Positive(const Bernstein& b, int depth) {
  if (!(b.front() > 0 && b.back() > 0)) return false;
  if (*std::min_element(b.begin(), b.end()) > 0) return true;
  if (depth == 0) return false;  // touches zero as far as doubles can tell
  Bernstein left, right = b;
  for (int level = 0; level < 5; ++level) {
    left[level] = right[0];
    for (int i = 0; i + 1 < 5 - level; ++i) right[i] = (right[i] + right[i + 1]) / 2;
  }
  // After the last level right[0] is the middle; de Casteljau leaves the right half in the array.
  return Positive(left, depth - 1) && Positive(right, depth - 1);
}

}  // namespace

double RadiusOfTheta(const Fisheye& c, double theta) {
  const double t = theta * theta;
  return theta * (1 + t * (c.k[0] + t * (c.k[1] + t * (c.k[2] + t * c.k[3]))));
}

bool RadiusGrows(const Fisheye& c) {
  // dr / dtheta is a polynomial p of degree 4 in t = theta^2; on [0, T] its Bezier ordinates are
  // b_i = sum_j C(i, j) / C(4, j) p_j T^j.
  const double T = c.max_theta * c.max_theta;
  const std::array<double, 5> p = {1, 3 * c.k[0] * T, 5 * c.k[1] * T * T, 7 * c.k[2] * T * T * T, 9 * c.k[3] * T * T * T * T};
  constexpr double kChoose[5][5] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}, {1, 4, 6, 4, 1}};
  Bernstein b{};
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j <= i; ++j) b[i] += kChoose[i][j] / kChoose[4][j] * p[j];
  }
  const bool finite = std::all_of(b.begin(), b.end(), [](double v) { return std::isfinite(v); });
  return finite && Positive(b, 40);
}

std::optional<double> ThetaOfRadius(const Fisheye& c, double r) {
  const double last = RadiusOfTheta(c, c.max_theta);
  if (!(r <= last * (1 + 1e-15))) return std::nullopt;
  if (r >= last) return c.max_theta;
  // Newton, kept inside a bracket that halves whenever a step would leave it.
  double low = 0, high = c.max_theta, theta = std::min(r, c.max_theta);
  for (int step = 0; step < 100; ++step) {
    const double error = RadiusOfTheta(c, theta) - r;
    if (error == 0) break;
    (error > 0 ? high : low) = theta;
    double next = theta - error / Slope(c, theta);
    if (!(next > low && next < high)) next = (low + high) / 2;
    const double change = std::abs(next - theta);
    theta = next;
    if (change <= std::numeric_limits<double>::epsilon() * theta) break;
  }
  return theta;
}

}  // namespace airsim360::internal
