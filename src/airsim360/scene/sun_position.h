// Where the sun stands over a place at a time.
#pragma once

#include <string_view>

namespace airsim360 {

/// A moment, in universal time.
struct UtcTime {
  int year = 2000, month = 1, day = 1;
  double hours = 12;  ///< since midnight; may lie outside of 0 … 24
};

/// "2026-06-21T14:30", with ":SS" and an offset "+02:00", "-07:00" or "Z" if wanted (none = UTC). InputError
/// naming the text for anything else; years 1800 … 2200.
UtcTime ParseTime(std::string_view text);

/// "52.5,13.4": degrees north and east. InputError naming the text.
struct GeoPlace {
  double latitude_deg = 0, longitude_deg = 0;
};
GeoPlace ParsePlace(std::string_view text);

struct SunAngles {
  double azimuth_deg;    ///< clockwise from north, [0, 360)
  double elevation_deg;  ///< as seen: lifted by refraction (Saemundsson, 1010 hPa, 10 degrees C)
};

/// After Meeus, Astronomical Algorithms (1998), chapter 25 (low accuracy), with the parallax of 8.8"; error
/// below 0.02 degrees for 1800 … 2200 above a degree of elevation.
SunAngles SunPosition(const UtcTime& time, const GeoPlace& place);

}  // namespace airsim360
