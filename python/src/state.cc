// What a snapshot tells of one drone.
#include "airsim360/sensors/gimbal.h"
#include "handles.h"

namespace airsim360::python {
namespace {

py::object Collision(const StateView& s) {
  const CollisionInfo& c = s.vehicle().collision;
  if (c.count == 0) return py::none();
  py::dict d;
  d["count"] = c.count;
  d["t_ns"] = c.t_ns;
  d["point"] = FromVec3(c.p_W);
  d["normal"] = FromVec3(c.normal_W);
  d["impact_speed"] = c.impact_speed;
  d["entity"] = c.entity;
  return d;
}

py::array_t<double> RotorSpeedsOf(const StateView& s) {
  const auto n = static_cast<py::ssize_t>(s.model->drones[s.i]->model().rotors.size());
  return py::array_t<double>(n, s.vehicle().drone.rotor_speeds.data());
}

py::array_t<double> Euler(const StateView& s) {
  const auto angles = AnglesOf(s.vehicle().motion.X_WB.R);
  return FromVec3({angles.roll, angles.pitch, angles.yaw});
}

py::dict Sensors(const StateView& s) {
  const SensorStates& sensors = s.vehicle().sensors;
  const SensorSet& set = s.model->drones[s.i]->setup().sensors;
  py::dict all;
  for (size_t i = 0; i < sensors.imus.size(); ++i) {
    const ImuReading& r = sensors.imus[i].last;
    py::dict d;
    d["t_ns"] = r.t_ns;
    d["angular_velocity"] = FromVec3(r.angular_velocity);
    d["specific_force"] = FromVec3(r.specific_force);
    all[py::str(set.imus[i].name)] = d;
  }
  for (size_t i = 0; i < sensors.gnss.size(); ++i) {
    const GnssReading& r = sensors.gnss[i].last;
    py::dict d;
    d["t_ns"] = r.t_ns;
    d["measured_ns"] = r.measured_ns;
    d["latitude_deg"] = r.place.latitude_deg;
    d["longitude_deg"] = r.place.longitude_deg;
    d["altitude"] = r.place.altitude;
    d["position"] = FromVec3(r.p_WS);
    d["velocity"] = FromVec3(r.v_WS);
    d["eph"] = r.eph;
    d["epv"] = r.epv;
    d["has_fix"] = r.has_fix;
    all[py::str(set.gnss[i].name)] = d;
  }
  for (size_t i = 0; i < sensors.barometers.size(); ++i) {
    const BarometerReading& r = sensors.barometers[i].last;
    py::dict d;
    d["t_ns"] = r.t_ns;
    d["pressure"] = r.pressure;
    d["altitude"] = r.altitude;
    d["temperature"] = r.temperature;
    all[py::str(set.barometers[i].name)] = d;
  }
  for (size_t i = 0; i < sensors.magnetometers.size(); ++i) {
    const MagnetometerReading& r = sensors.magnetometers[i].last;
    py::dict d;
    d["t_ns"] = r.t_ns;
    d["field"] = FromVec3(r.field);
    all[py::str(set.magnetometers[i].name)] = d;
  }
  return all;
}

}  // namespace

void BindState(py::module_& m) {
  const auto vector = [](Vec3d Kinematics::*field) { return [field](const StateView& s) { return FromVec3(s.vehicle().motion.*field); }; };
  py::class_<StateView>(m, "DroneState", "One drone at one instant: a look at an immutable snapshot. W, metres, seconds, radians.")
      .def("__repr__",
           [](const StateView& s) {
             const Vehicle& v = s.vehicle();
             return Text("DroneState(t = %.3f s, position %s m, velocity %s m/s, %s)", Seconds(s.state->t_ns),
                         Text(v.motion.X_WB.p).c_str(), Text(v.motion.v_WB).c_str(), DescribeState(v.autopilot).c_str());
           })
      .def_property_readonly(
          "t", [](const StateView& s) { return static_cast<double>(s.state->t_ns) * 1e-9; }, "Simulated time, seconds.")
      .def_property_readonly(
          "t_ns", [](const StateView& s) { return s.state->t_ns; }, "Simulated time, nanoseconds.")
      .def_property_readonly(
          "position", [](const StateView& s) { return FromVec3(s.vehicle().motion.X_WB.p); }, "(3,) p_WB, metres")
      .def_property_readonly("velocity", vector(&Kinematics::v_WB), "(3,) v_WB in W, m/s")
      .def_property_readonly("angular_velocity", vector(&Kinematics::w_WB_B), "(3,) rad/s in B")
      .def_property_readonly(
          "acceleration", [](const StateView& s) { return FromVec3(s.vehicle().a_WB); }, "(3,) m/s^2 in W, mean over the last step")
      .def_property_readonly(
          "orientation", [](const StateView& s) { return FromQuaternion(ToQuaternion(s.vehicle().motion.X_WB.R)); },
          "(4,) q_WB as w, x, y, z")
      .def_property_readonly("euler", &Euler, "(3,) roll, pitch, yaw: R_WB = Rz(yaw) Ry(-pitch) Rx(roll)")
      .def_property_readonly(
          "pose", [](const StateView& s) { return FromPose(s.vehicle().motion.X_WB); }, "(4, 4) X_WB")
      .def_property_readonly("rotor_speeds", &RotorSpeedsOf, "(rotors,) rad/s")
      .def_property_readonly(
          "charge", [](const StateView& s) { return s.vehicle().drone.charge; }, "of the battery, 0 … 1")
      .def_property_readonly(
          "clearance", [](const StateView& s) { return s.vehicle().clearance; },
          "metres to the nearest surface, at most 2; renewed every 10 ms")
      .def_property_readonly(
          "mode", [](const StateView& s) { return DescribeState(s.vehicle().autopilot); }, "What the autopilot does, in words.")
      .def_property_readonly(
          "touching", [](const StateView& s) { return s.vehicle().touching; }, "Whether it is in contact with a surface.")
      .def_property_readonly("collision", &Collision,
                             "The last contact: count, t_ns, point, normal, impact_speed, entity; None if there was none.")
      .def_property_readonly("sensors", &Sensors, "Sensor name -> its last reading.");
}

}  // namespace airsim360::python
