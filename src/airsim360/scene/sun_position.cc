#include "airsim360/scene/sun_position.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "airsim360/base/error.h"
#include "airsim360/math/angles.h"

namespace airsim360 {
namespace {

double Turn(double degrees) { return degrees - 360 * std::floor(degrees / 360); }

// Reads digits and marks one after the other.
class TimeReader {
 public:
  explicit TimeReader(std::string_view text) : all_(text), rest_(text) {}
  [[noreturn]] void Fail() const { throw InputError("time '" + std::string(all_) + "' is not like 2026-06-21T14:30+02:00"); }
  [[noreturn]] void FailAt(int value, int low, int high) const {
    throw InputError("time '" + std::string(all_) + "': " + std::to_string(value) + " is not in " + std::to_string(low) + " … " +
                     std::to_string(high));
  }
  int Digits(size_t count, int low, int high) {
    int value = 0;
    const char* end = rest_.data() + std::min(count, rest_.size());
    const auto [at, error] = std::from_chars(rest_.data(), end, value);
    if (rest_.size() < count || error != std::errc() || at != end || rest_[0] == '-') Fail();
    if (value < low || value > high) FailAt(value, low, high);
    rest_.remove_prefix(count);
    return value;
  }
  bool Take(char mark) {
    if (rest_.empty() || rest_[0] != mark) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void Need(char mark) {
    if (!Take(mark)) Fail();
  }
  bool done() const { return rest_.empty(); }

 private:
  std::string_view all_, rest_;
};

int DaysOfMonth(int year, int month) {
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return kDays[month - 1] + (month == 2 && leap ? 1 : 0);
}

// Meeus 7.1, Gregorian.
double JulianDay(const UtcTime& time) {
  int year = time.year, month = time.month;
  if (month <= 2) --year, month += 12;
  const int century = year / 100;
  return std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) + time.day + 2 - century + century / 4 - 1524.5 +
         time.hours / 24;
}

// Seconds that Earth's turning has lost (Espenak & Meeus 2006, piecewise; a minute matters 0.0007 degrees).
double DeltaT(double year) { return year < 1900 ? 10 : year < 1990 ? 0.6 * (year - 1900) : 60 + 0.4 * (year - 1995); }

// Degrees by which the air lifts what stands at this true elevation: Saemundsson (Meeus 16.4); below the
// horizon the curve of NOAA's solar calculator, which meets it.
double Refraction(double elevation) {
  if (elevation < -0.575) return -20.774 / 3600 / std::tan(elevation * kDegree);
  return std::max(0.0, 1.02 / 60 / std::tan((elevation + 10.3 / (elevation + 5.11)) * kDegree));
}

}  // namespace

UtcTime ParseTime(std::string_view text) {
  TimeReader reader(text);
  UtcTime time;
  time.year = reader.Digits(4, 1800, 2200);
  reader.Need('-');
  time.month = reader.Digits(2, 1, 12);
  reader.Need('-');
  time.day = reader.Digits(2, 1, DaysOfMonth(time.year, time.month));
  reader.Need('T');
  time.hours = reader.Digits(2, 0, 23);
  reader.Need(':');
  time.hours += reader.Digits(2, 0, 59) / 60.0;
  if (reader.Take(':')) time.hours += reader.Digits(2, 0, 60) / 3600.0;
  const bool east = reader.Take('+'), west = !east && reader.Take('-');
  if (east || west) {
    // No place on Earth is farther ahead than 14 hours, none farther behind than 12.
    const int most = east ? 14 : 12;
    double offset = reader.Digits(2, 0, most);
    reader.Need(':');
    offset += reader.Digits(2, 0, offset == most ? 0 : 59) / 60.0;
    time.hours -= east ? offset : -offset;
  } else {
    reader.Take('Z');
  }
  if (!reader.done()) reader.Fail();
  return time;
}

GeoPlace ParsePlace(std::string_view text) {
  GeoPlace place;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, place.latitude_deg);
  bool good = first.ec == std::errc() && first.ptr != end && *first.ptr == ',';
  if (good) {
    const auto second = std::from_chars(first.ptr + 1, end, place.longitude_deg);
    good = second.ec == std::errc() && second.ptr == end;
  }
  if (!good || !(std::fabs(place.latitude_deg) <= 90) || !(std::fabs(place.longitude_deg) <= 180)) {
    throw InputError("place '" + std::string(text) +
                     "' is not latitude,longitude in degrees (-90 … 90, -180 … 180), for example 52.5,13.4");
  }
  return place;
}

SunAngles SunPosition(const UtcTime& time, const GeoPlace& place) {
  const double day = JulianDay(time);
  const double t = (day + DeltaT(time.year) / 86400 - 2451545) / 36525;

  // Apparent longitude of the sun, its declination and right ascension.
  const double anomaly = (357.52911 + t * (35999.05029 - 0.0001537 * t)) * kDegree;
  const double center = (1.914602 - t * (0.004817 + 0.000014 * t)) * std::sin(anomaly) + (0.019993 - 0.000101 * t) * std::sin(2 * anomaly) +
                        0.000289 * std::sin(3 * anomaly);
  const double node = (125.04 - 1934.136 * t) * kDegree;
  const double longitude = (280.46646 + t * (36000.76983 + 0.0003032 * t) + center - 0.00569 - 0.00478 * std::sin(node)) * kDegree;
  const double tilt = (23.4392911 - 0.0130042 * t + 0.00256 * std::cos(node)) * kDegree;
  const double ascension = std::atan2(std::cos(tilt) * std::sin(longitude), std::cos(longitude));
  const double declination = std::asin(std::sin(tilt) * std::sin(longitude));

  // Hour angle from sidereal time (Meeus 12.4).
  const double u = (day - 2451545) / 36525;
  const double sidereal = 280.46061837 + 360.98564736629 * (day - 2451545) + 0.000387933 * u * u;
  const double hour = (Turn(sidereal) + place.longitude_deg) * kDegree - ascension;
  const double latitude = place.latitude_deg * kDegree;

  // Horizontal coordinates, parallax, refraction.
  const double azimuth = std::atan2(std::sin(hour), std::cos(hour) * std::sin(latitude) - std::tan(declination) * std::cos(latitude));
  double elevation =
      std::asin(std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(hour)) / kDegree;
  elevation -= 8.794 / 3600 * std::cos(elevation * kDegree);
  return {Turn(azimuth / kDegree + 180), elevation + Refraction(elevation)};
}

}  // namespace airsim360
