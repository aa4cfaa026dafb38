#include "airsim360/render/look/scatter.h"

#include <algorithm>
#include <cmath>

#include "airsim360/base/parallel.h"
#include "airsim360/math/angles.h"
#include "airsim360/render/look/scatter_kernels.h"

namespace airsim360::internal {
namespace {

// Share of the mixture with ln(t / a^2) below s, of which the density is sin(pi g) / (2 pi (cosh(g s) + cos(pi g))).
double MixtureBelow(double s) {
  constexpr double g = kScatterExponent;
  return 0.5 + std::atan(std::tanh(g * s / 2) * std::tan(g * kPi / 2)) / (kPi * g);
}
double MixtureDensity(double s) {
  constexpr double g = kScatterExponent;
  return std::sin(kPi * g) / (2 * kPi * (std::cosh(g * s) + std::cos(kPi * g)));
}

// What the systems of a grid of cells have in common.
struct Grid {
  std::vector<float> area, flux, across, eigen, cosines, sines;
  std::vector<double> area_d, flux_d;
};

int ReversedBits(int i, int length) {
  int reversed = 0;
  for (int bit = 1; bit < length; bit *= 2) reversed = 2 * reversed + ((i & bit) != 0 ? 1 : 0);
  return reversed;
}

Grid MakeGrid(const LightCells& cells, int length) {
  Grid grid;
  const int h = cells.height;
  const double dy = cells.sphere ? kPi / h : cells.row, dx = cells.sphere ? 2 * kPi / length : cells.column;
  for (int y = 0; y < h; ++y) {
    const double top = kPi * (0.5 - static_cast<double>(y) / h), bottom = kPi * (0.5 - (y + 1.0) / h);
    const double middle = std::cos((top + bottom) / 2);
    grid.area_d.push_back(cells.sphere ? (std::sin(top) - std::sin(bottom)) / dy : 1);
    grid.flux_d.push_back(y == 0 ? 0 : (cells.sphere ? std::cos(top) : 1) / (dy * dy));
    grid.across.push_back(static_cast<float>(cells.sphere ? grid.area_d.back() / (middle * middle) : 1));
  }
  grid.flux_d.push_back(0);
  grid.area.assign(grid.area_d.begin(), grid.area_d.end());
  grid.flux.assign(grid.flux_d.begin(), grid.flux_d.end());
  for (int x = 0; x < length; ++x) {
    const double turn = 2 * kPi * ReversedBits(x, length) / length;
    grid.eigen.push_back(static_cast<float>((2 - 2 * std::cos(turn)) / (dx * dx)));
  }
  for (int k = 0; k < length / 2; ++k) {
    grid.cosines.push_back(static_cast<float>(std::cos(2 * kPi * k / length)));
    grid.sines.push_back(static_cast<float>(std::sin(2 * kPi * k / length)));
  }
  return grid;
}

// The system of frequency 0 in one plane, in double precision: it is nearly singular where t is large. Adds the mean.
std::vector<double> SolveMean(const ScatterMixture& mixture, const Grid& grid, const std::vector<double>& light) {
  const size_t h = light.size();
  std::vector<double> sum(h), solved(h), ratio(h);
  double total = 0, whole = 0;
  for (size_t y = 0; y < h; ++y) total += grid.area_d[y] * light[y], whole += grid.area_d[y];
  std::fill(sum.begin(), sum.end(), mixture.mean * total / whole);
  for (const ScatterMixture::Part& part : mixture.parts) {
    for (size_t y = 0; y < h; ++y) {
      const double up = part.t * grid.flux_d[y], down = part.t * grid.flux_d[y + 1];
      const double diagonal = grid.area_d[y] + up + down - (y > 0 ? up * ratio[y - 1] : 0);
      solved[y] = (grid.area_d[y] * light[y] + (y > 0 ? up * solved[y - 1] : 0)) / diagonal;
      ratio[y] = down / diagonal;
    }
    double below = 0;
    for (size_t y = h; y-- > 0;) {
      below = solved[y] + ratio[y] * below;
      sum[y] += part.weight * below;
    }
  }
  return sum;
}

}  // namespace

LightCells::LightCells(bool on_sphere, int columns, int rows, double column_size, double row_size)
    : sphere(on_sphere), width(columns), height(rows), column(column_size), row(row_size) {
  for (std::vector<float>& plane : planes) plane.resize(static_cast<size_t>(columns) * static_cast<size_t>(rows));
}

double LightCells::CellAngle(int y) const {
  if (!sphere) return column * row;
  return 2 * kPi / width * (std::sin(kPi * (0.5 - static_cast<double>(y) / height)) - std::sin(kPi * (0.5 - (y + 1.0) / height)));
}

ScatterMixture MakeScatterMixture(double angle_deg, double cell) {
  // A factor of five between neighbouring t: within 1 % of the integral.
  const double step = std::log(5.0), a = angle_deg * kPi / 180, first = 2 * std::log(0.3 * cell / a);
  const int count = std::max(1, static_cast<int>(std::ceil((std::log(4.0) - 2 * std::log(a) - first) / step)));
  ScatterMixture mixture;
  mixture.kept = MixtureBelow(first);
  mixture.mean = 1 - MixtureBelow(first + count * step);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double s = first + (i + 0.5) * step;
    mixture.parts.push_back({a * a * std::exp(s), MixtureDensity(s)});
    sum += mixture.parts.back().weight;
  }
  for (ScatterMixture::Part& part : mixture.parts) part.weight *= (1 - mixture.kept - mixture.mean) / sum;
  return mixture;
}

namespace {

// Column by column of the frequencies in `planes`, of `h` rows and `length` frequencies.
void Solve(const ScatterMixture& mixture, const Grid& grid, int h, int length, int stride, std::vector<float> (&planes)[4]) {
  // Frequency 0 on its own.
  std::vector<double> means[4];
  for (size_t k = 0; k < 4; ++k) {
    std::vector<double> column(static_cast<size_t>(h));
    for (size_t y = 0; y < column.size(); ++y) column[y] = planes[k][y * static_cast<size_t>(stride)];
    means[k] = SolveMean(mixture, grid, column);
  }
  std::vector<float> t, weight;
  for (const ScatterMixture::Part& part : mixture.parts)
    t.push_back(static_cast<float>(part.t)), weight.push_back(static_cast<float>(part.weight));
  const ScatterSystem system{h,
                             stride,
                             grid.area.data(),
                             grid.flux.data(),
                             grid.across.data(),
                             grid.eigen.data(),
                             static_cast<int>(t.size()),
                             t.data(),
                             weight.data(),
                             {planes[0].data(), planes[1].data(), planes[2].data(), planes[3].data()}};
  const auto solve = AIRSIM360_SELECT_KERNEL(SolveColumns);
  ParallelFor(length / kScatterBlock, [&](int64_t block) { solve(system, static_cast<int>(block) * kScatterBlock); });
  for (size_t k = 0; k < 4; ++k) {
    for (size_t y = 0; y < means[k].size(); ++y) planes[k][y * static_cast<size_t>(stride)] = static_cast<float>(means[k][y]);
  }
}

}  // namespace

void Scatter(const ScatterMixture& mixture, const LightCells& light, LightCells& out) {
  const int w = light.width, h = light.height, length = light.sphere ? w : 2 * w;
  const int padded = (h + kScatterBlock - 1) / kScatterBlock * kScatterBlock;
  const Grid grid = MakeGrid(light, length);
  const int stride = length + kScatterBlock;
  const size_t size = static_cast<size_t>(padded) * static_cast<size_t>(stride);
  std::vector<float> planes[4];
  for (std::vector<float>& plane : planes) plane.resize(size);
  out = LightCells(light.sphere, w, h, light.column, light.row);

  // Red and green are one complex picture, blue another: the systems are real and the same for both signs of a frequency.
  const auto fourier = AIRSIM360_SELECT_KERNEL(FourierRows);
  const ScatterRows pairs[2] = {{planes[0].data(), planes[1].data(), length, stride, grid.cosines.data(), grid.sines.data()},
                                {planes[2].data(), planes[3].data(), length, stride, grid.cosines.data(), grid.sines.data()}};
  ParallelFor(padded / kScatterBlock, [&](int64_t block) {
    const int first = static_cast<int>(block) * kScatterBlock;
    for (int y = first; y < std::min(first + kScatterBlock, h); ++y) {
      for (size_t k = 0; k < 3; ++k) {
        const float* from = light.planes[k].data() + light.Index(0, y);
        float* to = planes[k].data() + static_cast<size_t>(y) * static_cast<size_t>(stride);
        std::copy_n(from, w, to);
        if (!light.sphere) std::reverse_copy(from, from + w, to + w);
      }
    }
    for (const ScatterRows& rows : pairs) fourier(rows, first, false);
  });

  Solve(mixture, grid, h, length, stride, planes);

  const float scale = 1.0f / static_cast<float>(length);
  ParallelFor(padded / kScatterBlock, [&](int64_t block) {
    const int first = static_cast<int>(block) * kScatterBlock;
    for (const ScatterRows& rows : pairs) fourier(rows, first, true);
    for (int y = first; y < std::min(first + kScatterBlock, h); ++y) {
      for (size_t k = 0; k < 3; ++k) {
        const float* from = planes[k].data() + static_cast<size_t>(y) * static_cast<size_t>(stride);
        float* to = out.planes[k].data() + out.Index(0, y);
        for (int x = 0; x < w; ++x) to[x] = std::max(0.0f, from[x] * scale);
      }
    }
  });
}

}  // namespace airsim360::internal
