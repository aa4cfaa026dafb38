// Connection, clock, control: ping … simContinueForFrames, reset, settings.
#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/coordinates/ned.h"

namespace airsim360 {
namespace {

constexpr double kLongestContinue = 1e6;  // seconds

airsim::GeoPoint ToWire(const GeoPoint& point) { return {point.latitude_deg, point.longitude_deg, static_cast<float>(point.altitude)}; }

void AddClockCalls(Api& api) {
  api.Change("simPause", [](Session& s, bool is_paused) { s.pacer().Pause(is_paused, s.state().t_ns); });
  api.Read("simIsPaused", [](const Snapshot& now) { return now.paused; });
  api.Start("simContinueForTime", [](Session& s, const Reply& reply, double seconds) {
    if (!(seconds >= 0 && seconds <= kLongestContinue)) throw std::invalid_argument("seconds must be in 0 ... 1e6");
    s.pacer().Continue(s.state().t_ns, std::llround(seconds * 1e9), reply);
  });
  api.Start("simContinueForFrames",
            [](Session& s, const Reply& reply, uint32_t frames) { s.pacer().Continue(s.state().t_ns, frames * kFrameNs, reply); });
}

}  // namespace

void AddConnectionCalls(Api& api) {
  api.Read("ping", [](const Snapshot&) { return true; });
  // What the clients of AirSim, and of Cosys-AirSim, want at least.
  api.Read("getServerVersion", [&api](const Snapshot&) { return api.session().settings().cosys ? 4 : 1; });
  api.Read("getMinRequiredClientVersion", [](const Snapshot&) { return 1; });
  AddClockCalls(api);
  api.Change("reset", [](Session& s) { s.Reset(); });
  api.Read("listVehicles", [](const Snapshot& now) {
    std::vector<std::string> names;
    for (const VehicleStatus& vehicle : now.vehicles) names.push_back(vehicle.name);
    return names;
  });
  api.Read("getSettingsString", [&api](const Snapshot&) { return api.session().settings().text; });
  api.Read("getHomeGeoPoint", [&api](const Snapshot& now, const std::string& vehicle) {
    return ToWire(api.session().earth().ToGeodetic(now.vehicles[now.Find(vehicle)].origin_W));
  });
  api.Read("simPrintLogMessage", [](const Snapshot&, const std::string& message, const std::string& parameter, uint8_t severity) {
    constexpr size_t kLongest = 1000;
    const std::string text = (message + parameter).substr(0, kLongest);
    severity > 0 ? LogWarning("client: " + text) : LogInfo("client: " + text);
  });
  api.Change("startRecording", [](Session& s) { s.recorder().Start(); });
  api.Change("stopRecording", [](Session& s) { s.recorder().Stop(); });
  // Asked of the recorder itself: a recording can end at any time, also while time stands still.
  api.Change("isRecording", [](Session& s) { return s.recorder().running(); });
}

}  // namespace airsim360
