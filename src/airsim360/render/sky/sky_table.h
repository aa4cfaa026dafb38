// Pictures of all directions.
#pragma once

#include <vector>

#include "airsim360/base/table_vector.h"
#include "airsim360/math/vector.h"

namespace airsim360::internal {

/// A lat-long picture of directions: row r holds elevations from `SkyTable::ElevationOfRow`; texels are r, g,
/// b, unused. Column i is azimuth (i + 0.5) * 2 pi / width from +X towards +Y; one more column repeats the
/// first, so that bilinear look-up never wraps. The last row is the zenith.
struct SkyTable {
  int width = 0, height = 0;
  bool full_sphere = false;  ///< rows from nadir to zenith, linear in elevation; else from the horizon up, finer near it
  TableVector<float> texels;

  int stride() const { return width + 1; }
  float ElevationOfRow(int row) const;
  Vec3f Texel(int x, int y) const;
  void SetTexel(int x, int y, Vec3f c);
  /// Bilinear; below its lowest row the table repeats it.
  Vec3f At(Vec3f direction) const;

  /// All fields, for the disk cache; the same in other classes of the sky.
  template <class Archive, class Self>
  static void Visit(Archive& archive, Self& s) {
    archive(s.width, s.height, s.full_sphere, s.texels);
  }
};

/// Elevation of the upper-hemisphere tables, as a share e of pi/2, is kSkyRowSlope * t + (1 - kSkyRowSlope) *
/// t^2 of the row t.
inline constexpr float kSkyRowSlope = 0.6f;

/// Unit vector of azimuth and elevation, radians.
Vec3f DirectionOf(float azimuth, float elevation);
/// Direction of a texel's centre.
Vec3f DirectionOfTexel(const SkyTable& table, int x, int y);
/// A black table.
SkyTable MakeTable(int width, int height, bool full_sphere);
/// Solid angle of one texel of a row: rows end half-way to their neighbours.
float RowSolidAngle(const SkyTable& table, int y);

}  // namespace airsim360::internal
