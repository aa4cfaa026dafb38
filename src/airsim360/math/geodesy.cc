#include "airsim360/math/geodesy.h"

#include <cmath>

#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

constexpr double kE2 = kWgs84Flattening * (2 - kWgs84Flattening);  // first eccentricity squared

}  // namespace

Vec3d EcefFromGeodetic(const GeoPoint& point) {
  const double latitude = point.latitude_deg * kDegree, longitude = point.longitude_deg * kDegree;
  const double s = std::sin(latitude), c = std::cos(latitude);
  const double prime_vertical = kWgs84Axis / std::sqrt(1 - kE2 * s * s);
  const double across = (prime_vertical + point.altitude) * c;
  return {across * std::cos(longitude), across * std::sin(longitude), (prime_vertical * (1 - kE2) + point.altitude) * s};
}

GeoPoint GeodeticFromEcef(Vec3d p) {
  constexpr double kE4 = kE2 * kE2, kAxis2 = kWgs84Axis * kWgs84Axis;
  const double across2 = p.x * p.x + p.y * p.y;
  // Vermeille's names; the cubic of the problem has one real root, u.
  const double P = across2 / kAxis2, q = (1 - kE2) / kAxis2 * p.z * p.z;
  const double r = (P + q - kE4) / 6;
  const double s = kE4 * P * q / (4 * r * r * r);
  const double t = std::cbrt(1 + s + std::sqrt(s * (2 + s)));
  const double u = r * (1 + t + 1 / t);
  const double v = std::sqrt(u * u + kE4 * q);
  const double w = kE2 * (u + v - q) / (2 * v);
  const double k = std::sqrt(u + v + w * w) - w;
  const double D = k * std::sqrt(across2) / (k + kE2), length = std::hypot(D, p.z);
  return {2 * std::atan2(p.z, D + length) / kDegree, std::atan2(p.y, p.x) / kDegree, (k + kE2 - 1) / k * length};
}

GeoFrame::GeoFrame(const GeoPoint& origin) : origin_(origin) {
  const double latitude = origin.latitude_deg * kDegree, longitude = origin.longitude_deg * kDegree;
  const double sp = std::sin(latitude), cp = std::cos(latitude);
  const double sl = std::sin(longitude), cl = std::cos(longitude);
  X_EW_.R = Mat3d::FromColumns({-sl, cl, 0}, {-sp * cl, -sp * sl, cp}, {cp * cl, cp * sl, sp});
  X_EW_.p = EcefFromGeodetic(origin);
}

GeoPoint GeoFrame::ToGeodetic(Vec3d p_W) const { return GeodeticFromEcef(X_EW_ * p_W); }
Vec3d GeoFrame::ToWorld(const GeoPoint& point) const { return X_EW_.inverse() * EcefFromGeodetic(point); }

}  // namespace airsim360
