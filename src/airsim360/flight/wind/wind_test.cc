#include "airsim360/flight/wind/wind.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace airsim360 {
namespace {

const DrydenScales kScales = LowAltitudeDryden(60, 15);

TEST(Dryden, ScalesAreThoseOfTheStandard) {
  // MIL-F-8785C figures at 1000 ft: isotropic, 1000 ft long, a tenth of the wind.
  const DrydenScales high = LowAltitudeDryden(1000 * 0.3048, 20);
  EXPECT_NEAR(high.length.x, 304.8, 1e-9);
  EXPECT_NEAR(high.length.z, 304.8, 1e-9);
  EXPECT_NEAR(high.sigma.x, 2, 1e-12);
  EXPECT_NEAR(high.sigma.z, 2, 1e-12);
  // Near the ground shorter, and stronger along than up.
  const DrydenScales low = LowAltitudeDryden(6.096, 20);
  EXPECT_NEAR(low.length.z, 6.096, 1e-9);
  EXPECT_NEAR(low.length.x, 6.096 / std::pow(0.177 + 0.000823 * 20, 1.2), 1e-9);
  EXPECT_NEAR(low.sigma.x / low.sigma.z, 1 / std::pow(0.177 + 0.000823 * 20, 0.4), 1e-12);
  EXPECT_EQ(LowAltitudeDryden(0, 20).length.z, 10 * 0.3048);
}

// Steady covariance P of the filter and what a step makes of it: P = F P F' + Q for every step.
TEST(Dryden, TheNoiseOfAStepKeepsTheSteadyCovariance) {
  for (double x : {1e-7, 1e-5, 1e-3, 0.1, 0.99, 1.01, 3.0, 40.0}) {
    const double e = std::exp(-x), p11 = 0.5, p12 = 0.25, p22 = 0.25;
    const internal::FilterNoise q = internal::NoiseOver(x);
    EXPECT_NEAR(e * e * p11 + q.q11, p11, 1e-15) << x;
    EXPECT_NEAR(e * e * (x * p11 + p12) + q.q12, p12, 1e-15) << x;
    EXPECT_NEAR(e * e * (x * x * p11 + 2 * x * p12 + p22) + q.q22, p22, 1e-15) << x;
    // For short steps the leading terms of the integrals, free of cancellation.
    if (x < 1e-4) {
      EXPECT_NEAR(q.q12 / (x * x / 2), 1, 3 * x);
      EXPECT_NEAR(q.q22 / (x * x * x / 3), 1, 3 * x);
    }
  }
}

struct Moments {
  Vec3d variance, rate_variance, lagged;
};

/// Over many drones, each after `steps` steps, and the product with the first sample.
Moments Measure(double dt, int steps, double airspeed) {
  constexpr int kDrones = 30000;
  Moments m;
  for (int i = 0; i < kDrones; ++i) {
    RngStream random(5, "test", i);
    DrydenState state;
    const Vec3d first = StepDryden(kScales, airspeed, 0.3, dt, random, state).velocity;
    DrydenSample last;
    for (int k = 0; k < steps; ++k) last = StepDryden(kScales, airspeed, 0.3, dt, random, state);
    m.variance += last.velocity * last.velocity / kDrones;
    m.rate_variance += last.rate * last.rate / kDrones;
    m.lagged += first * last.velocity / kDrones;
  }
  return m;
}

TEST(Dryden, SigmaIsRightWhateverTheStep) {
  for (double dt : {1e-4, 1e-3, 1e-2, 5e-2}) {
    const Moments m = Measure(dt, 5, 12);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::sqrt(m.variance[i]) / kScales.sigma[i], 1, 0.02) << dt << " axis " << i;
  }
}

// The correlations of Dryden's spectra: e^-r along, e^-r (1 - r / 2) across, r the way flown / length. Their
// slopes at 0 are the spectra's at high frequency.
TEST(Dryden, CorrelationIsThatOfTheSpectraWhateverTheStep) {
  const double airspeed = 12;
  for (const auto& [dt, steps] : {std::pair{0.15, 20}, {0.5, 6}, {3.0, 1}}) {
    const Moments m = Measure(dt, steps, airspeed);
    const Vec3d r = Vec3d{1, 1, 1} * (airspeed * 3);
    const Vec3d way{r.x / kScales.length.x, r.y / kScales.length.y, r.z / kScales.length.z};
    EXPECT_NEAR(m.lagged.x / std::pow(kScales.sigma.x, 2), std::exp(-way.x), 0.02) << dt;
    EXPECT_NEAR(m.lagged.y / std::pow(kScales.sigma.y, 2), std::exp(-way.y) * (1 - way.y / 2), 0.02) << dt;
    EXPECT_NEAR(m.lagged.z / std::pow(kScales.sigma.z, 2), std::exp(-way.z) * (1 - way.z / 2), 0.02) << dt;
  }
}

/// Power of the signal at frequency number k of n samples.
double PowerAt(const std::vector<double>& x, int k) {
  std::complex<double> sum;
  for (size_t i = 0; i < x.size(); ++i) {
    sum += x[i] * std::polar(1.0, -2 * std::numbers::pi * k * static_cast<double>(i) / static_cast<double>(x.size()));
  }
  return std::norm(sum);
}

TEST(Dryden, SpectrumFallsWithTheSquareOfTheFrequency) {
  // Corner at V / L below 0.1 rad/s; the window's lines 64 and 256 are far above it and far below the
  // samples'.
  constexpr int kSamples = 4096;
  const double dt = 0.02;
  double power[2][3] = {};
  for (int drone = 0; drone < 60; ++drone) {
    RngStream random(9, "spectrum", drone);
    DrydenState state;
    std::vector<double> signal[3];
    for (int i = 0; i < kSamples; ++i) {
      const DrydenSample s = StepDryden(kScales, 12, 0.3, dt, random, state);
      // A Hann window, so that the ends do not spread power over all lines.
      const double window = 1 - std::cos(2 * std::numbers::pi * i / kSamples);
      for (int a = 0; a < 3; ++a) signal[a].push_back(window * s.velocity[a]);
    }
    for (int a = 0; a < 3; ++a) {
      for (int line = -2; line <= 2; ++line) {
        power[0][a] += PowerAt(signal[a], 64 + line);
        power[1][a] += PowerAt(signal[a], 256 + 4 * line);
      }
    }
  }
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(std::log(power[1][a] / power[0][a]) / std::log(4.0), -2, 0.2) << a;
}

TEST(Dryden, RollRateHasTheStandardsVariance) {
  const double b = 0.3, length = kScales.length.z;
  // Integral over frequency of sigma^2 / (V L) 0.8 (pi L / 4 b)^(1/3) / (1 + (4 b w / pi V)^2).
  const double variance = std::pow(kScales.sigma.z, 2) / length * 0.8 * std::cbrt(std::numbers::pi * length / (4 * b)) * std::numbers::pi *
                          std::numbers::pi / (8 * b);
  EXPECT_NEAR(std::sqrt(Measure(0.01, 5, 12).rate_variance.x / variance), 1, 0.02);
}

TEST(Wind, IsTheSameForTheSameKeyAndOtherForOthers) {
  WindSettings settings;
  settings.mean_W = {3, 4, 0};
  settings.wind_6m = 15;
  const auto end = [&](uint64_t seed, uint64_t id) {
    WindState state = StartWind(seed, id);
    WindSample s;
    for (int i = 0; i < 100; ++i) s = StepWind(settings, i * 1e-3, 1e-3, 30, {}, 0.3, state);
    return s.velocity_W;
  };
  EXPECT_EQ(end(1, 2), end(1, 2));
  EXPECT_FALSE(end(1, 2) == end(1, 3));
  EXPECT_FALSE(end(1, 2) == end(2, 2));
}

TEST(Wind, WithoutTurbulenceIsTheMeanAndItsGusts) {
  WindSettings settings;
  settings.mean_W = {3, 4, 0};
  settings.gusts = {{.start = 1, .rise = 2, .hold = 3, .velocity_W = {0, 8, 0}}};
  WindState state = StartWind(1, 1);
  const auto at = [&](double t) { return StepWind(settings, t, 1e-3, 30, {}, 0.3, state).velocity_W.y; };
  EXPECT_EQ(at(0.5), 4);
  EXPECT_NEAR(at(2), 8, 1e-12);   // half way up
  EXPECT_NEAR(at(4), 12, 1e-12);  // held
  EXPECT_NEAR(at(7), 8, 1e-12);   // half way down
  EXPECT_EQ(at(9), 4);
}

}  // namespace
}  // namespace airsim360
