#include "airsim360/dataset/dedupe/panorama_hash.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "airsim360/projection/camera.h"

namespace airsim360::internal {
namespace {

constexpr int kSmallWidth = 256, kSmallHeight = 128;  // of the picture that is sampled
constexpr int kBands = 4, kColumns = 64, kRows = 16;  // cells of a band
constexpr int kAzimuths = 16, kElevations = 4;        // frequencies
constexpr double kLatitude = std::numbers::pi / 3;    // beyond it a panorama has many pixels for little

// Luminance, averaged over boxes of pixels (Rec. 709 weights of the coded values).
Image<float> Small(const Image<Rgb8>& picture) {
  Image<float> sum(kSmallWidth, kSmallHeight);
  Image<float> count(kSmallWidth, kSmallHeight);
  for (int y = 0; y < picture.height(); ++y) {
    const int row = y * kSmallHeight / picture.height();
    for (int x = 0; x < picture.width(); ++x) {
      const Rgb8 c = picture(x, y);
      const int column = x * kSmallWidth / picture.width();
      sum(column, row) += 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
      count(column, row) += 1;
    }
  }
  // Smaller pictures leave gaps: each cell takes the nearest pixel's.
  for (int y = 0; y < kSmallHeight; ++y) {
    for (int x = 0; x < kSmallWidth; ++x) {
      if (count(x, y) > 0) {
        sum(x, y) /= count(x, y);
        continue;
      }
      const Rgb8 c = picture(x * picture.width() / kSmallWidth, y * picture.height() / kSmallHeight);
      sum(x, y) = 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
    }
  }
  return sum;
}

float Sample(const Image<float>& image, Vec2d at) {
  const double fx = std::floor(at.x - 0.5), fy = std::floor(at.y - 0.5);
  const auto u = static_cast<float>(at.x - 0.5 - fx), v = static_cast<float>(at.y - 0.5 - fy);
  const int x = static_cast<int>(fx), y = static_cast<int>(fy), w = image.width(), h = image.height();
  const auto read = [&](int i, int j) { return image((i % w + w) % w, std::clamp(j, 0, h - 1)); };
  return (1 - v) * ((1 - u) * read(x, y) + u * read(x + 1, y)) + v * ((1 - u) * read(x, y + 1) + u * read(x + 1, y + 1));
}

// Mean luminance of the cells of all bands: kBands * kRows rows from the top, kColumns columns from east counter-clockwise.
std::vector<float> Cells(const Image<float>& small, const Mat3d& R_WC) {
  constexpr int kInside = 4;  // samples along azimuth in a cell
  const Equirectangular camera{kSmallWidth, kSmallHeight};
  const Mat3d R_CW = R_WC.transpose();
  std::vector<float> cells(static_cast<size_t>(kBands) * kRows * kColumns);
  for (int row = 0; row < kBands * kRows; ++row) {
    const double latitude = kLatitude * (1 - 2 * (row + 0.5) / (kBands * kRows));
    for (int i = 0; i < kColumns * kInside; ++i) {
      const double azimuth = 2 * std::numbers::pi * (i + 0.5) / (kColumns * kInside);
      const Vec3d d_W{std::cos(latitude) * std::cos(azimuth), std::cos(latitude) * std::sin(azimuth), std::sin(latitude)};
      cells[static_cast<size_t>(row) * kColumns + static_cast<size_t>(i / kInside)] +=
          Sample(small, *RayToPixel(camera, R_CW * d_W)) / kInside;
    }
  }
  return cells;
}

// cos(pi (2 i + 1) k / (2 n)): the table of a cosine transform of n values at k frequencies.
std::vector<float> Cosines(int n, int frequencies, int first) {
  std::vector<float> table;
  for (int k = first; k < first + frequencies; ++k) {
    for (int i = 0; i < n; ++i) table.push_back(static_cast<float>(std::cos(std::numbers::pi * (2 * i + 1) * k / (2.0 * n))));
  }
  return table;
}

uint64_t BandBits(const float* cells) {
  static const std::vector<float> kAlong = Cosines(kColumns, kAzimuths, 1), kUp = Cosines(kRows, kElevations, 0);
  std::array<float, kAzimuths * kElevations> values{};
  for (int k = 0; k < kAzimuths; ++k) {
    std::array<float, kRows> line{};
    for (int r = 0; r < kRows; ++r) {
      for (int c = 0; c < kColumns; ++c)
        line[static_cast<size_t>(r)] += cells[r * kColumns + c] * kAlong[static_cast<size_t>(k * kColumns + c)];
    }
    for (int e = 0; e < kElevations; ++e) {
      for (int r = 0; r < kRows; ++r)
        values[static_cast<size_t>(k * kElevations + e)] += line[static_cast<size_t>(r)] * kUp[static_cast<size_t>(e * kRows + r)];
    }
  }
  auto sorted = values;
  std::ranges::nth_element(sorted, sorted.begin() + sorted.size() / 2);
  const float median = sorted[sorted.size() / 2];
  uint64_t bits = 0;
  for (size_t i = 0; i < values.size(); ++i) bits |= static_cast<uint64_t>(values[i] > median) << i;
  return bits;
}

}  // namespace

PanoramaHash HashPanorama(const Image<Rgb8>& panorama, const Mat3d& R_WC) {
  const std::vector<float> cells = Cells(Small(panorama), R_WC);
  PanoramaHash hash{};
  for (size_t band = 0; band < kBands; ++band) hash[band] = BandBits(cells.data() + band * kRows * kColumns);
  return hash;
}

int Distance(const PanoramaHash& a, const PanoramaHash& b) {
  int bits = 0;
  for (size_t i = 0; i < a.size(); ++i) bits += std::popcount(a[i] ^ b[i]);
  return bits;
}

}  // namespace airsim360::internal
