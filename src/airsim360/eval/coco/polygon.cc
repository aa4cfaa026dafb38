// COCO's rasteriser: which pixels a polygon covers, exactly as its published masks have them.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "airsim360/base/error.h"
#include "airsim360/eval/coco/mask.h"

namespace airsim360 {
namespace {

constexpr double kScale = 5;          // points of the fine grid a pixel
constexpr double kFarthest = 100000;  // pixels
constexpr size_t kMostPoints = size_t{1} << 24;

struct GridPoint {
  int x = 0, y = 0;
};

// To the nearest, but halves and everything negative towards zero after adding one half, as a conversion to int does.
int Round(double value) { return static_cast<int>(value + 0.5); }

std::vector<GridPoint> FineCorners(std::span<const double> polygon) {
  std::vector<GridPoint> corners;
  for (size_t i = 0; i + 1 < polygon.size(); i += 2) {
    if (!(std::abs(polygon[i]) <= kFarthest && std::abs(polygon[i + 1]) <= kFarthest))
      throw InputError("a polygon has a point farther than 100000 pixels away, or one that is no number");
    corners.push_back({Round(kScale * polygon[i]), Round(kScale * polygon[i + 1])});
  }
  if (corners.size() < 2) throw InputError("a polygon of fewer than two points");
  corners.push_back(corners.front());
  return corners;
}

// All points of the fine grid from a to b, stepping along the longer axis from its lower end, so that an edge has the same
// points in either direction; in the order from a to b.
void AppendEdge(GridPoint a, GridPoint b, std::vector<GridPoint>& outline) {
  const int dx = std::abs(b.x - a.x), dy = std::abs(b.y - a.y), steps = std::max(dx, dy);
  const bool flat = dx >= dy, turned = flat ? a.x > b.x : a.y > b.y;
  if (turned) std::swap(a, b);
  const double slope = steps == 0 ? 0 : static_cast<double>(flat ? b.y - a.y : b.x - a.x) / steps;
  for (int i = 0; i <= steps; ++i) {
    const int t = turned ? steps - i : i;
    outline.push_back(flat ? GridPoint{a.x + t, Round(a.y + slope * t)} : GridPoint{Round(a.x + slope * t), a.y + t});
  }
}

}  // namespace

RleMask RasterizePolygon(std::span<const double> polygon, int width, int height) {
  const std::vector<GridPoint> corners = FineCorners(polygon);
  std::vector<GridPoint> outline;
  for (size_t i = 0; i + 1 < corners.size(); ++i) {
    AppendEdge(corners[i], corners[i + 1], outline);
    if (outline.size() > kMostPoints) throw InputError("a polygon whose outline is longer than " + std::to_string(kMostPoints) + " points");
  }

  // Where the outline steps over the centre of a column, the state changes from the crossed pixel on.
  std::vector<uint32_t> changes;
  for (size_t i = 1; i < outline.size(); ++i) {
    if (outline[i].x == outline[i - 1].x) continue;
    const double x = ((outline[i].x < outline[i - 1].x ? outline[i].x : outline[i].x - 1) + 0.5) / kScale - 0.5;
    if (std::floor(x) != x || x < 0 || x > width - 1) continue;
    const double y = (std::min(outline[i].y, outline[i - 1].y) + 0.5) / kScale - 0.5;
    changes.push_back(static_cast<uint32_t>(x) * static_cast<uint32_t>(height) +
                      static_cast<uint32_t>(std::ceil(std::clamp(y, 0.0, static_cast<double>(height)))));
  }
  changes.push_back(static_cast<uint32_t>(width) * static_cast<uint32_t>(height));
  std::sort(changes.begin(), changes.end());

  // Two changes at one place are none: the run goes on.
  RleMask mask{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {changes[0]}};
  for (size_t i = 1; i < changes.size(); ++i) {
    const uint32_t length = changes[i] - changes[i - 1];
    if (length > 0) {
      mask.counts.push_back(length);
    } else if (++i < changes.size()) {
      mask.counts.back() += changes[i] - changes[i - 1];
    }
  }
  return mask;
}

RleMask RasterizeBox(const std::array<double, 4>& box, int width, int height) {
  const double left = box[0], top = box[1], right = left + box[2], bottom = top + box[3];
  const std::array<double, 8> polygon = {left, top, left, bottom, right, bottom, right, top};
  return RasterizePolygon(polygon, width, height);
}

}  // namespace airsim360
