#include "airsim360/eval/spherical_iou.h"

#include <array>
#include <cmath>
#include <vector>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"
#include "airsim360/math/vector.h"

namespace airsim360 {
namespace {

void Check(const SphericalBox& box) {
  const double sum = box.lon + box.lat + box.width + box.height + box.gamma;
  if (!std::isfinite(sum) || !(box.width > 0 && box.width < kPi && box.height > 0 && box.height < kPi))
    throw InputError("spherical box: width and height must lie between 0 and pi, everything be finite");
}

// Corners in order around the box, as the viewer sees them clockwise from the top left.
std::array<Vec3d, 4> Corners(const SphericalBox& box) {
  const Mat3d axes = SphericalAxes(box.lon, box.lat, box.gamma);
  const Vec3d forward = axes.column(2), right = axes.column(0) * std::tan(box.width / 2), down = axes.column(1) * std::tan(box.height / 2);
  return {Normalized(forward - right - down), Normalized(forward + right - down), Normalized(forward + right + down),
          Normalized(forward - right + down)};
}

// The part of a convex polygon on the side of `normal` (Sutherland and Hodgman, with great circles).
std::vector<Vec3d> Clip(const std::vector<Vec3d>& polygon, Vec3d normal) {
  std::vector<Vec3d> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double da = Dot(a, normal), db = Dot(b, normal);
    if (da >= 0) kept.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.push_back(Normalized(a * db - b * da) * (da > 0 ? -1 : 1));
  }
  return kept;
}

// Solid angle of a triangle (A. van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30(2), 1983).
double TriangleArea(Vec3d a, Vec3d b, Vec3d c) { return 2 * std::atan2(Dot(a, Cross(b, c)), 1 + Dot(a, b) + Dot(b, c) + Dot(c, a)); }

}  // namespace

Mat3d SphericalAxes(double lon, double lat, double gamma) {
  const Vec3d ahead{std::cos(lat) * std::sin(lon), -std::sin(lat), std::cos(lat) * std::cos(lon)};
  const Vec3d east{std::cos(lon), 0, -std::sin(lon)}, south = Cross(ahead, east);
  const double c = std::cos(gamma), s = std::sin(gamma);
  return Mat3d::FromColumns(east * c - south * s, east * s + south * c, ahead);
}

double SphericalBoxArea(const SphericalBox& box) { return 4 * std::asin(std::sin(box.width / 2) * std::sin(box.height / 2)); }

double SphericalIntersection(const SphericalBox& a, const SphericalBox& b) {
  Check(a);
  Check(b);
  const auto first = Corners(a), second = Corners(b);
  std::vector<Vec3d> polygon(first.begin(), first.end());
  for (size_t i = 0; i < 4 && !polygon.empty(); ++i) polygon = Clip(polygon, Cross(second[i], second[(i + 1) % 4]));
  double area = 0;
  for (size_t i = 2; i < polygon.size(); ++i) area += TriangleArea(polygon[0], polygon[i - 1], polygon[i]);
  return std::abs(area);
}

double SphericalIou(const SphericalBox& a, const SphericalBox& b) {
  const double both = SphericalIntersection(a, b);
  return both / (SphericalBoxArea(a) + SphericalBoxArea(b) - both);
}

}  // namespace airsim360
