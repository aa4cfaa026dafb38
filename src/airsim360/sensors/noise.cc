#include "airsim360/sensors/noise.h"

#include <cmath>

namespace airsim360 {
namespace {

// Largest Allan deviation of a Gauss-Markov process of sigma 1: at averaging times of 1.89 correlation times.
constexpr double kGaussMarkovPeak = 0.6173643;

Vec3d NormalVector(RngStream& random) {
  const double x = random.Normal(), y = random.Normal(), z = random.Normal();
  return {x, y, z};
}

}  // namespace

void NoiseSpec::Visit(ConfigVisitor& v) {
  constexpr double kMost = 1e6;
  v.Field("white", "noise density, unit/sqrt(Hz)", white, 0, kMost);
  v.Field("bias_instability", "unit; the Allan deviation is flat at 0.664 of it", bias_instability, 0, kMost);
  v.Field("bias_time", "seconds, correlation time of the drifting bias", bias_time, 1e-3, 1e9);
  v.Field("random_walk", "unit/s/sqrt(Hz)", random_walk, 0, kMost);
  v.Field("turn_on", "unit, sigma of the bias that stays", turn_on, 0, kMost);
}

double DriftSigma(const NoiseSpec& spec) { return spec.bias_instability * kFlickerFloor / kGaussMarkovPeak; }

RngStream SampleStream(const SensorKey& key, std::string_view channel, uint64_t index) {
  return {key.seed, channel, MixBits((uint64_t{key.vehicle} << 32) | key.sensor) + MixBits(index)};
}

NoiseState StartNoise(const NoiseSpec& spec, RngStream random) {
  NoiseState state;
  state.constant = NormalVector(random) * spec.turn_on;
  state.drift = NormalVector(random) * DriftSigma(spec);
  return state;
}

Vec3d NextNoise(const NoiseSpec& spec, double dt, RngStream random, NoiseState& state) {
  if (spec.silent()) return {};
  const double keep = std::exp(-dt / spec.bias_time);
  state.drift = state.drift * keep + NormalVector(random) * (DriftSigma(spec) * std::sqrt(1 - keep * keep));
  state.walk += NormalVector(random) * (spec.random_walk * std::sqrt(dt));
  return state.constant + state.drift + state.walk + NormalVector(random) * (spec.white / std::sqrt(dt));
}

}  // namespace airsim360
