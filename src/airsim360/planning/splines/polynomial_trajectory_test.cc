#include "airsim360/planning/splines/polynomial_trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

/// x = t^3 on [0, 1], then 1 + 3 s + 3 s^2 + s^3 on [0, 1]: the same cubic in two pieces.
PolynomialTrajectory Cubic() {
  std::vector<double> c(2 * 3 * 6);
  c[3] = 1;
  c[18] = 1;
  c[19] = 3;
  c[20] = 3;
  c[21] = 1;
  return PolynomialTrajectory(5, {1, 1}, c);
}

TEST(PolynomialTrajectory, EvaluatesValueAndDerivativesAcrossPieces) {
  const PolynomialTrajectory cubic = Cubic();
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    const TrajectoryPoint p = cubic.At(t);
    EXPECT_NEAR(p.p.x, t * t * t, 1e-14);
    EXPECT_NEAR(p.v.x, 3 * t * t, 1e-14);
    EXPECT_NEAR(p.a.x, 6 * t, 1e-14);
    EXPECT_NEAR(p.jerk.x, 6, 1e-14);
    EXPECT_EQ(p.snap.x, 0);
  }
  EXPECT_EQ(cubic.At(-1).p.x, 0);
  EXPECT_EQ(cubic.At(9).p.x, 8);
}

TEST(PolynomialTrajectory, IntegralsOfSquaredDerivativesAreExact) {
  // Integral of (3 t^2)^2, (6 t)^2 and 6^2 over [0, 2].
  EXPECT_NEAR(IntegralOfSquaredDerivative(Cubic(), 1), 9 * 32.0 / 5, 1e-12);
  EXPECT_NEAR(IntegralOfSquaredDerivative(Cubic(), 2), 36 * 8.0 / 3, 1e-12);
  EXPECT_NEAR(IntegralOfSquaredDerivative(Cubic(), 3), 72, 1e-12);
  EXPECT_EQ(IntegralOfSquaredDerivative(Cubic(), 4), 0);
}

TEST(PolynomialTrajectory, SlowedPathsKeepTheirShape) {
  const PolynomialTrajectory slow = Slowed(Cubic(), 2.5);
  EXPECT_NEAR(slow.duration(), 5, 1e-15);
  EXPECT_NEAR(slow.At(2.5 * 1.3).p.x, Cubic().At(1.3).p.x, 1e-14);
  EXPECT_NEAR(slow.At(2.5 * 1.3).v.x, Cubic().At(1.3).v.x / 2.5, 1e-14);
}

TEST(PolynomialTrajectory, SampleTimesReachTheEndOnce) {
  EXPECT_EQ(SampleTimes(1, 0.5), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(SampleTimes(1.2, 0.5), (std::vector<double>{0, 0.5, 1, 1.2}));
  EXPECT_EQ(SampleTimes(0, 0.5), (std::vector<double>{0}));
  EXPECT_EQ(SampleTimes(0.3, 0.1).size(), 4u);
  // Multiples of short decimals are short: 0.3, not 0.1 * 3.
  EXPECT_EQ(SampleTimes(1, 0.1), (std::vector<double>{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1}));
  for (const auto& [interval, places] : {std::pair{0.1, 1.0}, {0.025, 3.0}, {0.07, 2.0}, {3.0, 0.0}, {0.001, 3.0}, {1e-5, 5.0}}) {
    for (const double t : SampleTimes(1000 * interval, interval)) {
      const double power = std::pow(10.0, places);
      EXPECT_EQ(t, std::round(t * power) / power) << interval;
    }
  }
  for (const double interval : {1.0 / 3, 2.5e300, 4e-300}) {
    const std::vector<double> times = SampleTimes(9.5 * interval, interval);
    ASSERT_EQ(times.size(), 11u);
    for (size_t i = 0; i < 10; ++i) EXPECT_DOUBLE_EQ(times[i], static_cast<double>(i) * interval);
  }
  EXPECT_THROW(SampleTimes(1, 0), InputError);
  EXPECT_THROW(SampleTimes(NAN, 1), InputError);
}

TEST(PolynomialTrajectory, BadNumbersAreRefused) {
  const std::vector<double> c(18);
  EXPECT_THROW(PolynomialTrajectory(6, {1}, c), InputError);
  EXPECT_THROW(PolynomialTrajectory(5, {1, 1}, c), InputError);
  EXPECT_THROW(PolynomialTrajectory(5, {0}, c), InputError);
  EXPECT_THROW(PolynomialTrajectory(5, {NAN}, c), InputError);
  std::vector<double> bad = c;
  bad[4] = INFINITY;
  EXPECT_THROW(PolynomialTrajectory(5, {1}, bad), InputError);
}

}  // namespace
}  // namespace airsim360
