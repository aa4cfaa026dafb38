#include "airsim360/people/navigation/ground_height.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace airsim360::internal {

void GroundHeights::Add(std::span<const GroundTriangle> triangles) {
  for (const GroundTriangle& triangle : triangles) {
    const auto [a, b, c] = triangle.p;
    const Vec3f normal = Cross(b - a, c - a);
    if (std::abs(normal.z) < 0.5f * Norm(normal) || std::abs(normal.z) < 1e-8f) continue;
    triangles_.push_back({a, b, c});
  }
}

void GroundHeights::Finish(Vec2d min, Vec2d max) {
  // Triangles on the border of tiles came more than once.
  const auto key = [](const Triangle& t) { return std::array<float, 9>{t.a.x, t.a.y, t.a.z, t.b.x, t.b.y, t.b.z, t.c.x, t.c.y, t.c.z}; };
  std::sort(triangles_.begin(), triangles_.end(), [&](const Triangle& s, const Triangle& t) { return key(s) < key(t); });
  triangles_.erase(
      std::unique(triangles_.begin(), triangles_.end(), [&](const Triangle& s, const Triangle& t) { return key(s) == key(t); }),
      triangles_.end());
  triangles_.shrink_to_fit();
  grid_ = BucketGrid(min, max, 1);
  for (uint32_t i = 0; i < triangles_.size(); ++i) {
    const Triangle& t = triangles_[i];
    const Vec3f low = Min(t.a, Min(t.b, t.c)), high = Max(t.a, Max(t.b, t.c));
    if (high.x < min.x || high.y < min.y || low.x > max.x || low.y > max.y) continue;
    grid_.Add(i, {low.x, low.y}, {high.x, high.y});
  }
  grid_.Finish();
}

template <class Look>
void GroundHeights::Each(double x, double y, const Look& look) const {
  for (const uint32_t i : grid_.At({x, y})) {
    const Triangle& t = triangles_[i];
    const double ux = t.b.x - t.a.x, uy = t.b.y - t.a.y, vx = t.c.x - t.a.x, vy = t.c.y - t.a.y;
    const double px = x - t.a.x, py = y - t.a.y, area = ux * vy - uy * vx;
    const double b = (px * vy - py * vx) / area, c = (ux * py - uy * px) / area;
    if (b < -1e-6 || c < -1e-6 || b + c > 1 + 1e-6) continue;
    look(t.a.z + b * (t.b.z - t.a.z) + c * (t.c.z - t.a.z));
  }
}

double GroundHeights::At(double x, double y, double z, double window) const {
  double best = z, best_distance = window;
  Each(x, y, [&](double height) {
    // Of surfaces that lie on one another (stripes on a road) the upper one.
    const double distance = std::abs(height - z);
    if (distance > window) return;
    if (distance < best_distance - 0.03 || (distance < best_distance + 0.03 && height > best)) {
      best = height;
      best_distance = distance;
    }
  });
  return best;
}

double GroundHeights::StepAt(double x, double y, double z, double up, double down) const {
  double best = z - down;
  bool found = false;
  Each(x, y, [&](double height) {
    if (height < best || height > z + up) return;
    best = height;
    found = true;
  });
  return found ? best : z;
}

namespace {

constexpr double kFineCell = 0.25;  // metres, half a cell of the result

/// Which cells people may stand on.
struct WalkableRaster {
  int columns, rows;
  std::vector<uint8_t> cells;

  WalkableRaster(int columns_, int rows_)
      : columns(columns_), rows(rows_), cells(static_cast<size_t>(columns) * static_cast<size_t>(rows), 0) {}
  size_t At(int c, int r) const { return static_cast<size_t>(r) * static_cast<size_t>(columns) + static_cast<size_t>(c); }

  void Add(const NavGraph& graph, uint32_t index, Vec2d origin) {
    const NavPolygon& polygon = graph.polygons[index];
    const int c0 = static_cast<int>((polygon.min.x - origin.x) / kFineCell), c1 = static_cast<int>((polygon.max.x - origin.x) / kFineCell);
    const int r0 = static_cast<int>((polygon.min.y - origin.y) / kFineCell), r1 = static_cast<int>((polygon.max.y - origin.y) / kFineCell);
    for (int r = r0; r <= r1; ++r)
      for (int c = c0; c <= c1; ++c)
        if (graph.Inside(index, {origin.x + (c + 0.5) * kFineCell, origin.y + (r + 0.5) * kFineCell})) cells[At(c, r)] = 1;
  }

  /// By one cell to four sides.
  void Widen() {
    const std::vector<uint8_t> before = cells;
    const auto row = static_cast<size_t>(columns);
    for (int r = 1; r + 1 < rows; ++r)
      for (int c = 1; c + 1 < columns; ++c) {
        const size_t at = At(c, r);
        if (before[at - 1] | before[at + 1] | before[at - row] | before[at + row]) cells[at] = 1;
      }
  }

  /// Sums of the cells left of each, by rows of columns + 1.
  std::vector<int32_t> PrefixSums() const {
    std::vector<int32_t> prefix(static_cast<size_t>(columns + 1) * static_cast<size_t>(rows));
    for (int r = 0; r < rows; ++r) {
      int32_t* row = &prefix[static_cast<size_t>(r) * static_cast<size_t>(columns + 1)];
      for (int c = 0; c < columns; ++c) row[c + 1] = row[c] + cells[At(c, r)];
    }
    return prefix;
  }
};

}  // namespace

void OpenShares::Build(const NavGraph& graph, double person_radius) {
  // Cells whose middle lies on the mesh, widened by what was cut off it.
  min_ = {graph.min.x - 1, graph.min.y - 1};
  columns_ = static_cast<int>((graph.max.x - graph.min.x + 2) / kStep) + 1;
  rows_ = static_cast<int>((graph.max.y - graph.min.y + 2) / kStep) + 1;
  WalkableRaster raster(columns_ * 2, rows_ * 2);
  for (uint32_t i = 0; i < graph.polygons.size(); ++i) raster.Add(graph, i, min_);
  const int widen = static_cast<int>(std::lround(person_radius / kFineCell));
  for (int pass = 0; pass < widen; ++pass) raster.Widen();

  // Share of the disc, by rows of the disc over prefix sums.
  const int reach = static_cast<int>(kRadius / kFineCell);
  std::vector<int> half(static_cast<size_t>(2 * reach + 1));
  double disc = 0;
  for (int d = -reach; d <= reach; ++d) {
    half[static_cast<size_t>(d + reach)] = static_cast<int>(std::sqrt(kRadius * kRadius - d * d * kFineCell * kFineCell) / kFineCell);
    disc += 2 * half[static_cast<size_t>(d + reach)] + 1;
  }
  const std::vector<int32_t> prefix = raster.PrefixSums();
  shares_.assign(static_cast<size_t>(columns_) * static_cast<size_t>(rows_), 255);
  for (int r = 0; r < rows_; ++r) {
    for (int c = 0; c < columns_; ++c) {
      double sum = 0;
      for (int d = -reach; d <= reach; ++d) {
        const int y = 2 * r + d;
        if (y < 0 || y >= raster.rows) continue;
        const int h = half[static_cast<size_t>(d + reach)];
        const int from = std::clamp(2 * c - h, 0, raster.columns), to = std::clamp(2 * c + h + 1, 0, raster.columns);
        const int32_t* row = &prefix[static_cast<size_t>(y) * static_cast<size_t>(raster.columns + 1)];
        sum += row[to] - row[from];
      }
      shares_[static_cast<size_t>(r) * static_cast<size_t>(columns_) + static_cast<size_t>(c)] =
          static_cast<uint8_t>(std::clamp(sum / disc, 0.1, 1.0) * 255);
    }
  }
}

double OpenShares::At(Vec2d p) const {
  const int c = std::clamp(static_cast<int>((p.x - min_.x) / kStep + 0.5), 0, columns_ - 1);
  const int r = std::clamp(static_cast<int>((p.y - min_.y) / kStep + 0.5), 0, rows_ - 1);
  return shares_[static_cast<size_t>(r) * static_cast<size_t>(columns_) + static_cast<size_t>(c)] / 255.0;
}

}  // namespace airsim360::internal
