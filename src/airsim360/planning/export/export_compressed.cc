// The compressed form of Crazyflie trajectories.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/base/error.h"
#include "airsim360/planning/export/export_crazyflie.h"
#include "airsim360/planning/splines/taylor.h"

namespace airsim360 {
namespace {

constexpr int kPowers = 8;
constexpr double kPositionUnit = 1e-3, kYawUnit = std::numbers::pi / 1800;  // millimetres, tenths of a degree
constexpr int64_t kLongestPiece = 60'000;                                   // ms; a uint16 holds 65,535
constexpr int kPoints[4] = {0, 1, 3, 7};                                    // control points after the first, by type
enum Type : uint8_t { kConstant = 0, kDegree7 = 3 };

double BinomialCoefficient(int n, int k) {
  double b = 1;
  for (int i = 0; i < k; ++i) b = b * (n - i) / (i + 1);
  return b;
}

// Bezier control points of ascending powers over [0, duration].
void ToBezier(const double (&c)[kPowers], double duration, double (&points)[kPowers]) {
  constexpr int n = kPowers - 1;
  for (int i = 0; i <= n; ++i) {
    points[i] = 0;
    for (int k = 0; k <= i; ++k) points[i] += c[k] * std::pow(duration, k) * BinomialCoefficient(i, k) / BinomialCoefficient(n, k);
  }
}

void Append16(std::vector<uint8_t>& out, int64_t value) {
  out.push_back(static_cast<uint8_t>(value & 255));
  out.push_back(static_cast<uint8_t>((value >> 8) & 255));
}

int64_t Quantized(double value, double unit) {
  const double steps = std::round(value / unit);
  if (!(std::fabs(steps) <= 32767)) {
    if (unit == kYawUnit) throw InputError("Crazyflie compressed: the heading turns more than nine times");
    throw InputError("Crazyflie compressed: a coordinate of " + std::to_string(value) +
                     " m is beyond the ±32.767 m that this form can hold; use the format 'crazyflie'");
  }
  return static_cast<int64_t>(steps);
}

// Whole milliseconds at which pieces begin and end, and the segment that each piece is of.
struct Cut {
  int64_t from, to;
  size_t segment;
};
std::vector<Cut> Cuts(const PolynomialTrajectory& path) {
  std::vector<Cut> cuts;
  int64_t from = 0;
  for (size_t s = 0; s < path.segments(); ++s) {
    const int64_t end = std::llround((path.start(s) + path.durations()[s]) * 1000);
    while (from < end) {
      const int64_t to = end - from > kLongestPiece ? from + kLongestPiece : end;
      cuts.push_back({from, to, s});
      from = to;
    }
  }
  return cuts;
}

}  // namespace

std::vector<uint8_t> CompressTrajectory(const PolynomialTrajectory& path, const YawRule& rule, Vec3d origin) {
  const YawProfile yaw(path, rule);
  std::vector<uint8_t> out;
  const Vec3d start = path.At(0).p - origin;
  for (int axis = 0; axis < 3; ++axis) Append16(out, Quantized(start[axis], kPositionUnit));
  double last_yaw = std::remainder(yaw.At(0), 2 * std::numbers::pi);
  Append16(out, Quantized(last_yaw, kYawUnit));
  for (const Cut& cut : Cuts(path)) {
    // A segment goes on beyond its end by less than a millisecond, where its neighbour is the same to the
    // power of the continuity.
    const double shift = static_cast<double>(cut.from) * 1e-3 - path.start(cut.segment);
    const double duration = static_cast<double>(cut.to - cut.from) * 1e-3;
    uint8_t types = 0;
    std::vector<uint8_t> body;
    for (int axis = 0; axis < 3; ++axis) {
      double c[kPowers] = {}, points[kPowers];
      const auto from = path.coefficients(cut.segment, axis);
      std::copy(from.begin(), from.end(), c);
      ShiftPolynomial(c, shift);
      ToBezier(c, duration, points);
      const bool constant = std::all_of(points, points + kPowers, [&](double p) {
        return Quantized(p - origin[axis], kPositionUnit) == Quantized(points[0] - origin[axis], kPositionUnit);
      });
      types |= static_cast<uint8_t>((constant ? kConstant : kDegree7) << (2 * axis));
      for (int i = 1; !constant && i < kPowers; ++i) Append16(body, Quantized(points[i] - origin[axis], kPositionUnit));
    }
    if (!yaw.is_constant()) {
      const std::array<double, kPowers> powers = yaw.Powers(static_cast<double>(cut.from) * 1e-3, duration, last_yaw);
      double c[kPowers], points[kPowers];
      std::copy(powers.begin(), powers.end(), c);
      ToBezier(c, duration, points);
      types |= static_cast<uint8_t>(kDegree7 << 6);
      for (int i = 1; i < kPowers; ++i) Append16(body, Quantized(points[i], kYawUnit));
      last_yaw = points[kPowers - 1];
    }
    out.push_back(types);
    Append16(out, cut.to - cut.from);
    out.insert(out.end(), body.begin(), body.end());
  }
  return out;
}

CompressedTrajectory::CompressedTrajectory(std::span<const uint8_t> bytes) {
  size_t at = 0;
  const auto byte = [&] {
    if (at >= bytes.size()) throw InputError("compressed trajectory: it ends in the middle of a piece");
    return bytes[at++];
  };
  const auto u16 = [&] {
    const uint32_t low = byte();
    return low | static_cast<uint32_t>(byte()) << 8;
  };
  double last[4];
  const auto read = [&](int axis) {
    const auto value = static_cast<int16_t>(u16());
    return value * (axis == 3 ? kYawUnit : kPositionUnit);
  };
  for (int axis = 0; axis < 4; ++axis) last[axis] = read(axis);
  while (at < bytes.size()) {
    Piece piece;
    const uint8_t types = byte();
    piece.duration = u16() * 1e-3;
    for (int axis = 0; axis < 4; ++axis) {
      piece.points[axis] = {last[axis]};
      for (int i = 0; i < kPoints[(types >> (2 * axis)) & 3]; ++i) piece.points[axis].push_back(read(axis));
      last[axis] = piece.points[axis].back();
    }
    pieces_.push_back(std::move(piece));
  }
  if (pieces_.empty()) throw InputError("compressed trajectory: no pieces");
}

double CompressedTrajectory::duration() const {
  double sum = 0;
  for (const Piece& piece : pieces_) sum += piece.duration;
  return sum;
}

CompressedPoint CompressedTrajectory::At(double t) const {
  size_t i = 0;
  for (; i + 1 < pieces_.size() && t > pieces_[i].duration; ++i) t -= pieces_[i].duration;
  const Piece& piece = pieces_[i];
  const double s = piece.duration > 0 ? std::clamp(t / piece.duration, 0.0, 1.0) : 0;
  double values[4];
  for (int axis = 0; axis < 4; ++axis) {
    std::vector<double> p = piece.points[axis];  // de Casteljau
    for (size_t n = p.size(); n-- > 1;) {
      for (size_t k = 0; k < n; ++k) p[k] += s * (p[k + 1] - p[k]);
    }
    values[axis] = p[0];
  }
  return {{values[0], values[1], values[2]}, values[3]};
}

}  // namespace airsim360
