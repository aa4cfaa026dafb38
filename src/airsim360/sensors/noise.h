// Noise as datasheets give it: white noise density, bias instability, random walk, turn-on bias.
#pragma once

#include <cstdint>

#include "airsim360/base/config.h"
#include "airsim360/base/random.h"
#include "airsim360/math/vector.h"

namespace airsim360 {

/// Of each axis of a sensor; "unit" is the sensor's own (rad/s, m/s^2, Pa, T). Axes are independent.
struct NoiseSpec {
  double white = 0;             ///< density, unit/sqrt(Hz): a sample of length dt has sigma white / sqrt(dt)
  double bias_instability = 0;  ///< B, unit: the Allan deviation has a flat place at 0.664 B (IEEE Std 952)
  double bias_time = 100;       ///< seconds, correlation time of the drifting bias
  double random_walk = 0;       ///< unit/s/sqrt(Hz) of the walking bias
  double turn_on = 0;           ///< unit, sigma of the bias that stays the same over a run

  bool silent() const { return white == 0 && bias_instability == 0 && random_walk == 0 && turn_on == 0; }
  void Visit(ConfigVisitor& v);
};

/// sqrt(2 ln 2 / pi): height of the flat place over the bias instability.
inline constexpr double kFlickerFloor = 0.6642825;

/// Standard deviation of the drifting bias, a first-order Gauss-Markov process, such that the top of its
/// Allan deviation is kFlickerFloor * bias_instability.
double DriftSigma(const NoiseSpec& spec);

/// The biases now; plain data. Their sum is the bias of a sample.
struct NoiseState {
  Vec3d constant, drift, walk;
};

/// Names one sensor of one vehicle in one run: what its random numbers depend on, besides the number of the
/// sample.
struct SensorKey {
  uint64_t seed = 0;
  uint32_t vehicle = 0, sensor = 0;
};

/// The stream of sample `index` of a sensor; `channel` tells quantities of one sensor apart ("gyro").
RngStream SampleStream(const SensorKey& key, std::string_view channel, uint64_t index);

/// Biases at switching on: the constant one drawn, the drift from its steady state.
NoiseState StartNoise(const NoiseSpec& spec, RngStream random);

/// Advances the biases by dt seconds (exactly discretised, so that they do not depend on the rate) and
/// returns bias + white noise of a sample that averages over dt.
Vec3d NextNoise(const NoiseSpec& spec, double dt, RngStream random, NoiseState& state);

}  // namespace airsim360
