// Statistics of tests of sampling and of images: only included by tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "airsim360/image/image.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/vector.h"

namespace airsim360::test {

/// Upper tail of the normal distribution, both sides: chance of |z| or more.
inline double TwoSidedTail(double z) { return std::erfc(std::fabs(z) / std::sqrt(2.0)); }

/// Chance of a chi-square statistic this large or larger (Wilson & Hilferty 1931; good to 1e-3 from five
/// degrees on).
inline double ChiSquareTail(double statistic, int degrees) {
  const double k = degrees, c = 2 / (9 * k);
  return 0.5 * std::erfc((std::cbrt(statistic / k) - (1 - c)) / std::sqrt(2 * c));
}

/// Significance of each of `tests` so that all of them together have `alpha` (Sidak 1967).
inline double Sidak(double alpha, int64_t tests) { return -std::expm1(std::log1p(-alpha) / static_cast<double>(tests)); }

/// Chance that samples drawn with `sample` have density `pdf` per solid angle. Cells of azimuth by cosine
/// about +z; `sample` returns false for a sample that is thrown away, which `pdf` leaves out. Cells with
/// fewer than five expected samples are pooled. Densities are integrated by midpoints, `fine` by `fine` in a
/// cell; `region` keeps narrow ones in few cells: only cosines of [low, high] have cells, the rest is one.
struct SphereGrid {
  int across = 24, up = 24, fine = 16;
  double low = -1, high = 1;
};
inline double ChiSquareOfDirections(const std::function<bool(Vec3f&)>& sample, const std::function<double(Vec3f)>& pdf, int64_t count,
                                    const SphereGrid& grid = {}) {
  const int cells = grid.across * grid.up;
  std::vector<double> seen(cells + 1), expected(cells + 1);
  for (int64_t i = 0; i < count; ++i) {
    Vec3f d;
    if (!sample(d)) {
      ++seen[cells];
      continue;
    }
    const double turn = std::atan2(d.y, d.x) / kTau;
    const int x = std::min(grid.across - 1, static_cast<int>((turn < 0 ? turn + 1 : turn) * grid.across));
    const int y = static_cast<int>(std::floor((d.z - grid.low) / (grid.high - grid.low) * grid.up));
    ++seen[y < 0 || y > grid.up || d.z > grid.high ? cells : std::min(y, grid.up - 1) * grid.across + x];
  }
  const double area = kTau * (grid.high - grid.low) / cells / (grid.fine * grid.fine);
  double total = 0;
  for (int c = 0; c < cells; ++c) {
    for (int k = 0; k < grid.fine * grid.fine; ++k) {
      const double a = (c % grid.across + (k % grid.fine + 0.5) / grid.fine) * kTau / grid.across;
      const double z =
          grid.low + (static_cast<double>(c / grid.across) + (k / grid.fine + 0.5) / grid.fine) * (grid.high - grid.low) / grid.up;
      const double s = std::sqrt(std::max(0.0, 1 - z * z));
      expected[c] += pdf({static_cast<float>(s * std::cos(a)), static_cast<float>(s * std::sin(a)), static_cast<float>(z)}) * area *
                     static_cast<double>(count);
    }
    total += expected[c];
  }
  expected[cells] = static_cast<double>(count) - total;  // thrown away, or in no cell
  double statistic = 0, pooled_seen = 0, pooled_expected = 0;
  int degrees = -1;
  for (int c = 0; c <= cells; ++c) {
    if (expected[c] < 5) {
      pooled_seen += seen[c], pooled_expected += expected[c];
      continue;
    }
    statistic += (seen[c] - expected[c]) * (seen[c] - expected[c]) / expected[c];
    ++degrees;
  }
  if (pooled_expected > 1 || pooled_seen > 5) {
    const double e = std::max(pooled_expected, 1.0);
    statistic += (pooled_seen - e) * (pooled_seen - e) / e;
    ++degrees;
  }
  return ChiSquareTail(statistic, std::max(degrees, 1));
}

/// Share of pixel channels whose difference is explained by their variances: two-sided Z-test of every
/// channel, all of them together at significance `alpha`. Variances are of the means and are at least
/// `floor`.
inline double ShareWithinNoise(const Image<Rgb32f>& a, const Image<Rgb32f>& variance_a, const Image<Rgb32f>& b,
                               const Image<Rgb32f>& variance_b, double alpha = 0.01, double floor = 1e-8) {
  const int64_t tests = static_cast<int64_t>(a.pixels().size()) * 3;
  const double significance = Sidak(alpha, tests);
  int64_t passed = 0;
  for (size_t i = 0; i < a.pixels().size(); ++i) {
    const auto test = [&](float x, float vx, float y, float vy) {
      const double spread = std::sqrt(std::max<double>(static_cast<double>(vx) + vy, floor));
      passed += TwoSidedTail((static_cast<double>(x) - y) / spread) >= significance;
    };
    const Rgb32f &p = a.pixels()[i], &q = b.pixels()[i], &v = variance_a.pixels()[i], &w = variance_b.pixels()[i];
    test(p.r, v.r, q.r, w.r);
    test(p.g, v.g, q.g, w.g);
    test(p.b, v.b, q.b, w.b);
  }
  return static_cast<double>(passed) / static_cast<double>(tests);
}
inline constexpr double kShareThatMustPass = 0.9975;

}  // namespace airsim360::test
