#include <cmath>
#include <limits>
#include <numbers>

#include "airsim360/eval/check_images.h"
#include "airsim360/eval/image_metrics.h"

namespace airsim360 {
namespace {

/// 10 log10(255^2 / mean squared error), rows weighted by weight(y).
template <class Weight>
double WeightedPsnr(const Image<Rgb8>& a, const Image<Rgb8>& b, const Weight& weight) {
  internal::CheckComparable(a, b);
  const auto squared = [](int x, int y) { return static_cast<double>((x - y) * (x - y)); };
  double sum = 0, total = 0;
  for (int y = 0; y < a.height(); ++y) {
    double row = 0;
    for (int x = 0; x < a.width(); ++x) {
      const Rgb8 p = a(x, y), q = b(x, y);
      row += squared(p.r, q.r) + squared(p.g, q.g) + squared(p.b, q.b);
    }
    sum += weight(y) * row;
    total += weight(y) * 3 * a.width();
  }
  return sum == 0 ? std::numeric_limits<double>::infinity() : 10 * std::log10(255.0 * 255.0 * total / sum);
}

}  // namespace

double Psnr(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  return WeightedPsnr(a, b, [](int) { return 1.0; });
}

double WsPsnr(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  const double rows = a.height();
  return WeightedPsnr(a, b, [rows](int y) { return std::cos((y + 0.5 - rows / 2) * std::numbers::pi / rows); });
}

}  // namespace airsim360
