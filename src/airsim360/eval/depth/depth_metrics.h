// Errors of predicted ranges (or depths): pure functions of arrays, metres.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace airsim360 {

/// How errors are taken. The defaults are the definitions of Eigen et al. (NIPS 2014) as UniK3D's evaluation has them.
struct DepthOptions {
  double min_depth = 0;                                        ///< truths above this count
  double max_depth = std::numeric_limits<double>::infinity();  ///< up to this
  bool median_scale = false;                                   ///< predictions are first multiplied by median(truth) / median(prediction)
  bool square_by_square = false;                               ///< sqrel divides by the square of the truth (Deep360's toolkit)
};

/// InputError unless 0 <= min_depth < max_depth.
void CheckDepthOptions(const DepthOptions& options);
/// "no pixel has a truth above … m": what is wrong where no truth counts.
std::string NoDepthText(const DepthOptions& options);

/// Of one picture; NaN without pixels, infinite where a prediction that is not above 0 has no logarithm.
/// Means are over pixels, each times its weight; g truth, p prediction.
struct DepthErrors {
  double absrel = 0;              ///< mean |g - p| / g
  double sqrel = 0;               ///< mean (g - p)² / g
  double rmse = 0;                ///< root of mean (g - p)²
  double rmselog = 0;             ///< root of mean (ln g - ln p)²
  double log10 = 0;               ///< mean |lg g - lg p|
  double mae = 0;                 ///< mean |g - p|
  double d1 = 0, d2 = 0, d3 = 0;  ///< share with max(g / p, p / g) < 1.25, 1.25², 1.25³
  double silog = 0;               ///< 100 times the standard deviation of ln p - ln g, with n - 1 (unbiased)
  double tau = 0;                 ///< share with max(g / p, p / g) < 1.03
  int64_t valid = 0;              ///< pixels: truth finite and within the options' range
  int64_t not_positive = 0;       ///< of them with predictions not above 0
};

/// The names of the eleven figures above, and their values, in one order.
inline constexpr std::array<std::string_view, 11> kDepthFigures = {"absrel", "sqrel", "rmse", "rmselog", "log10", "mae",
                                                                   "d1",     "d2",    "d3",   "silog",   "tau"};
std::array<double, kDepthFigures.size()> Figures(const DepthErrors& errors);

/// `weights` empty = 1 each. InputError for arrays of different length or predictions of valid pixels that are no finite numbers.
DepthErrors MeasureDepth(std::span<const double> prediction, std::span<const double> truth, std::span<const double> weights = {},
                         const DepthOptions& options = {});

}  // namespace airsim360
