#include "airsim360/sensors/allan.h"

#include <cmath>
#include <string>
#include <vector>

#include "airsim360/base/error.h"

namespace airsim360 {

double AllanDeviation(std::span<const double> samples, size_t m) {
  if (m == 0 || samples.size() <= 2 * m) {
    throw InputError("Allan deviation of averages over " + std::to_string(m) + " samples needs more than " + std::to_string(2 * m) +
                     ", found " + std::to_string(samples.size()));
  }
  std::vector<double> sums(samples.size() + 1);
  for (size_t i = 0; i < samples.size(); ++i) sums[i + 1] = sums[i] + samples[i];
  double squares = 0;
  const size_t count = samples.size() - 2 * m + 1;
  for (size_t i = 0; i < count; ++i) {
    const double change = sums[i + 2 * m] - 2 * sums[i + m] + sums[i];
    squares += change * change;
  }
  const double length = static_cast<double>(m);
  return std::sqrt(squares / (2 * length * length * static_cast<double>(count)));
}

double ExpectedAllanDeviation(const NoiseSpec& spec, double tau) {
  const double white = spec.white * spec.white / tau;
  const double walk = spec.random_walk * spec.random_walk * tau / 3;
  // Gauss-Markov: 2 sigma^2 T / tau (1 - T / (2 tau) (3 - 4 exp(-tau / T) + exp(-2 tau / T))).
  const double T = spec.bias_time, sigma = DriftSigma(spec), decay = std::exp(-tau / T);
  const double drift = 2 * sigma * sigma * T / tau * (1 - T / (2 * tau) * (3 - 4 * decay + decay * decay));
  return std::sqrt(white + walk + drift);
}

}  // namespace airsim360
