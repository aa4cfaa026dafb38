#include "airsim360/image/draw.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/base/random.h"
#include "airsim360/image/color.h"

namespace airsim360 {
namespace {

// Oklab lightness, chroma and hue to sRGB (B. Ottosson, "A perceptual color space for image processing",
// 2020); colours outside sRGB are clipped per channel.
Rgb8 FromOklch(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {LinearToSrgb8(static_cast<float>(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s)),
          LinearToSrgb8(static_cast<float>(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s)),
          LinearToSrgb8(static_cast<float>(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s))};
}

double Radians(double degrees) { return degrees * std::numbers::pi / 180; }

// What one target pixel takes from a row or column of the source: pixels [first, first + weight.size()).
struct Coverage {
  int first = 0;
  std::vector<float> weight;
};

std::vector<Coverage> CoverageOf(int source, int target) {
  std::vector<Coverage> coverages(static_cast<size_t>(target));
  for (int i = 0; i < target; ++i) {
    const double begin = static_cast<double>(i) * source / target, end = static_cast<double>(i + 1) * source / target;
    Coverage& coverage = coverages[static_cast<size_t>(i)];
    coverage.first = std::min(static_cast<int>(begin), source - 1);
    const int last = std::min(static_cast<int>(std::ceil(end)), source);
    for (int k = coverage.first; k < last; ++k) {
      const double part = std::min<double>(end, k + 1) - std::max<double>(begin, k);
      coverage.weight.push_back(static_cast<float>(part / (end - begin)));
    }
  }
  return coverages;
}

}  // namespace

void Blit(const Image<Rgb8>& picture, int x, int y, Image<Rgb8>& canvas) {
  const int left = std::max(0, -x), right = std::min(picture.width(), canvas.width() - x);
  const int top = std::max(0, -y), bottom = std::min(picture.height(), canvas.height() - y);
  if (left >= right) return;
  for (int row = top; row < bottom; ++row) {
    std::copy_n(&picture(left, row), right - left, &canvas(x + left, y + row));
  }
}

void FillRectangle(int x, int y, int width, int height, Rgb8 color, Image<Rgb8>& canvas) {
  const int left = std::max(0, x), right = std::min(x + width, canvas.width());
  for (int row = std::max(0, y); row < std::min(y + height, canvas.height()); ++row) {
    for (int column = left; column < right; ++column) canvas(column, row) = color;
  }
}

Image<Rgb8> ResizeBox(const Image<Rgb8>& picture, int width, int height) {
  if (picture.empty() || width <= 0 || height <= 0) throw InputError("ResizeBox: pictures need at least one pixel");
  const auto columns = CoverageOf(picture.width(), width), rows = CoverageOf(picture.height(), height);
  Image<Rgb8> result(width, height);
  std::vector<Rgb32f> line(static_cast<size_t>(picture.width()));
  for (int y = 0; y < height; ++y) {
    // First the mean over rows of every source column, then over columns.
    std::fill(line.begin(), line.end(), Rgb32f{});
    const Coverage& row = rows[static_cast<size_t>(y)];
    for (size_t k = 0; k < row.weight.size(); ++k) {
      const auto source = picture.row(row.first + static_cast<int>(k));
      const float w = row.weight[k];
      for (size_t x = 0; x < line.size(); ++x) {
        line[x].r += w * SrgbToLinear(source[x].r);
        line[x].g += w * SrgbToLinear(source[x].g);
        line[x].b += w * SrgbToLinear(source[x].b);
      }
    }
    for (int x = 0; x < width; ++x) {
      const Coverage& column = columns[static_cast<size_t>(x)];
      Rgb32f sum;
      for (size_t k = 0; k < column.weight.size(); ++k) {
        const Rgb32f p = line[static_cast<size_t>(column.first) + k];
        sum = {sum.r + column.weight[k] * p.r, sum.g + column.weight[k] * p.g, sum.b + column.weight[k] * p.b};
      }
      result(x, y) = {LinearToSrgb8(sum.r), LinearToSrgb8(sum.g), LinearToSrgb8(sum.b)};
    }
  }
  return result;
}

Rgb8 ScaleColor(double t) {
  // Hue turns from blue (282 degrees) to yellow (102), chroma swells in the middle where sRGB has room for
  // it.
  static const std::array<Rgb8, 256> table = [] {
    std::array<Rgb8, 256> colors;
    for (int i = 0; i < 256; ++i) {
      const double u = i / 255.0;
      const double chroma = 0.075 + 0.065 * std::sin(std::numbers::pi * std::sqrt(u));
      colors[static_cast<size_t>(i)] = FromOklch(0.22 + 0.72 * u, chroma, Radians(282 - 180 * u));
    }
    return colors;
  }();
  const double clamped = t > 0 ? std::min(t, 1.0) : 0;
  return table[static_cast<size_t>(std::lround(clamped * 255))];
}

double LogScale(double value, double low, double high) {
  if (!(low > 0 && low < high)) throw InputError("LogScale: limits must be 0 < low < high");
  if (!(value > low)) return 0;
  return std::min(1.0, std::log(value / low) / std::log(high / low));
}

Rgb8 OklchColor(double lightness, double chroma, double hue_deg) { return FromOklch(lightness, chroma, Radians(hue_deg)); }

Rgb8 IdColor(uint32_t id) {
  if (id == 0) return {0, 0, 0};
  // Steps of the golden angle keep neighbouring ids apart in hue; lightness and chroma come from the hash.
  const uint64_t bits = MixBits(id);
  const double lightness = 0.45 + 0.42 * static_cast<double>(bits & 0xffff) / 65535;
  const double chroma = 0.07 + 0.10 * static_cast<double>(bits >> 16 & 0xffff) / 65535;
  return FromOklch(lightness, chroma, Radians(std::fmod(id * 137.50776405003785, 360)));
}

}  // namespace airsim360
