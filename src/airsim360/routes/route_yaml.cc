#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "airsim360/base/config.h"
#include "airsim360/base/error.h"
#include "airsim360/math/coordinate_limit.h"
#include "airsim360/routes/route_file.h"

namespace airsim360 {
namespace {

constexpr double kLargest = 1e9;  // of times and angles
constexpr double kNotGiven = -kLargest;

struct Entry {
  double x = kNotGiven, y = kNotGiven, z = kNotGiven, yaw_deg = kNotGiven, t = kNotGiven;
  size_t line = 0;
};

}  // namespace

std::vector<Waypoint> ParseRouteYaml(std::string_view text, std::string_view name) {
  std::vector<Entry> entries;
  std::string frame = "W";
  ReadYaml(text, name, [&](ConfigVisitor& v) {
    v.Field("frame", "W: x east, y north, z up", frame);
    v.List("waypoints", "places to pass", entries, [](ConfigVisitor& e, Entry& entry) {
      entry.line = e.line();
      e.Field("x", "metres east", entry.x, -kCoordinateLimit, kCoordinateLimit);
      e.Field("y", "metres north", entry.y, -kCoordinateLimit, kCoordinateLimit);
      e.Field("z", "metres up", entry.z, -kCoordinateLimit, kCoordinateLimit);
      e.Field("yaw_deg", "degrees counter-clockwise from east", entry.yaw_deg, -kLargest, kLargest);
      e.Field("t", "seconds", entry.t, -kLargest, kLargest);
    });
  });
  const std::string where(name);
  if (frame != "W") throw InputError(where + ": frame: '" + frame + "' is not 'W'");
  if (entries.empty()) throw InputError(where + ": no points");
  std::vector<Waypoint> waypoints;
  for (const Entry& e : entries) {
    const std::string entry = where + ":" + std::to_string(e.line) + ": waypoint " + std::to_string(waypoints.size() + 1);
    if (e.x == kNotGiven || e.y == kNotGiven || e.z == kNotGiven) throw InputError(entry + " lacks x, y or z");
    Waypoint w;
    w.line = e.line;
    w.p = {e.x, e.y, e.z};
    w.has_yaw = e.yaw_deg != kNotGiven;
    if (w.has_yaw) w.yaw = e.yaw_deg * std::numbers::pi / 180;
    w.has_time = e.t != kNotGiven;
    if (w.has_time) w.t = e.t;
    if (!waypoints.empty() && w.has_time != waypoints.back().has_time) throw InputError(entry + ": all waypoints need a time t, or none");
    if (!waypoints.empty() && w.has_time && !(w.t > waypoints.back().t))
      throw InputError(entry + ": " + TimeDoesNotGrow(waypoints.back().t, w.t));
    waypoints.push_back(w);
  }
  return waypoints;
}

}  // namespace airsim360
