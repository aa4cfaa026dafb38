// Drones: by name, from words, from a file.
#include "airsim360/base/error.h"
#include "airsim360/flight/drones/catalog.h"
#include "airsim360/flight/drones/fleet.h"
#include "airsim360/flight/prompt/drone_file.h"
#include "airsim360/flight/prompt/gate.h"
#include "handles.h"

namespace airsim360::python {

Drone MakeDrone(const std::string& what) {
  Drone drone;
  for (const CatalogDrone& entry : DroneCatalog()) {
    if (entry.name != what) continue;
    drone.model = CatalogModel(what);
    drone.laws["mass"] = entry.source;
    drone.yaml = DroneYaml(drone.model, entry.source);
    return drone;
  }
  const bool is_file = what.ends_with(".yaml") || what.ends_with(".yml");
  // One word that is no name is a misspelt one: CatalogModel names the nearest.
  if (!is_file && what.find(' ') == std::string::npos && !NamesRealDrone(what)) CatalogModel(what);
  const DroneDesign design = is_file ? ReadDroneFile(what) : DroneFromPrompt(what);
  drone.model = design.model;
  drone.laws = design.laws;
  drone.yaml = DroneYaml(design);
  return drone;
}

Drone ToDrone(const py::handle& value) {
  if (py::isinstance<Drone>(value)) return value.cast<Drone>();
  if (py::isinstance<py::str>(value)) return MakeDrone(value.cast<std::string>());
  throw InputError("drones: " + py::repr(value).cast<std::string>() + " is neither an airsim360.Drone nor a name, words or a .yaml file");
}

namespace {

Drone NewDrone(const std::string& model, const std::string& name, const py::object& position, double yaw, bool airborne,
               const std::string& controller, const std::string& sensors) {
  Drone drone = MakeDrone(model);
  drone.name = name;
  if (!position.is_none()) drone.p_WB = ToVec3(position, "position");
  drone.yaw = Finite(yaw, "yaw");
  drone.airborne = airborne;
  drone.controller = ParseControllerKind(controller);
  if (!sensors.empty()) drone.sensors = ReadSensorSet(sensors);
  return drone;
}

py::array_t<double> Inertia(const Drone& d) {
  py::array_t<double> a({3, 3});
  for (int i = 0; i < 9; ++i) a.mutable_data()[i] = d.model.inertia_B.m[i / 3][i % 3];
  return a;
}

py::list Rotors(const Drone& d) {
  py::list list;
  for (const RotorModel& r : d.model.rotors) {
    py::dict rotor;
    rotor["position"] = FromVec3(r.p_B);
    rotor["axis"] = FromVec3(r.axis_B);
    rotor["direction"] = r.direction;
    rotor["diameter"] = r.diameter;
    rotor["thrust_factor"] = r.thrust_factor;
    rotor["torque_ratio"] = r.torque_ratio;
    rotor["max_speed"] = r.max_speed;
    rotor["tau_up"] = r.tau_up;
    list.append(std::move(rotor));
  }
  return list;
}

}  // namespace

void BindDrone(py::module_& m) {
  py::class_<Drone>(m, "Drone", R"(A kind of drone and where it starts.

model: a name of drone_catalog(), a .yaml file, or words ("a 250 g five-inch racing quad"). position (3,) of W: where it
hovers (airborne) or above where it stands; None: the world's spawn. yaw: radians. controller: simple_flight, px4, se3 or
indi. sensors: a sensor file. ValueError names what was not understood.)")
      .def(py::init(&NewDrone), py::arg("model") = "hummingbird", py::arg("name") = "", py::arg("position") = py::none(),
           py::arg("yaw") = 0.0, py::arg("airborne") = false, py::arg("controller") = "indi", py::arg("sensors") = "")
      .def_static(
          "from_words",
          [](const std::string& words) {
            Drone d;
            const DroneDesign design = DroneFromPrompt(words);
            d.model = design.model;
            d.laws = design.laws;
            d.yaml = DroneYaml(design);
            return d;
          },
          py::arg("words"), "A drone from a description; every figure has its reason in `laws`.")
      .def("__repr__",
           [](const Drone& d) { return Text("Drone(%s: %.4g kg, %zu rotors)", d.model.name.c_str(), d.model.mass, d.model.rotors.size()); })
      .def_property_readonly(
          "model", [](const Drone& d) { return d.model.name; }, "Name of its kind.")
      .def_readonly("name", &Drone::name, "What it is called in a simulation; empty: by its number.")
      .def_property_readonly(
          "mass", [](const Drone& d) { return d.model.mass; }, "kg")
      .def_property_readonly("inertia", &Inertia, "(3, 3) kg m^2 about the centre of mass, in B.")
      .def_property_readonly("rotors", &Rotors, "Dictionaries, in the order of rotor commands.")
      .def_property_readonly(
          "max_thrust", [](const Drone& d) { return FiguresOf(d.model).max_thrust; }, "N, all rotors")
      .def_property_readonly(
          "hover_speed", [](const Drone& d) { return HoverSpeed(d.model); }, "rad/s of a rotor, all alike, that carry the weight.")
      .def_property_readonly(
          "half_size", [](const Drone& d) { return FromVec3(d.model.half_size_B); }, "(3,) metres: half of length, width and height, in B.")
      .def_readonly("laws", &Drone::laws, "Parameter -> where its figure comes from.")
      .def_readonly("yaml", &Drone::yaml, "The drone as a file that Drone(path) reads.");
  m.def(
      "drone_catalog",
      [] {
        py::dict d;
        for (const CatalogDrone& drone : DroneCatalog()) d[py::str(drone.name.data(), drone.name.size())] = std::string(drone.title);
        return d;
      },
      "Real drones that are known: name -> what it is.");
}

}  // namespace airsim360::python
