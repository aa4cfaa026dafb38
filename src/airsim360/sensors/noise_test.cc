#include "airsim360/sensors/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/sensors/allan.h"

namespace airsim360 {
namespace {

std::vector<double> Samples(const NoiseSpec& spec, double dt, size_t count, uint64_t seed) {
  const SensorKey key{.seed = seed};
  NoiseState state = StartNoise(spec, SampleStream(key, "start", 0));
  std::vector<double> samples;
  for (size_t i = 0; i < count; ++i) samples.push_back(NextNoise(spec, dt, SampleStream(key, "noise", i), state).x);
  return samples;
}

// Mean Allan variance of the three axes of a few runs is what we compare; here as deviation.
double MeanAllan(const NoiseSpec& spec, double dt, size_t count, size_t m, int runs) {
  double variance = 0;
  for (int run = 0; run < runs; ++run) {
    const double deviation = AllanDeviation(Samples(spec, dt, count, static_cast<uint64_t>(run)), m);
    variance += deviation * deviation / runs;
  }
  return std::sqrt(variance);
}

TEST(AllanDeviation, OfARampIsItsSlopeTimesTheAveragingTimeOverRootTwo) {
  std::vector<double> ramp;
  for (int i = 0; i < 1000; ++i) ramp.push_back(3.0 * i);
  EXPECT_NEAR(AllanDeviation(ramp, 10), 3.0 * 10 / std::sqrt(2), 1e-9);
  EXPECT_THROW(AllanDeviation(ramp, 500), InputError);
  EXPECT_THROW(AllanDeviation(ramp, 0), InputError);
}

TEST(NextNoise, AllanDeviationRecoversTheWhiteNoiseDensity) {
  const NoiseSpec spec{.white = 2e-3};
  for (const size_t m : {size_t{1}, size_t{20}, size_t{200}}) {
    const double tau = 0.005 * static_cast<double>(m);
    // A few hundred independent averages at least: 4 standard errors of a variance estimate.
    EXPECT_NEAR(MeanAllan(spec, 0.005, 100'000, m, 1) * std::sqrt(tau), 2e-3, 2e-3 * 0.1) << m;
  }
}

TEST(NextNoise, AllanDeviationRecoversTheBiasInstabilityAtItsFlatPlace) {
  const NoiseSpec spec{.bias_instability = 5e-4, .bias_time = 10};
  // The top is at 1.89 correlation times; slow samples do, for the drift is discretised exactly.
  const double floor = MeanAllan(spec, 0.5, 40'000, 38, 4);
  EXPECT_NEAR(floor / kFlickerFloor, 5e-4, 5e-4 * 0.1);
  EXPECT_NEAR(ExpectedAllanDeviation(spec, 19), floor, 0.1 * floor);
  EXPECT_NEAR(ExpectedAllanDeviation(spec, 18.926) / kFlickerFloor, 5e-4, 1e-8);
}

TEST(NextNoise, AllanDeviationRecoversTheRandomWalk) {
  const NoiseSpec spec{.random_walk = 1e-3};
  for (const size_t m : {size_t{10}, size_t{100}}) {
    const double tau = 0.1 * static_cast<double>(m);
    EXPECT_NEAR(MeanAllan(spec, 0.1, 50'000, m, 4) * std::sqrt(3 / tau), 1e-3, 1e-3 * 0.12) << m;
  }
}

TEST(NextNoise, DriftHasTheSameVarianceAtAnyRate) {
  const NoiseSpec spec{.bias_instability = 1, .bias_time = 2};
  for (const double dt : {0.01, 1.0, 20.0}) {
    double squares = 0;
    const std::vector<double> samples = Samples(spec, dt, 200'000, 7);
    for (double x : samples) squares += x * x;
    const double independent = std::min(2e5, 2e5 * dt / (2 * 2.0));
    const double variance = DriftSigma(spec) * DriftSigma(spec);
    EXPECT_NEAR(squares / 2e5, variance, 4 * variance * std::sqrt(2 / independent)) << dt;
  }
}

TEST(NextNoise, SamplesDependOnTheirKeyAloneSoThatARestoredStateContinuesTheSame) {
  const NoiseSpec spec{.white = 1, .bias_instability = 1, .random_walk = 1, .turn_on = 1};
  const SensorKey key{.seed = 5, .vehicle = 1, .sensor = 2};
  NoiseState state = StartNoise(spec, SampleStream(key, "start", 0));
  for (uint64_t i = 0; i < 10; ++i) NextNoise(spec, 0.1, SampleStream(key, "noise", i), state);
  const NoiseState snapshot = state;
  const Vec3d next = NextNoise(spec, 0.1, SampleStream(key, "noise", 10), state);
  state = snapshot;
  EXPECT_EQ(NextNoise(spec, 0.1, SampleStream(key, "noise", 10), state), next);
  // Another vehicle, sensor, channel, sample or seed: other numbers.
  for (const SensorKey& other : {SensorKey{5, 2, 2}, SensorKey{5, 1, 3}, SensorKey{6, 1, 2}}) {
    state = snapshot;
    EXPECT_NE(NextNoise(spec, 0.1, SampleStream(other, "noise", 10), state), next);
  }
  state = snapshot;
  EXPECT_NE(NextNoise(spec, 0.1, SampleStream(key, "noise", 11), state), next);
  state = snapshot;
  EXPECT_NE(NextNoise(spec, 0.1, SampleStream(key, "other", 10), state), next);
}

}  // namespace
}  // namespace airsim360
