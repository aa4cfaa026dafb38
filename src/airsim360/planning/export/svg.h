// Building blocks of the SVG pictures.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "airsim360/planning/clearance_field.h"

namespace airsim360::internal {

/// Rectangle on the sheet, pixels.
struct Panel {
  double x, y, width, height;
};

/// Metres of the ground to pixels of a panel: north up, the same scale along both axes, whole area shown.
struct GroundView {
  double scale, x0, y0;
  GroundView(const Panel& panel, double min_x, double min_y, double max_x, double max_y);
  double X(double east) const { return x0 + scale * east; }
  double Y(double north) const { return y0 - scale * north; }
};

/// Collects elements.
class Svg {
 public:
  Svg(int width, int height);
  void Text(double x, double y, int size, const std::string& text, const char* anchor = "start");
  void Line(double x1, double y1, double x2, double y2, const char* color, double width, bool dashed = false);
  void Polyline(std::span<const double> x, std::span<const double> y, const std::string& color, double width, double opacity = 1);
  void Dot(double x, double y, double radius, const char* color);
  void Frame(const Panel& panel);
  /// Obstacles seen from above: dark where something stands between the heights `low` and `high`, light
  /// where all is lower.
  void Map(const Panel& panel, const GroundView& view, const ClearanceField& map, double low, double high);
  /// A curve over time with axes; a line at `limit` if it is positive.
  void Diagram(const Panel& panel, const std::string& title, std::span<const double> t, std::span<const double> values, double limit);
  void ScaleBar(const Panel& panel, const GroundView& view);
  std::string Finish();

 private:
  std::string out_;
};

/// 1, 2 or 5 times a power of ten: about a fifth of `range`.
double NiceStep(double range);
/// "%.4g".
std::string Short(double value);

}  // namespace airsim360::internal
