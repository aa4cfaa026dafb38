// The WGS 84 ellipsoid: geodetic coordinates, Earth-centred Cartesian ones, and the local east-north-up
// frame.
#pragma once

#include "airsim360/math/transform.h"

namespace airsim360 {

/// A place over the ellipsoid. Altitude is the height over it, metres.
struct GeoPoint {
  double latitude_deg = 0, longitude_deg = 0, altitude = 0;
};

inline constexpr double kWgs84Axis = 6378137.0;                ///< semi-major axis, metres (defined)
inline constexpr double kWgs84Flattening = 1 / 298.257223563;  ///< (defined)

/// Earth-centred, Earth-fixed coordinates: +X through latitude 0, longitude 0; +Z through the north pole.
Vec3d EcefFromGeodetic(const GeoPoint& point);
/// The inverse in closed form (H. Vermeille, Direct transformation from geocentric to geodetic coordinates,
/// J. Geodesy 76, 2002), for points farther than 43 km from the centre of the Earth; longitude in [-180,
/// 180].
GeoPoint GeodeticFromEcef(Vec3d p);

/// The world frame W (east, north, up) placed at a point of the Earth. Flat: altitude grows with the square
/// of the distance along the tangent plane (8 cm at 1 km).
class GeoFrame {
 public:
  explicit GeoFrame(const GeoPoint& origin);
  const GeoPoint& origin() const { return origin_; }
  GeoPoint ToGeodetic(Vec3d p_W) const;
  Vec3d ToWorld(const GeoPoint& point) const;

 private:
  GeoPoint origin_;
  RigidTransform X_EW_;  // E: Earth-centred
};

}  // namespace airsim360
