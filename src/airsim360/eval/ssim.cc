#include <array>
#include <cmath>
#include <utility>

#include "airsim360/eval/check_images.h"
#include "airsim360/eval/image_metrics.h"

namespace airsim360 {
namespace {

constexpr int kWindow = 11;
constexpr double kSigma = 1.5;

std::array<double, kWindow> Gaussian() {
  std::array<double, kWindow> g;
  double sum = 0;
  for (int i = 0; i < kWindow; ++i) {
    const double d = i - kWindow / 2;
    sum += g[static_cast<size_t>(i)] = std::exp(-d * d / (2 * kSigma * kSigma));
  }
  for (double& w : g) w /= sum;
  return g;
}

/// Windowed means wherever the whole window fits.
Image<double> Blur(const Image<double>& image) {
  const auto g = Gaussian();
  Image<double> rows(image.width() - kWindow + 1, image.height());
  for (int y = 0; y < rows.height(); ++y) {
    for (int x = 0; x < rows.width(); ++x) {
      for (int i = 0; i < kWindow; ++i) rows(x, y) += g[static_cast<size_t>(i)] * image(x + i, y);
    }
  }
  Image<double> result(rows.width(), image.height() - kWindow + 1);
  for (int y = 0; y < result.height(); ++y) {
    for (int i = 0; i < kWindow; ++i) {
      for (int x = 0; x < result.width(); ++x) result(x, y) += g[static_cast<size_t>(i)] * rows(x, y + i);
    }
  }
  return result;
}

Image<double> Luma(const Image<Rgb8>& image) {
  Image<double> luma(image.width(), image.height());
  for (size_t i = 0; i < luma.size(); ++i) {
    const Rgb8 c = image.pixels()[i];
    luma.pixels()[i] = 0.299 * c.r + 0.587 * c.g + 0.114 * c.b;
  }
  return luma;
}

Image<double> Product(const Image<double>& a, const Image<double>& b) {
  Image<double> product(a.width(), a.height());
  for (size_t i = 0; i < product.size(); ++i) product.pixels()[i] = a.pixels()[i] * b.pixels()[i];
  return product;
}

}  // namespace

double Ssim(const Image<Rgb8>& first, const Image<Rgb8>& second) {
  internal::CheckComparable(first, second, kWindow);
  const Image<double> a = Luma(first), b = Luma(second);
  const Image<double> mean_a = Blur(a), mean_b = Blur(b);
  const Image<double> square_a = Blur(Product(a, a)), square_b = Blur(Product(b, b)), both = Blur(Product(a, b));
  const double c1 = std::pow(0.01 * 255, 2), c2 = std::pow(0.03 * 255, 2);
  double sum = 0;
  for (size_t i = 0; i < mean_a.size(); ++i) {
    const double ma = mean_a.pixels()[i], mb = mean_b.pixels()[i];
    const double va = square_a.pixels()[i] - ma * ma, vb = square_b.pixels()[i] - mb * mb;
    const double covariance = both.pixels()[i] - ma * mb;
    sum += (2 * ma * mb + c1) * (2 * covariance + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
  }
  return sum / static_cast<double>(mean_a.size());
}

}  // namespace airsim360
