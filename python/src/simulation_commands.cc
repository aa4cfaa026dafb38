// What drones can be told. Commands hold from the next step on, until the next command or their timeout.
#include "airsim360/base/error.h"
#include "airsim360/sim/trajectory_reference.h"
#include "airsim360/sim/wind_limit.h"
#include "simulation.h"

namespace airsim360::python {
namespace {

// yaw: None keeps the heading, a number is an angle, "forward" looks along the way; yaw_rate turns.
YawTarget ToYaw(const py::object& yaw, const py::object& rate) {
  if (!rate.is_none()) {
    if (!yaw.is_none()) throw InputError("give yaw or yaw_rate, not both");
    return {YawTarget::Mode::kRate, Finite(rate.cast<double>(), "yaw_rate")};
  }
  if (yaw.is_none()) return {};
  if (!py::isinstance<py::str>(yaw)) return {YawTarget::Mode::kAngle, Finite(yaw.cast<double>(), "yaw")};
  if (yaw.cast<std::string>() != "forward") throw InputError("yaw: '" + yaw.cast<std::string>() + "'; did you mean 'forward'?");
  return {YawTarget::Mode::kForward, 0};
}

// Either the share of the full thrust, or a height that is kept.
VerticalTarget ToVertical(const py::object& throttle, const py::object& altitude) {
  if (throttle.is_none() == altitude.is_none()) throw InputError("give throttle (0 to 1) or altitude (metres), one of them");
  if (altitude.is_none()) return {VerticalTarget::Mode::kThrottle, throttle.cast<double>()};
  return {VerticalTarget::Mode::kAltitude, altitude.cast<double>()};
}

std::array<double, kMaxRotors> ToRotors(const Simulation& sim, const py::object& drone, const std::vector<double>& values,
                                        const char* what) {
  const size_t rotors = sim.model()->drones[sim.Find(drone)]->model().rotors.size();
  if (values.size() != rotors)
    throw InputError(std::string(what) + ": " + std::to_string(values.size()) + " numbers for " + std::to_string(rotors) + " rotors");
  std::array<double, kMaxRotors> all{};
  std::copy(values.begin(), values.end(), all.begin());
  return all;
}

py::arg_v Drone0() { return py::arg("drone") = 0; }
py::arg_v NoTimeout() { return py::arg("timeout") = 0.0; }
py::arg_v NoYaw() { return py::arg("yaw") = py::none(); }
py::arg_v NoRate() { return py::arg("yaw_rate") = py::none(); }

void BindHandCommands(py::class_<Simulation>& sim) {
  using O = const py::object&;
  sim.def(
         "set_attitude",
         [](Simulation& s, double roll, double pitch, O throttle, O altitude, O yaw, O rate, O drone, double timeout) {
           s.Post(drone, AttitudeCommand{roll, pitch, ToYaw(yaw, rate), ToVertical(throttle, altitude)}, timeout);
         },
         py::arg("roll"), py::arg("pitch"), py::arg("throttle") = py::none(), py::arg("altitude") = py::none(), NoYaw(), NoRate(), Drone0(),
         NoTimeout(),
         "Radians: roll right side down, pitch nose up positive. throttle: share of the full thrust; or "
         "altitude: metres kept.")
      .def(
          "set_rates",
          [](Simulation& s, O w, O throttle, O altitude, O drone, double timeout) {
            s.Post(drone, RateCommand{ToVec3(w, "rates"), ToVertical(throttle, altitude)}, timeout);
          },
          py::arg("rates"), py::arg("throttle") = py::none(), py::arg("altitude") = py::none(), Drone0(), NoTimeout(),
          "rates: (3,) rad/s about the axes of B.")
      .def(
          "set_rotor_speeds",
          [](Simulation& s, const std::vector<double>& speeds, O drone, double timeout) {
            s.Post(drone, RotorSpeedCommand{ToRotors(s, drone, speeds, "speeds")}, timeout);
          },
          py::arg("speeds"), Drone0(), NoTimeout(), "(rotors,) rad/s.")
      .def(
          "set_rotor_signals",
          [](Simulation& s, const std::vector<double>& signals, O drone, double timeout) {
            s.Post(drone, RotorSignalCommand{ToRotors(s, drone, signals, "signals")}, timeout);
          },
          py::arg("signals"), Drone0(), NoTimeout(), "(rotors,) 0 … 1 of each rotor's full static thrust.")
      .def(
          "set_rotor_health",
          [](Simulation& s, const std::vector<double>& health, O drone) {
            for (const double h : health) {
              if (!(h >= 0 && h <= 1)) throw InputError("health: " + std::to_string(h) + " is not in 0 ... 1");
            }
            s.loop().Post({s.Find(drone), RotorHealthCommand{ToRotors(s, drone, health, "health")}});
          },
          py::arg("health"), Drone0(), "(rotors,) 1 works, 0 has failed.")
      .def(
          "set_wind",
          [](Simulation& s, O wind) {
            const Vec3d wind_W = ToVec3(wind, "wind");
            CheckWind(wind_W);
            s.loop().Post({0, WindCommand{wind_W}});
          },
          py::arg("wind"), "(3,) mean velocity of the air, m/s in W, at most 200.");
}

void BindManoeuvres(py::class_<Simulation>& sim) {
  using O = const py::object&;
  sim.def(
         "arm", [](Simulation& s, O drone) { s.Post(drone, ArmCommand{}, 0); }, Drone0(), "Lets the rotors turn.")
      .def(
          "disarm", [](Simulation& s, O drone) { s.Post(drone, DisarmCommand{}, 0); }, Drone0(), "Stops the rotors, in the air too.")
      .def(
          "takeoff",
          [](Simulation& s, double height, double speed, O drone) {
            s.Post(drone, TakeoffCommand{height, speed}, 0);
          },
          py::arg("height") = 2.0, py::arg("speed") = 1.0, Drone0(),
          "Arms and climbs `height` metres above where it stands, at `speed` m/s.")
      .def(
          "land", [](Simulation& s, double speed, O drone) { s.Post(drone, LandCommand{speed}, 0); }, py::arg("speed") = 0.7, Drone0(),
          "Descends at `speed` m/s until the ground stops it, then disarms.")
      .def(
          "hover", [](Simulation& s, O yaw, O rate, O drone) { s.Post(drone, HoverCommand{ToYaw(yaw, rate)}, 0); }, NoYaw(), NoRate(),
          Drone0(), "Stops and stays.")
      .def(
          "return_home",
          [](Simulation& s, double height, double speed, bool land, O drone) {
            s.Post(drone, ReturnCommand{height, speed, land}, 0);
          },
          py::arg("height") = 5.0, py::arg("speed") = 0.0, py::arg("land") = true, Drone0(),
          "Climbs to at least `height` metres above where it was armed, flies there at `speed` m/s (0 = what the drone is made for), "
          "and lands if `land`.");
}

void BindWays(py::class_<Simulation>& sim) {
  using O = const py::object&;
  sim.def(
         "fly_velocity",
         [](Simulation& s, O v, bool body, O altitude, O yaw, O rate, O drone, double timeout) {
           VelocityCommand command{.v = ToVec3(v, "velocity"), .body_heading = body, .yaw = ToYaw(yaw, rate)};
           command.hold_altitude = !altitude.is_none();
           if (command.hold_altitude) command.altitude = altitude.cast<double>();
           s.Post(drone, command, timeout);
         },
         py::arg("velocity"), py::arg("body_heading") = false, py::arg("altitude") = py::none(), NoYaw(), NoRate(), Drone0(), NoTimeout(),
         "velocity: (3,) m/s in W, or ahead, left, up of the drone's heading. altitude: z of W that is kept "
         "instead of velocity's.")
      .def(
          "fly_to",
          [](Simulation& s, O p, double speed, O yaw, O rate, O drone, double timeout) {
            s.Post(drone, PositionCommand{ToVec3(p, "position"), speed, ToYaw(yaw, rate)}, timeout);
          },
          py::arg("position"), py::arg("speed") = 0.0, NoYaw(), NoRate(), Drone0(), NoTimeout(),
          "position: (3,) metres of W. speed: m/s, 0 = what the drone is made for.")
      .def(
          "fly_path",
          [](Simulation& s, O points, double speed, double lookahead, O yaw, O rate, O drone, double timeout) {
            auto waypoints = std::make_shared<const std::vector<Vec3d>>(ToPoints(points, "waypoints"));
            s.Post(drone, PathCommand{std::move(waypoints), speed, lookahead, ToYaw(yaw, rate)}, timeout);
          },
          py::arg("waypoints"), py::arg("speed") = 0.0, py::arg("lookahead") = 0.0, NoYaw(), NoRate(), Drone0(), NoTimeout(),
          "Follows the polyline through waypoints (N, 3) of W.")
      .def(
          "fly_trajectory",
          [](Simulation& s, const Plan& plan, O yaw, O drone) {
            std::optional<double> fixed;
            if (!yaw.is_none()) fixed = Finite(yaw.cast<double>(), "yaw");
            s.Post(drone, TrajectoryCommand{std::make_shared<const PlannedReference>(plan.trajectory, fixed)}, 0);
          },
          py::arg("plan"), NoYaw(), Drone0(), "Follows a Plan from now on; yaw: a fixed heading, None = along the way.");
}

void BindReset(py::class_<Simulation>& sim) {
  using O = const py::object&;
  sim.def(
      "reset_drone",
      [](Simulation& s, O position, double yaw, O airborne, O drone) {
        ResetCommand command;
        if (!position.is_none()) command.X_WB = BodyPose(ToVec3(position, "position"), Finite(yaw, "yaw"), 0, 0);
        if (!airborne.is_none()) command.airborne = airborne.cast<bool>();
        s.loop().Post({s.Find(drone), command});
      },
      py::arg("position") = py::none(), py::arg("yaw") = 0.0, py::arg("airborne") = py::none(), Drone0(),
      "Puts a drone where it started, or somewhere else, as new.");
}

}  // namespace

void BindCommands(py::class_<Simulation>& sim) {
  BindManoeuvres(sim);
  BindWays(sim);
  BindReset(sim);
  BindHandCommands(sim);
}

}  // namespace airsim360::python
