#include "airsim360/eval/panorama_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/image/draw.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

constexpr int kWidth = 512, kHeight = 256, kView = 96;
using View = std::vector<double>;  // kView x kView luminances

// The nearest pixel; columns wrap.
double Sample(const Image<float>& picture, double x, double y) {
  const int w = picture.width(), column = static_cast<int>(std::floor(x)) % w;
  const int row = std::clamp(static_cast<int>(y), 0, picture.height() - 1);
  return static_cast<double>(picture(column < 0 ? column + w : column, row));
}

// A pinhole view of 80 degrees.
View Cut(const Image<float>& picture, double yaw, double pitch) {
  View view(static_cast<size_t>(kView) * kView);
  const double half = std::tan(40 * kPi / 180);
  for (int j = 0; j < kView; ++j) {
    for (int i = 0; i < kView; ++i) {
      const double right = half * (2 * (i + 0.5) / kView - 1), up = -half * (2 * (j + 0.5) / kView - 1);
      const double forward = std::cos(pitch) - up * std::sin(pitch), z = std::sin(pitch) + up * std::cos(pitch);
      const double azimuth = yaw + std::atan2(right, forward), elevation = std::atan2(z, std::hypot(right, forward));
      view[static_cast<size_t>(j) * kView + i] = Sample(picture, (azimuth / (2 * kPi) + 0.5) * kWidth, (0.5 - elevation / kPi) * kHeight);
    }
  }
  return view;
}

// Fourier transform of a line of kView values: small enough to be summed as it is defined.
std::vector<std::complex<double>> Transform(const std::vector<std::complex<double>>& a) {
  static const std::vector<std::complex<double>> roots = [] {
    std::vector<std::complex<double>> r(kView);
    for (int i = 0; i < kView; ++i) r[static_cast<size_t>(i)] = std::polar(1.0, -2 * kPi * i / kView);
    return r;
  }();
  std::vector<std::complex<double>> out(kView);
  for (size_t f = 0; f < kView; ++f)
    for (size_t i = 0; i < kView; ++i) out[f] += a[i] * roots[f * i % kView];
  return out;
}

// Exponent of the power spectrum by least squares over rings of one frequency each, under a Hann window.
double SpectrumSlope(const View& view) {
  double mean = 0;
  for (double v : view) mean += v / static_cast<double>(view.size());
  std::vector<std::vector<std::complex<double>>> rows(kView, std::vector<std::complex<double>>(kView));
  const auto window = [](int i) { return 0.5 - 0.5 * std::cos(2 * kPi * (i + 0.5) / kView); };
  for (int j = 0; j < kView; ++j) {
    for (int i = 0; i < kView; ++i) rows[j][i] = (view[static_cast<size_t>(j) * kView + i] - mean) * window(i) * window(j);
    rows[j] = Transform(rows[j]);
  }
  std::vector<double> power(kView / 2, 0.0), count(kView / 2, 0.0);
  std::vector<std::complex<double>> column(kView);
  for (int i = 0; i < kView; ++i) {
    for (int j = 0; j < kView; ++j) column[j] = rows[j][i];
    const std::vector<std::complex<double>> spectrum = Transform(column);
    for (int j = 0; j < kView; ++j) {
      const int fx = i < kView / 2 ? i : i - kView, fy = j < kView / 2 ? j : j - kView;
      const auto ring = static_cast<size_t>(std::lround(std::hypot(fx, fy)));
      if (ring < power.size()) {
        power[ring] += std::norm(spectrum[j]);
        count[ring] += 1;
      }
    }
  }
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (size_t f = 3; f < kView / 2; ++f) {
    const double x = std::log(static_cast<double>(f)), y = std::log(power[f] / count[f] + 1e-12);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return -(n * sxy - sx * sy) / (n * sxx - sx * sx);
}

double FlatShare(const View& view) {
  constexpr int kBlock = 8, kBlocks = kView / kBlock;
  int flat = 0;
  for (int b = 0; b < kBlocks * kBlocks; ++b) {
    double sum = 0, squares = 0;
    for (int k = 0; k < kBlock * kBlock; ++k) {
      const int x = b % kBlocks * kBlock + k % kBlock, y = b / kBlocks * kBlock + k / kBlock;
      const double v = view[static_cast<size_t>(y) * kView + x];
      sum += v, squares += v * v;
    }
    const double m = sum / (kBlock * kBlock);
    flat += std::sqrt(std::max(0.0, squares / (kBlock * kBlock) - m * m)) < 0.004;
  }
  return static_cast<double>(flat) / (kBlocks * kBlocks);
}

double MeanGradient(const View& view) {
  double sum = 0;
  for (int y = 1; y + 1 < kView; ++y) {
    for (int x = 1; x + 1 < kView; ++x) {
      const size_t p = static_cast<size_t>(y) * kView + x;
      sum += std::hypot(view[p + 1] - view[p - 1], view[p + kView] - view[p - kView]) / 2;
    }
  }
  return sum / ((kView - 2) * (kView - 2));
}

double Entropy(const View& view) {
  std::array<double, 64> bins{};
  for (double v : view) bins[static_cast<size_t>(std::clamp(v * 64, 0.0, 63.0))] += 1;
  double bits = 0;
  for (double count : bins) {
    const double p = count / static_cast<double>(view.size());
    if (p > 0) bits -= p * std::log2(p);
  }
  return bits;
}

}  // namespace

PanoramaStatistics MeasurePanorama(const Image<Rgb8>& panorama) {
  if (panorama.width() != 2 * panorama.height() || panorama.height() < 64)
    throw InputError("a panorama of " + std::to_string(panorama.width()) + " x " + std::to_string(panorama.height()) +
                     " pixels: give one twice as wide as high, 64 rows at least");
  const Image<Rgb8> small = panorama.width() == kWidth ? panorama : ResizeBox(panorama, kWidth, kHeight);
  Image<float> luminance(kWidth, kHeight);
  std::transform(small.pixels().begin(), small.pixels().end(), luminance.pixels().begin(),
                 [](Rgb8 c) { return (0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b) / 255; });
  PanoramaStatistics mean;
  for (double pitch : {0.0, -35 * kPi / 180}) {
    for (int direction = 0; direction < 4; ++direction) {
      const View view = Cut(luminance, direction * kPi / 2, pitch);
      mean.slope += SpectrumSlope(view) / 8;
      mean.flat += FlatShare(view) / 8;
      mean.gradient += MeanGradient(view) / 8;
      mean.entropy += Entropy(view) / 8;
    }
  }
  return mean;
}

}  // namespace airsim360
