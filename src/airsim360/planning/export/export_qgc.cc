#include "airsim360/planning/export/export_qgc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "airsim360/planning/number_text.h"

namespace airsim360 {
namespace {

enum Command { kWaypoint = 16, kLand = 21, kTakeOff = 22, kChangeSpeed = 178 };
constexpr int kRelativeAltitude = 3, kMissionFrame = 2;

// Appends the items of a mission one after another.
class Items {
 public:
  explicit Items(const GeoPoint& origin) : frame_(origin) {}
  void AddPlace(Command command, Vec3d p_W, std::optional<double> yaw) {
    const GeoPoint g = frame_.ToGeodetic(p_W);
    const double altitude = g.altitude - frame_.origin().altitude;
    const double place[] = {g.latitude_deg, g.longitude_deg, altitude};
    std::string params = "0, 0, 0, ";
    if (yaw) {
      // Degrees from north, clockwise.
      const double heading = std::fmod(450 - *yaw * 180 / std::numbers::pi, 360);
      AppendNumber(params, heading);
    } else {
      params += "null";
    }
    params += ", ";
    AppendNumbers(params, place, ", ");
    std::string extra = "\"AMSLAltAboveTerrain\": null, \"Altitude\": ";
    AppendNumber(extra, altitude);
    Add(command, kRelativeAltitude, params, extra + ", \"AltitudeMode\": 1, ");
  }
  void AddSpeed(double speed) {
    std::string params = "1, ";
    AppendNumber(params, speed);
    Add(kChangeSpeed, kMissionFrame, params + ", -1, 0, 0, 0, 0", "");
  }
  const std::string& text() const { return text_; }

 private:
  void Add(Command command, int frame, const std::string& params, const std::string& extra) {
    if (count_++ > 0) text_ += ",\n";
    text_ += "      {\"type\": \"SimpleItem\", \"autoContinue\": true, \"command\": " + std::to_string(command) +
             ", \"doJumpId\": " + std::to_string(count_) + ", \"frame\": " + std::to_string(frame) + ", " + extra + "\"params\": [" +
             params + "]}";
  }
  GeoFrame frame_;
  std::string text_;
  int count_ = 0;
};

}  // namespace

std::string QgcPlan(const PolynomialTrajectory& path, const QgcOptions& options) {
  Items items(options.origin);
  std::optional<YawProfile> profile;
  if (options.yaw) profile.emplace(path, *options.yaw);
  const auto add = [&](Command command, double t) {
    items.AddPlace(command, path.At(t).p, profile ? std::optional(profile->At(t)) : std::nullopt);
  };
  add(kTakeOff, 0);
  items.AddSpeed(options.speed);
  for (size_t i = 0; i < path.segments(); ++i) {
    const double duration = path.durations()[i];
    // The longest way of a part is at most its share of the time at the highest sampled speed.
    double speed = 0;
    for (int k = 0; k <= 32; ++k) speed = std::max(speed, Norm(path.At(path.start(i) + duration * k / 32).v));
    const int parts = std::max(1, static_cast<int>(std::ceil(1.05 * speed * duration / options.spacing)));
    for (int k = 1; k <= parts; ++k) add(kWaypoint, path.start(i) + duration * k / parts);
  }
  add(kLand, path.duration());
  const double home[] = {options.origin.latitude_deg, options.origin.longitude_deg, options.origin.altitude};
  std::string out =
      "{\n  \"fileType\": \"Plan\",\n  \"version\": 1,\n  \"groundStation\": \"QGroundControl\",\n"
      "  \"geoFence\": {\"circles\": [], \"polygons\": [], \"version\": 2},\n"
      "  \"rallyPoints\": {\"points\": [], \"version\": 2},\n  \"mission\": {\n    \"version\": 2,\n"
      "    \"firmwareType\": 12,\n    \"vehicleType\": 2,\n    \"globalPlanAltitudeMode\": 1,\n"
      "    \"cruiseSpeed\": ";
  AppendNumber(out, options.speed);
  out += ",\n    \"hoverSpeed\": ";
  AppendNumber(out, options.speed);
  out += ",\n    \"plannedHomePosition\": [";
  AppendNumbers(out, home, ", ");
  out += "],\n    \"items\": [\n" + items.text() + "\n    ]\n  }\n}\n";
  return out;
}

}  // namespace airsim360
