#include "airsim360/planning/export/export_crazyflie.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/planning/splines/taylor.h"

namespace airsim360 {
namespace {

constexpr int kPiecePowers = 8, kColumns = 33;
constexpr int kChecks = 64;  // times a row at which its error is measured
constexpr int kMaxHalvings = 12, kMaxYawHalvings = 4;
constexpr double kYawTolerance = 0.5 * std::numbers::pi / 180;
constexpr size_t kMaxRows = 100'000;

// Coefficients of one segment about local time `from`, padded to degree 7.
struct Piece {
  double c[3][kPiecePowers] = {};
  double duration = 0;
};

Piece PieceOf(const PolynomialTrajectory& path, size_t segment, double from, double duration) {
  Piece piece;
  piece.duration = duration;
  for (int axis = 0; axis < 3; ++axis) {
    const auto c = path.coefficients(segment, axis);
    std::copy(c.begin(), c.end(), piece.c[axis]);
    ShiftPolynomial(piece.c[axis], from);
  }
  return piece;
}

template <class Number>
Number Horner(const Number* c, Number t) {
  Number sum = 0;
  for (int i = kPiecePowers; i-- > 0;) sum = sum * t + c[i];
  return sum;
}

Poly4d Rounded(const Piece& piece, const std::array<double, kPiecePowers>& yaw) {
  Poly4d row;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < kPiecePowers; ++i) row.p[axis][i] = static_cast<float>(piece.c[axis][i]);
  }
  for (int i = 0; i < kPiecePowers; ++i) row.p[3][i] = static_cast<float>(yaw[static_cast<size_t>(i)]);
  row.duration = static_cast<float>(piece.duration);
  return row;
}

double ErrorOf(const Poly4d& row, const Piece& piece) {
  double worst = 0;
  for (int k = 0; k <= kChecks; ++k) {
    const double t = piece.duration * k / kChecks;
    Vec3d error;
    for (int axis = 0; axis < 3; ++axis) error[axis] = Horner(row.p[axis], static_cast<float>(t)) - Horner(piece.c[axis], t);
    worst = std::max(worst, Norm(error));
  }
  return worst;
}

double YawErrorOf(const Poly4d& row, const YawProfile& yaw, double from) {
  if (yaw.is_constant()) return 0;
  double worst = 0;
  for (int k = 0; k <= kChecks; ++k) {
    const double t = static_cast<double>(row.duration) * k / kChecks;
    const double error = Horner(row.p[3], static_cast<float>(t)) - yaw.At(from + t);
    worst = std::max(worst, std::fabs(std::remainder(error, 2 * std::numbers::pi)));
  }
  return worst;
}

}  // namespace

Vec3d EvaluatePoly4d(std::span<const Poly4d> rows, double t) {
  size_t i = 0;
  for (; i + 1 < rows.size() && t > rows[i].duration; ++i) t -= rows[i].duration;
  const float local = static_cast<float>(std::min<double>(t, rows[i].duration));
  return {Horner(rows[i].p[0], local), Horner(rows[i].p[1], local), Horner(rows[i].p[2], local)};
}

Poly4dRows ToPoly4d(const PolynomialTrajectory& path, const YawRule& rule, double tolerance) {
  Poly4dRows out;
  const YawProfile yaw(path, rule);
  double last_yaw = yaw.At(0);
  for (size_t s = 0; s < path.segments(); ++s) {
    for (int halvings = 0;; ++halvings) {
      const int parts = 1 << halvings;
      const double duration = path.durations()[s] / parts;
      std::vector<Poly4d> rows;
      double worst = 0, worst_yaw = 0, end_yaw = last_yaw;
      for (int k = 0; k < parts; ++k) {
        const Piece piece = PieceOf(path, s, k * duration, duration);
        const double from = path.start(s) + k * duration;
        rows.push_back(Rounded(piece, yaw.Powers(from, duration, end_yaw)));
        end_yaw = Horner(rows.back().p[3], rows.back().duration);
        worst = std::max(worst, ErrorOf(rows.back(), piece));
        worst_yaw = std::max(worst_yaw, YawErrorOf(rows.back(), yaw, from));
      }
      if (worst > tolerance / 2 && halvings < kMaxHalvings) continue;
      if (worst_yaw > kYawTolerance && halvings < kMaxYawHalvings) continue;
      last_yaw = end_yaw;
      out.worst_yaw_error = std::max(out.worst_yaw_error, worst_yaw);
      out.rows.insert(out.rows.end(), rows.begin(), rows.end());
      out.worst_error = std::max(out.worst_error, worst);
      break;
    }
  }
  return out;
}

std::string Poly4dCsv(std::span<const Poly4d> rows) {
  std::string out = "duration";
  for (const char* name : {"x", "y", "z", "yaw"}) {
    for (int i = 0; i < kPiecePowers; ++i) out += std::string(",") + name + "^" + std::to_string(i);
  }
  out += '\n';
  char text[32];
  for (const Poly4d& row : rows) {
    std::snprintf(text, sizeof(text), "%.9g", row.duration);
    out += text;
    for (const auto& axis : row.p) {
      for (const float c : axis) {
        std::snprintf(text, sizeof(text), ",%.9g", c == 0 ? 0.0 : c);
        out += text;
      }
    }
    out += '\n';
  }
  return out;
}

std::vector<Poly4d> ParsePoly4dCsv(std::string_view text, std::string_view name) {
  std::vector<Poly4d> rows;
  for (size_t line = 1; !text.empty(); ++line) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view row_text = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line == 1 || row_text.empty()) continue;  // the header
    const auto fail = [&](size_t column, const std::string& what) -> void {
      throw InputError(std::string(name) + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + what);
    };
    float values[kColumns];
    size_t at = 0;
    for (int i = 0; i < kColumns; ++i) {
      if (i > 0 && (at >= row_text.size() || row_text[at++] != ',')) fail(at, std::to_string(kColumns) + " numbers are needed");
      const auto [stop, error] = std::from_chars(row_text.data() + at, row_text.data() + row_text.size(), values[i]);
      if (error != std::errc() || !std::isfinite(values[i])) fail(at + 1, "not a finite number");
      at = static_cast<size_t>(stop - row_text.data());
    }
    if (at < row_text.size() && row_text[at] != '\r') fail(at + 1, "more than 33 numbers");
    if (!(values[0] > 0)) fail(1, "a duration must be positive");
    if (rows.size() == kMaxRows) fail(1, "more than " + std::to_string(kMaxRows) + " rows");
    Poly4d row;
    row.duration = values[0];
    std::copy(values + 1, values + kColumns, &row.p[0][0]);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace airsim360
