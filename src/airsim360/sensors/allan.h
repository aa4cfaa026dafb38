// Allan deviation: how the error of an average falls and rises with the time averaged over.
#pragma once

#include <cstddef>
#include <span>

#include "airsim360/sensors/noise.h"

namespace airsim360 {

/// Overlapping Allan deviation of a rate sampled every dt seconds, for averages over m samples (IEEE Std 952,
/// annex C). Needs more than 2 m samples; InputError otherwise.
double AllanDeviation(std::span<const double> samples, size_t m);

/// What a spec's Allan deviation at averaging time tau is: white N / sqrt(tau), the Gauss-Markov drift and
/// the walk K sqrt(tau / 3), added as variances.
double ExpectedAllanDeviation(const NoiseSpec& spec, double tau);

}  // namespace airsim360
