// Simulation's names in Python, but for the commands.
#include <algorithm>
#include <cmath>

#include "airsim360/base/error.h"
#include "interrupts.h"
#include "simulation.h"

namespace airsim360::python {
namespace {

/// A copy of everything that changes.
struct Snapshot {
  std::shared_ptr<const SimModel> model;
  std::shared_ptr<const SimState> state;
};

/// Steps until the command of a drone has reached its end, was refused or lost, or `timeout` seconds are over; whether it
/// reached its end. What is posted now counts from the next step on, so at least kLook is simulated.
bool Wait(Simulation& sim, const py::object& drone, double timeout) {
  constexpr int64_t kLook = 10'000'000;  // nanoseconds between looks, and some periods of the autopilot
  if (!(timeout >= 0 && timeout < 1e8)) throw InputError(Text("timeout: %g s is not in 0 ... 1e8", timeout));
  const size_t i = sim.Find(drone);
  const int64_t steps = std::max<int64_t>(1, kLook / sim.model()->dt_ns);
  const int64_t end_ns = sim.loop().t_ns() + std::llround(timeout * 1e9);
  const py::gil_scoped_release release;
  SignalWatch watch;
  while (sim.loop().t_ns() < end_ns) {
    sim.loop().Advance(steps);
    watch.Look();
    const uint64_t flags = sim.loop().Snapshot()->vehicles[i].autopilot.flags;
    if (flags & kCommandDone) return true;
    if (flags & (kCommandRefused | kCommandLost)) return false;
  }
  return false;
}

int64_t StepsOf(const Simulation& sim, double seconds) {
  if (!(seconds >= 0 && seconds < 1e8)) throw InputError("seconds: " + std::to_string(seconds) + " is not 0 or more");
  return std::llround(seconds * 1e9 / static_cast<double>(sim.model()->dt_ns));
}

std::shared_ptr<Recording> StopRecording(Simulation& sim) {
  std::optional<Recording> recording = sim.loop().StopRecording();
  if (!recording) throw InputError("stop_recording: nothing is being recorded");
  return std::make_shared<Recording>(std::move(*recording));
}

py::dict ReplayFrom(const Simulation& sim, const Recording& recording, const Snapshot& start) {
  SimState state = *start.state;
  ReplayResult result;
  {
    const py::gil_scoped_release release;
    result = Replay(*sim.model(), recording, state);
  }
  py::dict d;
  d["same"] = result.same;
  d["steps"] = result.steps;
  d["differs_at"] = result.differs_at < 0 ? py::object(py::none()) : py::int_(result.differs_at);
  d["hash"] = result.hash;
  return d;
}

void BindSnapshot(py::module_& m) {
  py::class_<Snapshot>(m, "Snapshot",
                       "Everything that changes in a simulation, at one instant. Simulation.restore goes back to it exactly.")
      .def_property_readonly(
          "t", [](const Snapshot& s) { return static_cast<double>(s.state->t_ns) * 1e-9; }, "Simulated time, seconds.")
      .def("__repr__", [](const Snapshot& s) { return Text("Snapshot(t = %.3f s)", Seconds(s.state->t_ns)); })
      .def_property_readonly(
          "step", [](const Snapshot& s) { return s.state->step; }, "Steps since the start.")
      .def_property_readonly(
          "hash", [](const Snapshot& s) { return HashState(*s.state); }, "64 bits over every number of the state.")
      .def(
          "state",
          [](const Snapshot& s, size_t i) {
            if (i >= s.state->vehicles.size())
              throw InputError("drone " + std::to_string(i) + " of " + std::to_string(s.state->vehicles.size()));
            return StateView{s.model, s.state, i};
          },
          py::arg("drone") = 0, "DroneState of a drone by number, then.");
}

void BindRecording(py::module_& m) {
  py::class_<Recording, std::shared_ptr<Recording>>(m, "Recording", "The commands of a run with hashes of its states.")
      .def("__repr__",
           [](const Recording& r) { return Text("Recording(%lld steps: '%s')", static_cast<long long>(r.steps), r.note.c_str()); })
      .def_readonly("note", &Recording::note, "What start_recording was told.")
      .def_readonly("steps", &Recording::steps, "Steps that it holds.")
      .def(
          "write", [](const Recording& r, const std::string& path) { WriteRecording(path, r); }, py::arg("path"), "Writes it to a file.")
      .def_static(
          "read", [](const std::string& path) { return std::make_shared<Recording>(ReadRecording(path)); }, py::arg("path"),
          "ValueError for anything but a recording.");
}

void BindTime(py::class_<Simulation>& sim) {
  sim.def(
         "step",
         [](Simulation& s, const py::object& count) {
           const int64_t n = ToWhole(count, "n", 0, int64_t{1} << 53);
           const py::gil_scoped_release release;
           AdvanceWatched(s.loop(), n);
         },
         py::arg("n") = 1, "Takes n steps of dt.")
      .def(
          "run",
          [](Simulation& s, double seconds) {
            const int64_t n = StepsOf(s, seconds);
            const py::gil_scoped_release release;
            AdvanceWatched(s.loop(), n);
          },
          py::arg("seconds"), "Takes the steps of so many simulated seconds.")
      .def("wait", &Wait, py::arg("drone") = 0, py::arg("timeout") = 60.0,
           "Takes steps until the drone's command has reached its end (a take-off its height, fly_to its place, a landing the "
           "ground): True; or until it is refused or lost, or `timeout` simulated seconds are over: False.");
}

// What is seen and measured now.
void BindSensing(py::class_<Simulation>& sim) {
  sim.def(
      "state",
      [](Simulation& s, const py::object& drone) {
        return StateView{s.model(), s.loop().Snapshot(), s.Find(drone)};
      },
      py::arg("drone") = 0, "DroneState of a drone by number or name.");
  BindCapturing(sim);
  BindScanning(sim);
}

void BindHistory(py::class_<Simulation>& sim) {
  sim.def(
         "snapshot",
         [](Simulation& s) {
           return Snapshot{s.model(), s.loop().Snapshot()};
         },
         "A copy of everything that changes.")
      .def(
          "restore",
          [](Simulation& s, const Snapshot& snapshot) {
            if (snapshot.model != s.model()) throw InputError("restore: the snapshot is of another simulation");
            const py::gil_scoped_release release;
            s.loop().Restore(*snapshot.state);
          },
          py::arg("snapshot"), "Goes back to a snapshot of this simulation; commands not yet applied are dropped.")
      .def(
          "start_recording", [](Simulation& s, const std::string& note) { s.loop().StartRecording(note); }, py::arg("note") = "",
          "Notes commands and hashes from now on.")
      .def("stop_recording", &StopRecording, "The Recording since start_recording.")
      .def("replay", &ReplayFrom, py::arg("recording"), py::arg("start"),
           "Repeats a recording from the snapshot it began with, beside this simulation: dictionary with "
           "same, "
           "steps, differs_at (step, or None), hash.")
      .def(
          "hash", [](Simulation& s) { return HashState(*s.loop().Snapshot()); }, "64 bits over every number of the state.")
      .def("events", &Simulation::Events, "What happened since the last call: dictionaries with event, drone, t_ns, …");
}

void BindFacts(py::class_<Simulation>& sim) {
  sim.def_property_readonly(
         "t", [](Simulation& s) { return static_cast<double>(s.loop().t_ns()) * 1e-9; }, "Seconds since the start.")
      .def_property_readonly(
          "t_ns", [](Simulation& s) { return s.loop().t_ns(); }, "Nanoseconds since the start.")
      .def_property_readonly(
          "geo_frame", [](const Simulation& s) { return s.model()->world.frame; },
          "GeoFrame: where W lies on the Earth, for satellite receivers.")
      .def("__repr__",
           [](Simulation& s) {
             return Text("Simulation(%s, drones: %s, t = %.3f s, dt = %g s)", s.world()->name().c_str(),
                         s.names().empty() ? "none" : Joined(s.names()).c_str(), Seconds(s.loop().t_ns()), Seconds(s.model()->dt_ns));
           })
      .def_property_readonly(
          "dt", [](Simulation& s) { return static_cast<double>(s.model()->dt_ns) * 1e-9; }, "Seconds of a step.")
      .def_property_readonly("world", &Simulation::world, "The world that it takes place in.")
      .def_property_readonly(
          "entities", [](const Simulation& s) { return EntitiesOf(s.scene(), s.world()->labels().get()); },
          "As World.entities, with the bodies of drones (if there are several) and people.")
      .def_property_readonly("people", &Simulation::People,
                             "Everybody now: dictionaries with entity, position (3,) on the ground in W, velocity, "
                             "yaw, behaviour, group_id (people who walk or talk together share one; 0: alone), visible.")
      .def_property_readonly("vehicles", &Simulation::Vehicles,
                             "The traffic now: dictionaries with entity, name, category, position and orientation in W, velocity, size, "
                             "indicator, braking, stopped.")
      .def_property_readonly("drones", &Simulation::names, "Names of the drones, in order.");
}

}  // namespace

void BindSimulation(py::module_& m) {
  BindSnapshot(m);
  BindRecording(m);
  py::class_<Simulation> sim(m, "Simulation", R"(Drones in a world, advanced in fixed steps of dt seconds; no clock but the steps.

drones: a number of hummingbirds, a Drone (or a name, words, a .yaml file), or a list of them. The same seed and the same
commands give the same bytes with any number of threads. people: how many
walk about. wind: (3,) m/s in W, None: that of the world. The world says what draws the pictures.)");
  sim.def(py::init<std::shared_ptr<World>, const py::object&, const py::object&, const py::object&, double, const py::object&>(),
          py::arg("world"), py::arg("drones") = 1, py::arg("people") = 0, py::arg("seed") = 0, py::arg("dt") = 0.001,
          py::arg("wind") = py::none());
  BindTime(sim);
  BindSensing(sim);
  BindHistory(sim);
  BindFacts(sim);
  BindCommands(sim);
  BindMissions(sim);
}

}  // namespace airsim360::python
