#include "airsim360/flight/control/attitude.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace airsim360::internal {

double HeadingOf(const Mat3d& R_WB) { return std::atan2(R_WB.m[1][0], R_WB.m[0][0]); }

double WrapAngle(double angle) { return angle - 2 * std::numbers::pi * std::floor(angle / (2 * std::numbers::pi) + 0.5); }

RollPitch RollPitchOf(const Mat3d& R_WB) {
  return {std::atan2(R_WB.m[2][1], R_WB.m[2][2]), std::asin(std::clamp(R_WB.m[2][0], -1.0, 1.0))};
}

Mat3d AttitudeFor(Vec3d up, double yaw) {
  const Vec3d z = Normalized(up);
  // The forward axis has no part along the heading's left axis.
  const Vec3d left{-std::sin(yaw), std::cos(yaw), 0};
  Vec3d x = Cross(left, z);
  // Thrust along the left axis: any forward axis across it has that heading or its opposite.
  if (Dot(x, x) < 1e-12) x = {left.y, -left.x, 0};
  x = Normalized(x);
  return Mat3d::FromColumns(x, Cross(z, x), z);
}

Vec3d AttitudeError(const Mat3d& R_WB, const Mat3d& wanted) {
  // The wanted thrust axis seen from the body.
  const Mat3d to_body = R_WB.transpose();
  const Vec3d z = to_body * wanted.column(2);
  const double sine = std::hypot(z.x, z.y);
  const double angle = std::atan2(sine, z.z);
  // Upside down any axis serves: roll.
  const Vec3d axis = sine > 1e-9 ? Vec3d{-z.y / sine, z.x / sine, 0} : Vec3d{1, 0, 0};

  // The body's forward axis after that turn (Rodrigues), against the wanted one about the common thrust axis.
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec3d turned = Vec3d{c, 0, 0} + Cross(axis, Vec3d{1, 0, 0}) * s + axis * (axis.x * (1 - c));
  const Vec3d forward = to_body * wanted.column(0);
  const double yaw = std::atan2(Dot(z, Cross(turned, forward)), Dot(turned, forward));
  return axis * angle + Vec3d{0, 0, yaw};
}

FlatRates RatesOf(const Mat3d& attitude, double force, Vec3d f1, Vec3d f2, double yaw, double yaw_rate) {
  const Vec3d x = attitude.column(0), y = attitude.column(1), z = attitude.column(2);
  const double f = std::max(force, 1e-3);
  // z' = (f1 - (f1.z) z) / f and z'' from f2; the turn of z is w x z.
  const double along = Dot(f1, z);
  const Vec3d dz = (f1 - z * along) / f;
  const Vec3d ddz = (f2 - z * Dot(f2, z) - dz * (2 * along)) / f;
  FlatRates rates;
  rates.w = {-Dot(dz, y), Dot(dz, x), 0};
  rates.alpha = {-Dot(ddz, y), Dot(ddz, x), 0};
  // Heading: the forward axis keeps no part along the turning left axis of the heading.
  const Vec3d forward{std::cos(yaw), std::sin(yaw), 0}, left{-forward.y, forward.x, 0};
  const double y_part = Dot(left, y);
  if (std::abs(y_part) > 0.05) {
    rates.w.z = (Dot(left, z) * rates.w.y + yaw_rate * Dot(forward, x)) / y_part;
  }
  // In the turning frame z'' has the terms of w itself: (w_z w_y, -w_z w_x).
  rates.alpha.x += rates.w.y * rates.w.z;
  rates.alpha.y -= rates.w.x * rates.w.z;
  return rates;
}

}  // namespace airsim360::internal
