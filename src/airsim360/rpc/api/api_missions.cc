// Missions: behaviour trees that a drone flies in the server, instead of moves one by one.
#include <stdexcept>

#include "airsim360/rpc/api/api.h"
#include "airsim360/rpc/coordinates/ned.h"

namespace airsim360 {
namespace {

using Text = const std::string&;

struct ActiveNodeInfo {
  int line = 0;
  std::string label;
  template <class V>
  void Visit(V& v) {
    v("line", line), v("label", label);
  }
};

struct CaptureInfo {
  std::string to;
  uint64_t time_stamp = 0;  ///< ns, as pictures have
  airsim::Pose pose;        ///< of the drone, in the global N frame
  template <class V>
  void Visit(V& v) {
    v("to", to), v("time_stamp", time_stamp), v("pose", pose);
  }
};

struct MissionInfo {
  std::string result;
  double seconds = 0;
  std::vector<ActiveNodeInfo> active;
  std::vector<std::string> log;
  std::vector<CaptureInfo> captures;
  template <class V>
  void Visit(V& v) {
    v("result", result), v("seconds", seconds), v("active", active), v("log", log), v("captures", captures);
  }
};

VehicleControl& DroneOf(Session& s, Text name) {
  VehicleControl& control = s.control(name);
  if (!control.status().is_drone) throw std::invalid_argument("vehicle '" + control.status().name + "' is no drone and flies no mission");
  return control;
}

void Fly(Session& s, Text xml, Text vehicle) {
  VehicleControl& control = DroneOf(s, vehicle);
  if (!control.status().api_control)
    throw std::invalid_argument("simFlyMission: vehicle '" + control.status().name +
                                "' is not under API control; call enableApiControl(True) first");
  s.FlyMission(control, ReadMission(xml, "mission", {s.shared_model(), s.earth().origin()}, control.index()));
}

MissionInfo InfoOf(Session& s, Text vehicle) {
  const auto pilot = s.MissionOf(DroneOf(s, vehicle));
  if (!pilot) return {"none", 0, {}, {}, {}};
  const MissionProgress progress = pilot->progress();
  MissionInfo info{kMissionResultNames[static_cast<size_t>(progress.result)], progress.seconds, {}, progress.log, {}};
  for (const auto& node : progress.active) info.active.push_back({node.line, node.label});
  for (const MissionCapture& capture : pilot->CapturesFrom(0)) {
    const uint64_t stamp = s.snapshot()->epoch_ns + static_cast<uint64_t>(capture.shot.t_ns);
    info.captures.push_back({capture.to, stamp, airsim::ToPose(capture.shot.body.X_WB, s.origin_W())});
  }
  return info;
}

}  // namespace

void AddMissionCalls(Api& api) {
  api.Change(
      "simFlyMission", [](Session& s, Text xml, Text vehicle) { Fly(s, xml, vehicle); }, 1);
  api.Change(
      "simGetMission", [](Session& s, Text vehicle) { return InfoOf(s, vehicle); }, 1);
  api.Change(
      "simStopMission", [](Session& s, Text vehicle) { s.StopMission(DroneOf(s, vehicle)); }, 1);
}

}  // namespace airsim360
