// Missions: behaviour trees that a drone of the simulation flies.
#include <cmath>

#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/mission/mission.h"
#include "interrupts.h"
#include "simulation.h"

namespace airsim360::python {
namespace {

// A frame of a mission, with what the rig saw then.
struct Taken {
  MissionCapture capture;
  std::shared_ptr<Capture> picture;
};

/// What a mission did.
struct Outcome {
  MissionProgress progress;
  std::vector<Taken> captures;
};

// Steps on until the mission ends or `end_ns`. A frame is of the instant before the step in which it is taken.
Outcome Run(Simulation& sim, MissionPilot& pilot, size_t drone, const std::optional<Rig>& rig, int64_t end_ns) {
  Outcome outcome;
  size_t seen = 0;
  SignalWatch watch;
  while (!pilot.done() && sim.loop().t_ns() < end_ns) {
    const std::shared_ptr<const SimState> before = rig ? sim.loop().Snapshot() : nullptr;
    sim.loop().Advance(1);
    watch.Look();
    for (MissionCapture& capture : pilot.CapturesFrom(seen)) {
      ++seen;
      std::shared_ptr<Capture> picture = rig ? sim.TakeAt(*rig, drone, before) : nullptr;
      outcome.captures.push_back({std::move(capture), std::move(picture)});
    }
  }
  outcome.progress = pilot.progress();
  return outcome;
}

py::dict ToDict(const Outcome& outcome) {
  py::list active, captures;
  for (const auto& node : outcome.progress.active) {
    py::dict d;
    d["line"] = node.line;
    d["label"] = node.label;
    active.append(std::move(d));
  }
  for (const Taken& taken : outcome.captures) {
    const Shot& shot = taken.capture.shot;
    py::dict d;
    d["to"] = taken.capture.to;
    d["t_ns"] = shot.t_ns;
    d["position"] = FromVec3(shot.body.X_WB.p);
    d["orientation"] = FromQuaternion(ToQuaternion(shot.body.X_WB.R));
    d["picture"] = taken.picture ? py::cast(taken.picture) : py::object(py::none());
    captures.append(std::move(d));
  }
  py::dict d;
  const bool stopped = outcome.progress.result == MissionProgress::Result::kRunning;
  d["result"] = stopped ? "stopped" : kMissionResultNames[static_cast<size_t>(outcome.progress.result)];
  d["seconds"] = outcome.progress.seconds;
  d["log"] = outcome.progress.log;
  d["active"] = active;
  d["captures"] = captures;
  return d;
}

// XML, or the path of a file of it.
py::dict FlyMission(Simulation& sim, const std::string& mission, const py::object& drone, const std::optional<Rig>& rig, double timeout) {
  if (!(timeout > 0 && timeout < 1e8)) throw InputError("timeout: " + std::to_string(timeout) + " s is not in 0 ... 1e8");
  const size_t i = sim.Find(drone);
  const bool is_text = mission.find('<') != std::string::npos;
  const std::string xml = is_text ? mission : ReadTextFile(mission, uint64_t{1} << 21);
  Outcome outcome;
  {
    const py::gil_scoped_release release;
    const auto pilot =
        std::make_shared<MissionPilot>(ReadMission(xml, is_text ? "mission" : mission, {sim.model(), sim.world()->earth()}, i));
    sim.loop().Attach(pilot);
    outcome = Run(sim, *pilot, i, rig, sim.loop().t_ns() + std::llround(timeout * 1e9));
    sim.loop().Detach(pilot.get());
  }
  return ToDict(outcome);
}

}  // namespace

void BindMissions(py::class_<Simulation>& sim) {
  sim.def("fly_mission", &FlyMission, py::arg("mission"), py::arg("drone") = 0, py::arg("rig") = py::none(), py::arg("timeout") = 600.0,
          "Takes steps until a mission has ended, or `timeout` simulated seconds are over. mission: XML, or the path of a file of it "
          "(docs/guide/missions.md). Dictionary with result (success, failure, stopped), seconds, log, active, captures; with a rig "
          "each capture has the picture of its instant.");
}

}  // namespace airsim360::python
