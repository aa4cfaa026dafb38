#include "airsim360/worlds/osm/osm_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "airsim360/base/error.h"

namespace airsim360::internal {
namespace {

// Bilinear between the middles of cells; the border's heights go on outside.
double Between(const std::vector<float>& heights, int columns, int rows, double x, double y) {
  x = std::clamp(x - 0.5, 0.0, columns - 1.0);
  y = std::clamp(y - 0.5, 0.0, rows - 1.0);
  const int i = std::min(static_cast<int>(x), std::max(columns - 2, 0)), k = std::min(static_cast<int>(y), std::max(rows - 2, 0));
  const auto at = [&](int column, int row) {
    column = std::min(column, columns - 1);
    row = std::min(row, rows - 1);
    return static_cast<double>(heights[static_cast<size_t>(row) * static_cast<size_t>(columns) + static_cast<size_t>(column)]);
  };
  const double s = x - i, t = y - k;
  return (at(i, k) * (1 - s) + at(i + 1, k) * s) * (1 - t) + (at(i, k + 1) * (1 - s) + at(i + 1, k + 1) * s) * t;
}

using Polygon = std::vector<Vec2d>;

// Cuts every polygon (convex) at n * p = k * step for all whole k.
std::vector<Polygon> Sliced(const std::vector<Polygon>& polygons, Vec2d n, double step) {
  std::vector<Polygon> pieces;
  for (Polygon rest : polygons) {
    const auto level = [&](Vec2d p) { return (n.x * p.x + n.y * p.y) / step; };
    double low = level(rest[0]), high = low;
    for (Vec2d p : rest) {
      low = std::min(low, level(p));
      high = std::max(high, level(p));
    }
    for (double k = std::floor(low + 1e-7) + 1; k < high - 1e-7; ++k) {
      Polygon below, above;
      for (size_t i = 0; i < rest.size(); ++i) {
        const Vec2d a = rest[i], b = rest[(i + 1) % rest.size()];
        const double da = level(a) - k, db = level(b) - k;
        if (da <= 0) below.push_back(a);
        if (da >= 0) above.push_back(a);
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
          const Vec2d p = a + (b - a) * (da / (da - db));
          below.push_back(p);
          above.push_back(p);
        }
      }
      if (below.size() >= 3) pieces.push_back(std::move(below));
      rest = std::move(above);
      if (rest.size() < 3) break;
    }
    if (rest.size() >= 3) pieces.push_back(std::move(rest));
  }
  return pieces;
}

}  // namespace

void FillUnknown(std::vector<float>& heights, int columns, int rows) {
  const auto unknown = [](float h) { return !std::isfinite(h); };
  if ((columns <= 1 && rows <= 1) || std::none_of(heights.begin(), heights.end(), unknown)) return;
  // The means of two by two cells, complete, tell what is missing here.
  const int wide = (columns + 1) / 2, high = (rows + 1) / 2;
  std::vector<float> coarse;
  coarse.reserve(static_cast<size_t>(wide) * static_cast<size_t>(high));
  for (int row = 0; row < high; ++row)
    for (int column = 0; column < wide; ++column) {
      double sum = 0;
      int count = 0;
      for (int y = 2 * row; y < std::min(2 * row + 2, rows); ++y)
        for (int x = 2 * column; x < std::min(2 * column + 2, columns); ++x) {
          const float h = heights[static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x)];
          if (unknown(h)) continue;
          sum += static_cast<double>(h);
          ++count;
        }
      coarse.push_back(count ? static_cast<float>(sum / count) : std::numeric_limits<float>::quiet_NaN());
    }
  FillUnknown(coarse, wide, high);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      float& h = heights[static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x)];
      if (unknown(h)) h = static_cast<float>(Between(coarse, wide, high, (x + 0.5) / 2, (y + 0.5) / 2));
    }
}

Relief::Relief(HeightGrid grid, const GeoPoint& origin, double area) : grid_(std::move(grid)), origin_(origin) {
  const size_t cells = static_cast<size_t>(grid_.columns) * static_cast<size_t>(grid_.rows);
  if (cells == 0 || grid_.heights.size() != cells) throw InputError("the grid of heights is empty");
  if (std::none_of(grid_.heights.begin(), grid_.heights.end(), [](float h) { return std::isfinite(h); }))
    throw InputError("the grid of heights knows none");
  FillUnknown(grid_.heights, grid_.columns, grid_.rows);
  const GeoFrame frame(origin);
  metres_per_lat_ = frame.ToWorld({origin.latitude_deg + 0.01, origin.longitude_deg, 0}).y * 100;
  metres_per_lon_ = frame.ToWorld({origin.latitude_deg, origin.longitude_deg + 0.01, 0}).x * 100;
  // A quarter of a cell, so that the bends between its heights show; half a million squares at most.
  const double cell = std::min(grid_.cell_lat * metres_per_lat_, grid_.cell_lon * metres_per_lon_);
  step_ = std::max(std::clamp(cell / 4, 2.0, 6.0), std::sqrt(area / 500'000));
  zero_ = Raw({0, 0});
}

double Relief::At(Vec2d p) const {
  if (flat()) return 0;
  const double i = std::floor(p.x / step_), k = std::floor(p.y / step_), s = p.x / step_ - i, t = p.y / step_ - k;
  const auto at = [&](double column, double row) { return Raw({column * step_, row * step_}); };
  const double corner = at(i, k), far = at(i + 1, k + 1);
  // Right of the diagonal or left of it.
  if (s >= t) {
    const double side = at(i + 1, k);
    return corner + s * (side - corner) + t * (far - side) - zero_;
  }
  const double side = at(i, k + 1);
  return corner + t * (side - corner) + s * (far - side) - zero_;
}

std::vector<Polygon> Relief::Split(Vec2d a, Vec2d b, Vec2d c) const {
  if (flat()) return {{a, b, c}};
  return Sliced(Sliced(Sliced({{a, b, c}}, {1, 0}, step_), {0, 1}, step_), {1, -1}, step_);
}

std::vector<Vec2d> Relief::Split(Vec2d a, Vec2d b) const {
  std::vector<double> stops{0, 1};
  if (!flat())
    for (const Vec2d n : {Vec2d{1, 0}, Vec2d{0, 1}, Vec2d{1, -1}}) {
      const double from = (n.x * a.x + n.y * a.y) / step_, to = (n.x * b.x + n.y * b.y) / step_;
      for (double k = std::floor(std::min(from, to)) + 1; k < std::max(from, to); ++k) stops.push_back((k - from) / (to - from));
    }
  std::sort(stops.begin(), stops.end());
  std::vector<Vec2d> points;
  double last = -1;
  for (double stop : stops) {
    if (stop > last + 1e-6 || stop == 1) {
      if (stop == 1 && points.size() > 1 && stop - last <= 1e-6) points.pop_back();
      points.push_back(a + (b - a) * stop);
      last = stop;
    }
  }
  points.back() = b;
  return points;
}

double Relief::Raw(Vec2d p) const {
  const double lat = origin_.latitude_deg + p.y / metres_per_lat_, lon = origin_.longitude_deg + p.x / metres_per_lon_;
  return Between(grid_.heights, grid_.columns, grid_.rows, (lon - grid_.longitude_west) / grid_.cell_lon,
                 (grid_.latitude_north - lat) / grid_.cell_lat);
}

}  // namespace airsim360::internal
