// Trajectories for the Crazyflie: poly4d rows (CSV of uav_trajectories) and the compressed form of its
// firmware. Formats: docs/guide/planning.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/planning/yaw_profile.h"

namespace airsim360 {

/// One row: x, y, z, yaw in ascending powers of local time, degree 7, single precision as in the firmware.
struct Poly4d {
  float p[4][8] = {};
  float duration = 0;
};

/// Position of row after row at time t of the flight, evaluated in single precision as the firmware does.
Vec3d EvaluatePoly4d(std::span<const Poly4d> rows, double t);

/// Rows of a trajectory. Pieces whose evaluation in single precision is off by more than half of `tolerance`
/// metres, or whose heading by more than half a degree, are halved until it is not. `worst_error`: the largest
/// found, metres, at 64 times a row; `worst_yaw_error` likewise, radians (sudden turns cannot be met).
struct Poly4dRows {
  std::vector<Poly4d> rows;
  double worst_error = 0, worst_yaw_error = 0;
};
Poly4dRows ToPoly4d(const PolynomialTrajectory& trajectory, const YawRule& yaw, double tolerance = 1e-3);

/// `duration,x^0,…,x^7,y^0,…,yaw^7` with a header, nine digits a number.
std::string Poly4dCsv(std::span<const Poly4d> rows);
/// Reads it back. InputError "name:line:column: …" for anything else.
std::vector<Poly4d> ParsePoly4dCsv(std::string_view text, std::string_view name);

/// The compressed form, little endian: start x, y, z (int16 mm) and yaw (int16 tenths of a degree), then for
/// each piece a byte of types (two bits each: constant, line, cubic, degree 7), uint16 milliseconds, and the
/// Bezier control points after the first (int16). Pieces are cut at whole milliseconds, so that times are
/// exact. Positions are relative to `origin`. InputError if one is farther than 32.767 m from it.
std::vector<uint8_t> CompressTrajectory(const PolynomialTrajectory& trajectory, const YawRule& yaw, Vec3d origin);
/// What a firmware flies: position (m, relative to the origin) and yaw (radians) at time t.
struct CompressedPoint {
  Vec3d p;
  double yaw = 0;
};
class CompressedTrajectory {
 public:
  /// InputError for bytes that end early or have anything left over.
  explicit CompressedTrajectory(std::span<const uint8_t> bytes);
  double duration() const;
  CompressedPoint At(double t) const;

 private:
  struct Piece {
    double duration;
    std::vector<double> points[4];  // Bezier control points, metres or radians
  };
  std::vector<Piece> pieces_;
};

}  // namespace airsim360
