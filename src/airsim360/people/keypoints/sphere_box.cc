#include "airsim360/people/keypoints/sphere_box.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "airsim360/math/angles.h"
#include "airsim360/math/plane.h"

namespace airsim360 {
namespace {

constexpr double kWidestView = 175 * kPi / 180;
constexpr int kCentering = 16;  // each pass cuts what is left of the asymmetry about tenfold, less near the poles

// Extents of directions along two axes of the tangent plane, as angles from its centre.
struct Extent {
  double left = 0, right = 0, up = 0, down = 0;
};

Extent ExtentOf(const ViewAxes& axes, std::span<const Vec3d> directions) {
  constexpr double kLeastForward = 1e-3;  // what lies behind the camera counts as all the way to the side
  double low_x = INFINITY, high_x = -INFINITY, low_y = INFINITY, high_y = -INFINITY;
  for (const Vec3d& d : directions) {
    const double z = std::max(Dot(d, axes.forward), kLeastForward);
    const double x = Dot(d, axes.right) / z, y = Dot(d, axes.down) / z;
    low_x = std::min(low_x, x), high_x = std::max(high_x, x);
    low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  return {std::atan(low_x), std::atan(high_x), std::atan(low_y), std::atan(high_y)};
}

// Turns the centre until the extents are symmetric; gamma stays.
FieldOfView Center(FieldOfView view, std::span<const Vec3d> directions) {
  for (int pass = 0; pass < kCentering; ++pass) {
    const ViewAxes axes = AxesOf(view);
    const Extent e = ExtentOf(axes, directions);
    const double dx = (e.left + e.right) / 2, dy = (e.up + e.down) / 2;
    const Vec3d center = axes.forward + axes.right * std::tan(dx) + axes.down * std::tan(dy);
    const Vec2d place = LonLat(center);
    view.lon = place.x;
    view.lat = place.y;
  }
  // What is left of the asymmetry goes to both sides, so that everything is inside.
  const Extent e = ExtentOf(AxesOf(view), directions);
  view.width = std::min(2 * std::max(-e.left, e.right), kWidestView);
  view.height = std::min(2 * std::max(-e.up, e.down), kWidestView);
  return view;
}

FieldOfView MiddleOf(std::span<const Vec3d> directions) {
  Vec3d sum;
  for (const Vec3d& d : directions) sum += d;
  const Vec2d place = LonLat(Norm(sum) > 1e-9 ? sum : directions[0]);
  return {.lon = place.x, .lat = place.y};
}

// Convex hull (Andrew's monotone chain), counter-clockwise.
std::vector<Vec2d> Hull(std::vector<Vec2d> points) {
  std::ranges::sort(points, [](Vec2d a, Vec2d b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Vec2d> hull;
  for (int side = 0; side < 2; ++side) {
    const size_t begin = hull.size();
    for (const Vec2d& p : points) {
      while (hull.size() >= begin + 2 && Cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

}  // namespace

Vec2d LonLat(Vec3d d) {
  double lon = std::atan2(d.x, d.z);
  if (lon >= kPi) lon = -kPi;
  return {lon, std::atan2(-d.y, std::hypot(d.x, d.z))};
}

Vec3d DirectionOf(double lon, double lat) { return {std::cos(lat) * std::sin(lon), -std::sin(lat), std::cos(lat) * std::cos(lon)}; }

ViewAxes AxesOf(const FieldOfView& view) {
  const Vec3d forward = DirectionOf(view.lon, view.lat);
  const Vec3d east{std::cos(view.lon), 0, -std::sin(view.lon)};
  const Vec3d down = Cross(forward, east);
  const double c = std::cos(view.gamma), s = std::sin(view.gamma);
  return {east * c - down * s, east * s + down * c, forward};
}

FieldOfView FitFieldOfView(std::span<const Vec3d> directions) {
  if (directions.empty()) return {};
  return Center(MiddleOf(directions), directions);
}

FieldOfView FitRotatedFieldOfView(std::span<const Vec3d> directions) {
  const FieldOfView upright = FitFieldOfView(directions);
  if (directions.empty() || std::max(upright.width, upright.height) >= kWidestView) return upright;
  // Lines of the tangent plane are great circles, so that its convex hull is that of the sphere.
  const ViewAxes axes = AxesOf(upright);
  std::vector<Vec2d> points;
  for (const Vec3d& d : directions) {
    const double z = Dot(d, axes.forward);
    points.push_back({Dot(d, axes.right) / z, Dot(d, axes.down) / z});
  }
  const std::vector<Vec2d> hull = Hull(points);
  std::vector<Vec3d> corners;
  for (const Vec2d& p : hull) corners.push_back(axes.forward + axes.right * p.x + axes.down * p.y);
  FieldOfView best = upright;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Vec2d edge = hull[(i + 1) % hull.size()] - hull[i];
    FieldOfView turned = upright;
    // y grows downwards, and so does the angle of an edge.
    turned.gamma = std::remainder(-std::atan2(edge.y, edge.x), kPi);
    if (turned.gamma >= kPi / 2) turned.gamma -= kPi;
    turned = Center(turned, corners);
    if (SolidAngleOf(turned) < SolidAngleOf(best)) best = turned;
  }
  return best;
}

double SolidAngleOf(const FieldOfView& view) { return 4 * std::asin(std::sin(view.width / 2) * std::sin(view.height / 2)); }

}  // namespace airsim360
