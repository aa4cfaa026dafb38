#include "airsim360/rpc/settings/time_of_day.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "airsim360/opening/world_environment.h"

namespace airsim360 {
namespace {

// "2018-02-12 15:20:00" in the local mean time of the place, as our flags want it.
std::string LocalTime(const std::string& text, double longitude_deg) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  const auto fail = [&](const std::string& why) {
    throw std::invalid_argument("start_datetime '" + text.substr(0, 40) + "' is not YYYY-MM-DD HH:MM:SS" + why);
  };
  int end = 0;
  const int found = std::sscanf(text.c_str(), "%4d-%2d-%2d %2d:%2d%n:%2d%n", &year, &month, &day, &hour, &minute, &end, &second, &end);
  if (found < 5 || static_cast<size_t>(end) != text.size()) fail("");
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year) / month / day};
  if (year < 1800 || year > 2200 || !date.ok()) fail(": there is no such day from 1800 to 2200");
  if (hour < 0 || hour > 23 || minute < 0 || minute > 59 || second < 0 || second > 60) fail(": there is no such time");
  const int zone = static_cast<int>(std::lround(longitude_deg / 15));
  char out[64];
  std::snprintf(out, sizeof out, "%04d-%02d-%02dT%02d:%02d%c%02d:00", year, month, day, hour, minute, zone < 0 ? '-' : '+', std::abs(zone));
  return out;
}

}  // namespace

void SetTimeOfDay(const std::string& start, const airsim::GeoPoint& place, Environment& environment) {
  if (start.empty()) return;
  char text[64];
  std::snprintf(text, sizeof text, "%.6f,%.6f", place.latitude, place.longitude);
  SetSunByTime(LocalTime(start, place.longitude), text, environment);
}

}  // namespace airsim360
