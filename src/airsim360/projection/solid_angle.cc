// Solid angles of pixels.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "airsim360/projection/calibrated_lens.h"
#include "airsim360/projection/camera.h"
#include "airsim360/projection/fisheye_radius.h"
#include "airsim360/projection/solid_angle_rows.h"

namespace airsim360 {
namespace {

// Solid angle of the triangle (a, b, c) in the plane z = 1, whose doubled area is given (van Oosterom and
// Strackee 1983, with the triple product of points of that plane = doubled area: nothing cancels, however
// small the triangle).
double Triangle(Vec2d a, Vec2d b, Vec2d c, double doubled_area) {
  const auto dot = [](Vec2d p, Vec2d q) { return p.x * q.x + p.y * q.y + 1; };
  const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
  return 2 * std::atan2(doubled_area, la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la);
}

// Solid angle of a rectangle in the plane z = 1 with a corner p and sides d > 0.
double Rectangle(Vec2d p, Vec2d d) {
  const Vec2d right{p.x + d.x, p.y}, below{p.x, p.y + d.y}, opposite = p + d;
  return Triangle(p, right, below, d.x * d.y) + Triangle(opposite, below, right, d.x * d.y);
}

double Of(const Equirectangular& c, int, int j) {
  // 2 pi / W (sin top - sin bottom), by the product formula, which does not cancel.
  const double dphi = std::numbers::pi / c.height, middle = std::numbers::pi * (0.5 - (j + 0.5) / c.height);
  return 2 * std::numbers::pi / c.width * 2 * std::cos(middle) * std::sin(dphi / 2);
}

double Of(const CubeFace& c, int i, int j) {
  const double d = 2.0 / c.size;
  return Rectangle({i * d - 1, j * d - 1}, {d, d});
}

double Of(const Pinhole& c, int i, int j) { return Rectangle({(i - c.cx) / c.fx, (j - c.cy) / c.fy}, {1 / c.fx, 1 / c.fy}); }

// Integral of (1 - cos theta) d psi along the straight line from p to q, psi being the angle around the axis
// and theta held at max_theta outside the circle: Gauss-Legendre with 8 points.
double EdgePart(const Fisheye& c, Vec2d p, Vec2d q) {
  constexpr std::array<double, 4> kNode = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> kWeight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  const Vec2d middle = (p + q) * 0.5, half = (q - p) * 0.5;
  const double cross = middle.x * half.y - middle.y * half.x;  // r^2 d psi / d s, the same all along a line
  double sum = 0;
  for (size_t n = 0; n < kNode.size(); ++n) {
    for (double sign : {-1.0, 1.0}) {
      const Vec2d at = middle + half * (sign * kNode[n]);
      const double r = std::hypot(at.x, at.y);
      const double s = std::sin(internal::ThetaOfRadius(c, r).value_or(c.max_theta) / 2) / r;
      sum += kWeight[n] * 2 * s * s;  // (1 - cos theta) / r^2
    }
  }
  return cross == 0 ? 0 : cross * sum;
}

// The same, cut where the line crosses the circle of max_theta, so that every part is smooth.
double Edge(const Fisheye& c, Vec2d p, Vec2d q) {
  const Vec2d d = q - p;
  const double radius = internal::RadiusOfTheta(c, c.max_theta);
  const double a = d.x * d.x + d.y * d.y, b = p.x * d.x + p.y * d.y, e = p.x * p.x + p.y * p.y - radius * radius;
  const double root = b * b - a * e;
  double from = 0, sum = 0;
  if (root > 0) {
    for (double s : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a}) {
      if (s <= from || s >= 1) continue;
      sum += EdgePart(c, p + d * from, p + d * s);
      from = s;
    }
  }
  return sum + EdgePart(c, p + d * from, q);
}

double Of(const Fisheye& c, int i, int j) {
  // By Green's theorem the solid angle is the integral of (1 - cos theta) d psi around the pixel.
  const double left = (i - c.cx) / c.fx, right = (i + 1 - c.cx) / c.fx;
  const double top = (j - c.cy) / c.fy, bottom = (j + 1 - c.cy) / c.fy;
  const Vec2d a{left, top}, b{right, top}, e{right, bottom}, f{left, bottom};
  return std::max(0.0, Edge(c, a, b) + Edge(c, b, e) + Edge(c, e, f) + Edge(c, f, a));
}

// Solid angle of the triangle of three unit vectors (van Oosterom and Strackee 1983), from differences, which do not
// cancel where it is small.
double Triangle(Vec3d a, Vec3d b, Vec3d c) { return 2 * std::atan2(Dot(a, Cross(b - a, c - a)), 1 + Dot(a, b) + Dot(b, c) + Dot(c, a)); }

using MaybeRay = std::optional<Vec3d>;

// Of a rectangle of the picture whose corners have rays, upper and lower ones from the left; nullopt where one has none.
std::optional<double> Quadrangle(const MaybeRay& a, const MaybeRay& b, const MaybeRay& d, const MaybeRay& e) {
  if (!a || !b || !d || !e) return std::nullopt;
  return Triangle(*a, *b, *e) + Triangle(*a, *e, *d);
}

std::optional<double> Quadrangle(const CalibratedLens& c, Vec2d p, double side) {
  const auto ray = [&](double x, double y) { return internal::LensRay(c, p + Vec2d{x, y}); };
  return Quadrangle(ray(0, 0), ray(side, 0), ray(0, side), ray(side, side));
}

// Where the field ends: the part of the pixel whose points have rays, all of the size of one that has its corners too.
double OfRim(const CalibratedLens& c, Vec2d corner) {
  constexpr int kParts = 8;
  const Camera camera = c;
  int seen = 0;
  std::optional<double> part;
  for (int k = 0; k < kParts * kParts; ++k) {
    const Vec2d at = corner + Vec2d{k % kParts / 8.0, k / kParts / 8.0};
    if (!PixelToRay(camera, at + Vec2d{0.5 / kParts, 0.5 / kParts})) continue;
    ++seen;
    if (!part) part = Quadrangle(c, at, 1.0 / kParts);
  }
  return seen * part.value_or(0);
}

double Of(const CalibratedLens& c, int i, int j) {
  const Vec2d corner{static_cast<double>(i), static_cast<double>(j)};
  const auto whole = Quadrangle(c, corner, 1);
  return whole ? *whole : OfRim(c, corner);
}

// Rays of the corners along the upper side of row j.
std::vector<MaybeRay> CornersOf(const CalibratedLens& c, int j) {
  std::vector<MaybeRay> rays;
  for (int i = 0; i <= c.width; ++i) rays.push_back(internal::LensRay(c, {static_cast<double>(i), static_cast<double>(j)}));
  return rays;
}

}  // namespace

double SolidAngle(const Camera& camera, int i, int j) {
  return std::visit([&](const auto& c) { return Of(c, i, j); }, camera);
}

void internal::SolidAnglesOfRows(const Camera& camera, int first, int last, std::span<double> values) {
  size_t at = 0;
  const auto* const lens = std::get_if<CalibratedLens>(&camera);
  if (lens == nullptr) {
    for (int j = first; j < last; ++j)
      for (int i = 0; i < Width(camera); ++i) values[at++] = SolidAngle(camera, i, j);
    return;
  }
  // Four pixels share a corner.
  std::vector<MaybeRay> upper, lower = CornersOf(*lens, first);
  for (int j = first; j < last; ++j) {
    upper = std::exchange(lower, CornersOf(*lens, j + 1));
    for (size_t i = 0; i + 1 < upper.size(); ++i) {
      const auto whole = Quadrangle(upper[i], upper[i + 1], lower[i], lower[i + 1]);
      values[at++] = whole ? *whole : OfRim(*lens, {static_cast<double>(i), static_cast<double>(j)});
    }
  }
}

}  // namespace airsim360
