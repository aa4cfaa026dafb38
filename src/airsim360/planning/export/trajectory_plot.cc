#include "airsim360/planning/export/trajectory_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "airsim360/planning/export/svg.h"

namespace airsim360 {
namespace {

using internal::GroundView;
using internal::Panel;
using internal::Svg;

constexpr int kSamples = 800;
constexpr double kMapMargin = 0.08;  // of the extent, around a way on its map

// Blue (slow) over yellow to red (fast).
std::string SpeedColor(double part) {
  const double s = std::clamp(part, 0.0, 1.0);
  const int r = static_cast<int>(40 + 200 * std::min(1.0, 2 * s));
  const int g = static_cast<int>(s < 0.5 ? 90 + 220 * s : 200 - 320 * (s - 0.5));
  const int b = static_cast<int>(200 * (1 - std::min(1.0, 1.6 * s)));
  char text[8];
  std::snprintf(text, sizeof(text), "#%02x%02x%02x", r, g, b);
  return text;
}

struct Extent {
  Vec3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void Add(Vec3d p) {
    low = Min(low, p);
    high = Max(high, p);
  }
  GroundView View(const Panel& panel) const {
    const double size = std::max({high.x - low.x, high.y - low.y, 4.0}), margin = kMapMargin * size + 2;
    return {panel, low.x - margin, low.y - margin, high.x + margin, high.y + margin};
  }
};

}  // namespace

std::string PlotFlight(const PolynomialTrajectory& path, const PlotOptions& options) {
  std::vector<double> t, speed, acceleration, snap, height;
  std::vector<Vec3d> way;
  Extent extent;
  for (int i = 0; i <= kSamples; ++i) {
    t.push_back(path.duration() * i / kSamples);
    const TrajectoryPoint point = path.At(t.back());
    speed.push_back(Norm(point.v));
    acceleration.push_back(Norm(point.a));
    snap.push_back(Norm(point.snap));
    height.push_back(point.p.z);
    way.push_back(point.p);
    extent.Add(point.p);
  }
  Svg svg(1280, 760);
  svg.Text(20, 30, 18, options.title);
  const Panel map{20, 50, 700, 680};
  const GroundView view = extent.View(map);
  if (options.map) svg.Map(map, view, *options.map, extent.low.z - 0.5, extent.high.z + 0.5);
  svg.Frame(map);
  svg.ScaleBar(map, view);

  // The way in pieces of one colour each.
  const double fastest = std::max(*std::max_element(speed.begin(), speed.end()), 1e-9);
  constexpr int kPiece = 8;
  for (int i = 0; i < kSamples; i += kPiece) {
    std::vector<double> x, y;
    for (int k = i; k <= std::min(i + kPiece, kSamples); ++k) {
      x.push_back(view.X(way[k].x));
      y.push_back(view.Y(way[k].y));
    }
    svg.Polyline(x, y, SpeedColor(speed[std::min(i + kPiece / 2, kSamples)] / fastest), 3.5);
  }
  for (size_t i = 0; i <= path.segments(); ++i) {
    const Vec3d p = path.At(i < path.segments() ? path.start(i) : path.duration()).p;
    svg.Dot(view.X(p.x), view.Y(p.y), 4, i == 0 ? "#1a7f37" : i == path.segments() ? "#c0392b" : "#222222");
  }

  const double x = 790, width = 460, rows = 135, first = 70, step = 175;
  svg.Diagram({x, first, width, rows}, "speed, m/s", t, speed, options.max_speed);
  svg.Diagram({x, first + step, width, rows}, "acceleration, m/s²", t, acceleration, options.max_acceleration);
  svg.Diagram({x, first + 2 * step, width, rows}, "snap, m/s⁴", t, snap, 0);
  svg.Diagram({x, first + 3 * step, width, rows}, "height, m, over time, s", t, height, 0);
  return svg.Finish();
}

std::string PlotRoutes(std::span<const std::vector<Vec3d>> routes, const PlotOptions& options) {
  Extent extent;
  for (const auto& route : routes) {
    for (const Vec3d p : route) extent.Add(p);
  }
  if (routes.empty() && options.map) {
    extent.Add(options.map->box().min);
    extent.Add(options.map->box().max);
  }
  Svg svg(1000, 1050);
  svg.Text(20, 30, 18, options.title);
  const Panel map{20, 45, 960, 985};
  const GroundView view = extent.View(map);
  if (options.map) svg.Map(map, view, *options.map, extent.low.z + 2, extent.high.z);
  svg.Frame(map);
  const double low = extent.low.z, high = std::max(extent.high.z, low + 1e-9);
  for (const auto& route : routes) {
    std::vector<double> x, y;
    double z = 0;
    for (const Vec3d p : route) {
      x.push_back(view.X(p.x));
      y.push_back(view.Y(p.y));
      z += p.z / static_cast<double>(route.size());
    }
    svg.Polyline(x, y, SpeedColor((z - low) / (high - low)), 1.2, 0.8);
  }
  svg.ScaleBar(map, view);
  svg.Text(map.x + map.width - 8, map.y + map.height - 10, 12,
           "colour: height, " + internal::Short(low) + " … " + internal::Short(high) + " m", "end");
  return svg.Finish();
}

}  // namespace airsim360
