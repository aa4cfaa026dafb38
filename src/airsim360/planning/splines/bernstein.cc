#include "airsim360/planning/splines/bernstein.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace airsim360::internal {
namespace {

using BinomialTable = std::array<std::array<double, Bernstein::kMaxDegree + 1>, Bernstein::kMaxDegree + 1>;

constexpr BinomialTable MakeBinomials() {
  BinomialTable c = {};
  for (size_t n = 0; n < c.size(); ++n) {
    c[n][0] = 1;
    for (size_t k = 1; k <= n; ++k) c[n][k] = c[n - 1][k - 1] + (k < n ? c[n - 1][k] : 0);
  }
  return c;
}

constexpr BinomialTable kBinomials = MakeBinomials();

double Binomial(int n, int k) { return kBinomials[static_cast<size_t>(n)][static_cast<size_t>(k)]; }

template <class Operation>
Bernstein Combine(const Bernstein& a, const Bernstein& b, Operation operation) {
  Bernstein out = a;
  for (int i = 0; i <= a.degree; ++i) out.control[i] = operation(a.control[i], b.control[i]);
  return out;
}

/// A stationary point inside (0, 1) when the control polygon rises and then falls; else 0.5.
double SplitPoint(const Bernstein& p) {
  const auto begin = p.control.begin(), end = begin + p.degree + 1;
  const auto top = std::max_element(begin, end);
  if (top == begin || top == end - 1 || !std::is_sorted(begin, top + 1) || !std::is_sorted(top, end, std::greater<>())) {
    return 0.5;
  }
  // Newton's method on the derivative, kept inside the bracket of its sign change.
  Bernstein slope;
  slope.degree = p.degree - 1;
  for (int i = 0; i < p.degree; ++i) slope.control[i] = p.control[i + 1] - p.control[i];
  Bernstein curve;
  curve.degree = p.degree - 2;
  for (int i = 0; i + 1 < p.degree; ++i) {
    curve.control[i] = (p.degree - 1) * (slope.control[i + 1] - slope.control[i]);
  }
  double low = 0, high = 1, x = static_cast<double>(top - begin) / p.degree;
  for (int i = 0; i < 20; ++i) {
    const double s = slope.At(x);
    (s > 0 ? low : high) = x;
    const double step = s / curve.At(x), next = x - step;
    const bool inside = next > low && next < high;
    const double previous = x;
    x = inside ? next : 0.5 * (low + high);
    if (inside && std::abs(x - previous) < 1e-9) break;
  }
  return std::clamp(x, 1e-3, 1 - 1e-3);
}

}  // namespace

Bernstein Bernstein::FromPowers(const double* c, int degree) {
  Bernstein out;
  out.degree = degree;
  for (int i = 0; i <= degree; ++i) {
    for (int k = 0; k <= i; ++k) out.control[i] += Binomial(i, k) / Binomial(degree, k) * c[k];
  }
  return out;
}

double Bernstein::At(double tau) const {
  std::array<double, kMaxDegree + 1> b = control;
  for (int n = degree; n > 0; --n) {
    for (int i = 0; i < n; ++i) b[i] += tau * (b[i + 1] - b[i]);
  }
  return b[0];
}

double Bernstein::Largest() const { return *std::max_element(control.begin(), control.begin() + degree + 1); }

void Bernstein::Split(double at, Bernstein& left, Bernstein& right) const {
  Bernstein b = *this;
  left.degree = right.degree = degree;
  for (int n = degree; n >= 0; --n) {
    left.control[degree - n] = b.control[0];
    right.control[n] = b.control[n];
    for (int i = 0; i < n; ++i) b.control[i] += at * (b.control[i + 1] - b.control[i]);
  }
}

Bernstein operator+(const Bernstein& a, const Bernstein& b) {
  return Combine(a, b, [](double x, double y) { return x + y; });
}

Bernstein operator-(const Bernstein& a, const Bernstein& b) {
  return Combine(a, b, [](double x, double y) { return x - y; });
}

Bernstein operator*(const Bernstein& a, const Bernstein& b) {
  Bernstein out;
  out.degree = a.degree + b.degree;
  for (int i = 0; i <= a.degree; ++i) {
    for (int j = 0; j <= b.degree; ++j) {
      out.control[i + j] += Binomial(a.degree, i) * a.control[i] * (Binomial(b.degree, j) * b.control[j]);
    }
  }
  for (int k = 0; k <= out.degree; ++k) out.control[k] /= Binomial(out.degree, k);
  return out;
}

Bernstein operator*(const Bernstein& a, double factor) {
  Bernstein out = a;
  for (double& value : out.control) value *= factor;
  return out;
}

Bernstein Shifted(const Bernstein& a, double constant) {
  Bernstein out = a;
  for (int i = 0; i <= a.degree; ++i) out.control[i] += constant;
  return out;
}

double RaiseMaximum(const Bernstein& polynomial, double tolerance, double& floor, double& at) {
  struct Part {
    Bernstein polynomial;
    double from, length;
  };
  double bound = floor;
  const auto look_at_ends = [&](const Part& part) {
    const double ends[2] = {part.polynomial.control[0], part.polynomial.control[part.polynomial.degree]};
    for (int side = 0; side < 2; ++side) {
      if (ends[side] > floor) {
        floor = ends[side];
        at = part.from + side * part.length;
      }
    }
  };
  std::vector<Part> open = {{polynomial, 0, 1}};
  look_at_ends(open[0]);
  while (!open.empty()) {
    const Part part = open.back();
    open.pop_back();
    const double largest = part.polynomial.Largest();
    // A part too short to hold another floating-point number is as good as a point.
    if (largest <= floor + tolerance || part.length < 1e-15) {
      bound = std::max(bound, std::min(largest, floor + tolerance));
      continue;
    }
    const double split = SplitPoint(part.polynomial);
    Part left = {{}, part.from, part.length * split};
    Part right = {{}, part.from + part.length * split, part.length * (1 - split)};
    part.polynomial.Split(split, left.polynomial, right.polynomial);
    look_at_ends(left);
    look_at_ends(right);
    open.push_back(left);
    open.push_back(right);
  }
  return std::max(bound, floor);
}

}  // namespace airsim360::internal
