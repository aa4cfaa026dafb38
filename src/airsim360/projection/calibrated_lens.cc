#include "airsim360/projection/calibrated_lens.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"

namespace airsim360::internal {
namespace {

// Of laws with a tangent: 89.95 degrees, where it is 1256.
constexpr double kAlmostRight = kPi / 2 - 8e-4;
constexpr double kRounding = std::numeric_limits<double>::epsilon();

// A radius and its derivative by the angle; slope <= 0 or not a number: the law has ended.
struct Radius {
  double r, slope;
};

// c0 x + c1 x^2 + … and its derivative.
Radius Powers(const std::array<double, 6>& c, double x) {
  double value = 0, slope = 0;
  for (size_t i = c.size(); i-- > 0;) {
    slope = slope * x + static_cast<double>(i + 1) * c[i];
    value = (value + c[i]) * x;
  }
  return {value, slope};
}

// x (1 + c0 x^2 + c1 x^4 + …) and its derivative: OpenCV's fisheye, with two more terms.
Radius OddPowers(const std::array<double, 6>& c, double x) {
  const double t = x * x;
  double value = 0, slope = 0;
  for (size_t i = c.size(); i-- > 0;) {
    value = (value + c[i]) * t;
    slope = (slope + static_cast<double>(2 * i + 3) * c[i]) * t;
  }
  return {x * (1 + value), 1 + slope};
}

// sin theta / (a + b cos theta + c sqrt(d sin^2 theta + (e + cos theta)^2)): what the three spherical laws have in
// common.
Radius OfSphere(double theta, double a, double b, double c, double d, double e) {
  const double sine = std::sin(theta), cosine = std::cos(theta), shifted = e + cosine;
  const double root = std::sqrt(d * sine * sine + shifted * shifted);
  const double below = a + b * cosine + c * root;
  if (!(below > 0)) return {0, 0};
  const double turn = root > 0 ? c * (d * sine * cosine - shifted * sine) / root : 0;
  return {sine / below, (cosine * below - sine * (turn - b * sine)) / (below * below)};
}

// The x in [0, high] with f(x) = value for a growing f: Newton, kept inside a bracket that halves whenever a step would
// leave it.
template <class F>
double Solve(const F& f, double value, double start, double high) {
  double low = 0, x = std::clamp(start, 0.0, high);
  for (int step = 0; step < 200; ++step) {
    const Radius at = f(x);
    const double error = at.r - value;
    if (error == 0) break;
    (error > 0 ? high : low) = x;
    double next = x - error / at.slope;
    if (!(next > low && next < high)) next = (low + high) / 2;
    const double change = std::abs(next - x);
    x = next;
    if (change <= kRounding * x) break;
  }
  return x;
}

Radius OfLaw(const CalibratedLens& lens, double theta) {
  const auto& h = lens.shape;
  switch (lens.law) {
    case LensLaw::kPerspective: {
      const double t = std::tan(theta);
      return {t, 1 + t * t};
    }
    case LensLaw::kEquidistant:
      return OddPowers(h, theta);
    case LensLaw::kFieldOfView: {
      const double t = std::tan(theta), scale = 2 * std::tan(h[0] / 2), s = scale * t;
      return {std::atan(s) / h[0], scale * (1 + t * t) / ((1 + s * s) * h[0])};
    }
    case LensLaw::kUnifiedSphere:
      return OfSphere(theta, h[0], 1, 0, 0, 1);
    case LensLaw::kDoubleSphere:
      return OfSphere(theta, (1 - h[1]) * h[0], 1 - h[1], h[1], 1, h[0]);
    case LensLaw::kExtendedUnified:
      return OfSphere(theta, 0, 1 - h[0], h[0], h[1], 0);
    case LensLaw::kAngleToRadius:
      return Powers(h, theta);
  }
  return {0, 0};
}

// The radial part of the distortion at q = u^2 + v^2, its derivative by q, and what it is divided by.
struct RadialFactor {
  double R, R_q, divisor;
};

RadialFactor FactorOf(const CalibratedLens& lens, double q) {
  const auto& k = lens.radial;
  const auto& d = lens.divisor;
  const double above = 1 + q * (k[0] + q * (k[1] + q * (k[2] + q * k[3])));
  const double above_q = k[0] + q * (2 * k[1] + q * (3 * k[2] + q * 4 * k[3]));
  const double below = 1 + q * (d[0] + q * (d[1] + q * d[2])), below_q = d[0] + q * (2 * d[1] + q * 3 * d[2]);
  const double R = above / below;
  return {R, (above_q - R * below_q) / below, below};
}

// Distortion of a point of the plane, and its Jacobian by rows.
struct Distorted {
  Vec2d at;
  double xx, xy, yx, yy;
  double divisor;
  double Determinant() const { return xx * yy - xy * yx; }
};

Distorted Distort(const CalibratedLens& lens, Vec2d m) {
  const auto& s = lens.prism;
  const double u = m.x, v = m.y, q = u * u + v * v, p1 = lens.tangential[0], p2 = lens.tangential[1];
  const auto [R, R_q, below] = FactorOf(lens, q);
  const double x_q = s[0] + 2 * s[1] * q, y_q = s[2] + 2 * s[3] * q;
  return {{u * R + 2 * p1 * u * v + p2 * (q + 2 * u * u) + q * (s[0] + q * s[1]),
           v * R + p1 * (q + 2 * v * v) + 2 * p2 * u * v + q * (s[2] + q * s[3])},
          R + 2 * u * u * R_q + 2 * p1 * v + 6 * p2 * u + 2 * u * x_q,
          2 * u * v * R_q + 2 * p1 * u + 2 * p2 * v + 2 * v * x_q,
          2 * u * v * R_q + 2 * p1 * u + 2 * p2 * v + 2 * u * y_q,
          R + 2 * v * v * R_q + 6 * p1 * v + 2 * p2 * u + 2 * v * y_q,
          below};
}

bool IsSymmetric(const CalibratedLens& lens) {
  const auto zero = [](double x) { return x == 0; };
  return std::ranges::all_of(lens.tangential, zero) && std::ranges::all_of(lens.prism, zero);
}

// Largest angle that a law is defined for, its own fold left aside.
double LastAngle(LensLaw law) { return law == LensLaw::kPerspective || law == LensLaw::kFieldOfView ? kAlmostRight : kPi; }

// The last angle before `good` turns false, in steps of `last` / 4096.
template <class Good>
double Scan(double last, const Good& good) {
  constexpr int kSteps = 4096;
  double before = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const double theta = last * i / kSteps;
    if (!good(theta)) {
      double low = before, high = theta;
      for (int k = 0; k < 60; ++k) (good((low + high) / 2) ? low : high) = (low + high) / 2;
      return low;
    }
    before = theta;
  }
  return last;
}

// Distance from the centre of the picture, in focal lengths, of what is theta from the axis, tangential and prism terms
// left aside.
Radius OfSymmetric(const CalibratedLens& lens, double theta) {
  const Radius law = OfLaw(lens, theta);
  const double q = law.r * law.r;
  const auto [R, R_q, below] = FactorOf(lens, q);
  return {law.r * R, (R + 2 * q * R_q) * law.slope};
}

// The most by which tangential and prism terms move a point of the plane within `rim` of its middle.
double MostPlaneShift(const CalibratedLens& lens, double rim) {
  const auto& p = lens.tangential;
  const auto& s = lens.prism;
  const double q = rim * rim;
  return q * (3 * std::hypot(p[0], p[1]) + std::hypot(s[0], s[2]) + q * std::hypot(s[1], s[3]));
}

// The point of the plane within `rim` of its middle that is distorted to m, from a guess: Newton, with steps halved
// while they do not help.
std::optional<Vec2d> Undistort(const CalibratedLens& lens, Vec2d m, Vec2d guess, double rim) {
  // Of focal lengths beyond 25,000 pixels more is needed for 1e-9 of one.
  const double enough = std::min(1e-14 * (1 + std::hypot(m.x, m.y)), 2.5e-10 / std::max(lens.fx, lens.fy));
  Vec2d at = guess;
  Distorted d = Distort(lens, at);
  double error = std::hypot(d.at.x - m.x, d.at.y - m.y);
  for (int step = 0; step < 60 && error > enough; ++step) {
    const double det = d.Determinant();
    const Vec2d off = m - d.at;
    const Vec2d move{(d.yy * off.x - d.xy * off.y) / det, (d.xx * off.y - d.yx * off.x) / det};
    double part = 1;
    bool better = false;
    for (int halving = 0; halving < 12 && !better; ++halving, part /= 2) {
      Vec2d next = at + move * part;
      if (const double r = std::hypot(next.x, next.y); r > rim) next = next * (rim / r);
      const Distorted there = Distort(lens, next);
      const double left = std::hypot(there.at.x - m.x, there.at.y - m.y);
      if (!(left < error)) continue;
      at = next, d = there, error = left, better = true;
    }
    if (!better) break;
  }
  if (!(error * std::max(lens.fx, lens.fy) <= 1e-9)) return std::nullopt;
  return at;
}

[[noreturn]] void ThrowBadLens(const std::string& what) { throw InputError("camera: " + what); }

std::string Degrees(double radians) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", radians * 180 / kPi);
  return text;
}

void CheckShape(const CalibratedLens& lens) {
  const auto& h = lens.shape;
  const auto within = [&](const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
      char text[128];
      std::snprintf(text, sizeof text, "%s %g is not in %g … %g", name, value, low, high);
      ThrowBadLens(text);
    }
  };
  switch (lens.law) {
    case LensLaw::kFieldOfView:
      return within("omega", h[0], 1e-3, 3.14);
    case LensLaw::kUnifiedSphere:
      return within("xi", h[0], 0, 100);
    case LensLaw::kDoubleSphere:
      within("xi", h[0], -1, 10);
      return within("alpha", h[1], 0, 1);
    case LensLaw::kExtendedUnified:
      within("alpha", h[0], 0, 1);
      return within("beta", h[1], 1e-6, 1e6);
    case LensLaw::kAngleToRadius:
      return within("a1 (pixels a radian in the middle)", h[0], 1e-9, 1e9);
    case LensLaw::kPerspective:
    case LensLaw::kEquidistant:
      return;
  }
}

}  // namespace

LensLimit FindLensLimit(const CalibratedLens& lens) {
  const double last = LastAngle(lens.law);
  // Spherical laws end by themselves, as their lenses do; of polynomials it is a fold.
  const bool spherical = lens.law == LensLaw::kUnifiedSphere || lens.law == LensLaw::kDoubleSphere || lens.law == LensLaw::kExtendedUnified;
  const double law = spherical ? Scan(last, [&](double theta) { return OfLaw(lens, theta).slope > 0; }) : last;
  const int azimuths = IsSymmetric(lens) ? 1 : 72;
  std::array<Vec2d, 72> along;
  for (int i = 0; i < azimuths; ++i) along[static_cast<size_t>(i)] = {std::cos(i * kPi / 36), std::sin(i * kPi / 36)};
  const auto good = [&](double theta, Vec2d a) {
    const Radius radius = OfLaw(lens, theta);
    if (!(radius.slope > 0) || !std::isfinite(radius.r)) return false;
    const Distorted d = Distort(lens, a * radius.r);
    return d.divisor > 0 && d.Determinant() > 0 && std::isfinite(d.at.x + d.at.y) && d.xx + d.yy > 0;
  };
  const auto end = along.begin() + azimuths;
  const double limit = Scan(law, [&](double theta) { return std::all_of(along.begin(), end, [&](Vec2d a) { return good(theta, a); }); });
  const auto first = std::find_if(along.begin(), end, [&](Vec2d a) { return !good(limit * (1 + 1e-12), a); });
  return {limit, limit < law, first == end ? 0 : std::atan2(first->y, first->x)};
}

std::optional<Vec2d> ProjectLens(const CalibratedLens& lens, Vec3d ray) {
  const double theta = std::atan2(std::hypot(ray.x, ray.y), ray.z);
  if (!(theta <= lens.max_theta * (1 + 1e-15))) return std::nullopt;
  return ProjectBeyond(lens, ray);
}

std::optional<Vec3d> LensRay(const CalibratedLens& lens, Vec2d pixel) {
  const Vec2d m{(pixel.x - lens.cx) / lens.fx, (pixel.y - lens.cy) / lens.fy};
  const double r = std::hypot(m.x, m.y);
  const auto radius = [&](double theta) { return OfSymmetric(lens, theta); };
  const bool symmetric = IsSymmetric(lens);
  const double last = radius(lens.max_theta).r, rim = OfLaw(lens, lens.max_theta).r;
  if (!(r <= (last + MostPlaneShift(lens, rim)) * (1 + 1e-15))) return std::nullopt;
  double theta = r >= last ? lens.max_theta : Solve(radius, r, std::atan(r), lens.max_theta);
  Vec2d along = r > 0 ? m * (1 / r) : Vec2d{1, 0};
  if (!symmetric) {
    const auto at = Undistort(lens, m, along * OfLaw(lens, theta).r, rim);
    if (!at) return std::nullopt;
    const double straight = std::hypot(at->x, at->y);
    if (straight > 0) along = *at * (1 / straight);
    theta = straight >= rim ? lens.max_theta : Solve([&](double x) { return OfLaw(lens, x); }, straight, theta, lens.max_theta);
  }
  return Vec3d{std::sin(theta) * along.x, std::sin(theta) * along.y, std::cos(theta)};
}

bool FillsPicture(const CalibratedLens& lens) {
  const auto sees = [&](int x, int y) { return LensRay(lens, {static_cast<double>(x), static_cast<double>(y)}).has_value(); };
  for (int x = 0; x <= lens.width; ++x) {
    if (!sees(x, 0) || !sees(x, lens.height)) return false;
  }
  for (int y = 0; y <= lens.height; ++y) {
    if (!sees(0, y) || !sees(lens.width, y)) return false;
  }
  return true;
}

void CheckLens(const CalibratedLens& lens) {
  const auto finite = [](double x) { return std::isfinite(x) && std::abs(x) < 1e30; };
  if (!std::ranges::all_of(lens.shape, finite) || !std::ranges::all_of(lens.radial, finite) || !std::ranges::all_of(lens.divisor, finite) ||
      !std::ranges::all_of(lens.tangential, finite) || !std::ranges::all_of(lens.prism, finite))
    ThrowBadLens("coefficients of a lens must be finite");
  CheckShape(lens);
  const LensLimit limit = FindLensLimit(lens);
  if (!(lens.max_theta > 0 && lens.max_theta <= limit.theta)) {
    ThrowBadLens(std::string(limit.folds ? "the lens folds over" : "the lens ends") + " " + Degrees(limit.theta) +
                 " degrees from its axis, before the edge of its field at " + Degrees(lens.max_theta) + " degrees");
  }
}

}  // namespace airsim360::internal

namespace airsim360 {

Vec2d ProjectBeyond(const CalibratedLens& lens, Vec3d ray) {
  const double across = std::hypot(ray.x, ray.y), theta = std::min(std::atan2(across, ray.z), lens.max_theta);
  // Straight back there is no direction to go from the centre; +x is as good as any.
  const double r = internal::OfLaw(lens, theta).r;
  const Vec2d m = across > 0 ? Vec2d{r * ray.x / across, r * ray.y / across} : Vec2d{r, 0};
  const Vec2d at = internal::Distort(lens, m).at;
  return {lens.fx * at.x + lens.cx, lens.fy * at.y + lens.cy};
}

}  // namespace airsim360
