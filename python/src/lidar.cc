// Lidars and what a turn of one gives: arrays are views of the scan's own memory.
#include <cmath>

#include "airsim360/base/error.h"
#include "simulation.h"

namespace airsim360::python {
namespace {

double InRange(double value, double low, double high, const char* what) {
  if (value >= low && value <= high) return value;
  throw InputError(std::string(what) + ": " + std::to_string(value) + " is not in " + std::to_string(low) + " ... " + std::to_string(high));
}

double DegreesIn(double angle, double low, double high, const char* what) { return InRange(angle, low, high, what) * 180 / M_PI; }

Lidar MakeLidar(uint64_t channels, uint64_t columns, double low, double high, double start, double sweep, const std::string& pattern,
                double field, double rate, double min_range, double max_range, double sigma, double dropout, bool through_panes,
                bool motion_distortion, const py::object& position, double yaw, double pitch, double roll) {
  constexpr double kSlack = 1e-9;  // of pi, as scripts round it
  constexpr double kQuarter = M_PI / 2 + kSlack, kTurn = 2 * M_PI + kSlack;
  LidarSpec spec;
  spec.channels = channels;
  spec.columns = columns;
  spec.low_deg = DegreesIn(low, -kQuarter, kQuarter, "low");
  spec.high_deg = DegreesIn(high, -kQuarter, kQuarter, "high");
  spec.start_deg = DegreesIn(start, -kTurn, kTurn, "start");
  spec.sweep_deg = DegreesIn(sweep, 0, kTurn, "sweep");
  spec.pattern = pattern;
  spec.field_deg = DegreesIn(field, 0, M_PI + kSlack, "field");
  spec.rate_hz = InRange(rate, 0.01, 1000, "rate");
  spec.min_range = InRange(min_range, 0, 1e4, "min_range");
  spec.max_range = InRange(max_range, 0, 1e5, "max_range");
  spec.sigma = InRange(sigma, 0, 100, "sigma");
  spec.dropout = InRange(dropout, 0, 1, "dropout");
  spec.through_panes = through_panes;
  spec.motion_distortion = motion_distortion;
  spec.Check();
  return {spec, BodyPose(ToVec3(position, "position"), Finite(yaw, "yaw"), Finite(pitch, "pitch"), Finite(roll, "roll"))};
}

// One field of every point, as `width` scalars T (0: one, without an axis of its own).
template <class T, class Field>
auto Column(Field LidarPoint::*field, py::ssize_t width = 0) {
  return [field, width](const py::object& self) {
    const std::vector<LidarPoint>& points = self.cast<const LidarScan&>().points;
    static const LidarPoint kNone;
    const LidarPoint& first = points.empty() ? kNone : points.front();
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(points.size())}, strides = {sizeof(LidarPoint)};
    if (width > 0) {
      shape.push_back(width);
      strides.push_back(sizeof(T));
    }
    return View(reinterpret_cast<const T*>(&(first.*field)), shape, strides, self);
  };
}

}  // namespace

void BindLidar(py::module_& m) {
  py::class_<Lidar>(m, "Lidar", R"(A lidar on a drone.

channels: beams above each other from elevation `low` to `high`; columns: shots of each in one turn, from azimuth `start`
(to the left of forward) over `sweep`, clockwise seen from above. pattern: spinning, or rosette (channels * columns shots
in a cone of full opening `field`). rate: turns a second. min_range, max_range, sigma (noise): metres. dropout: share of
points lost. through_panes: clear glass is not seen. motion_distortion: each shot leaves at its own time. position (3,),
yaw, pitch, roll: the mount in B. Radians. The default is AirSim's lidar.)")
      .def(py::init(&MakeLidar), py::arg("channels") = 16, py::arg("columns") = 625, py::arg("low") = -M_PI / 4,
           py::arg("high") = -M_PI / 12, py::arg("start") = M_PI, py::arg("sweep") = 2 * M_PI, py::arg("pattern") = "spinning",
           py::arg("field") = 70 * M_PI / 180, py::arg("rate") = 10.0, py::arg("min_range") = 0.3, py::arg("max_range") = 100.0,
           py::arg("sigma") = 0.02, py::arg("dropout") = 0.0, py::arg("through_panes") = false, py::arg("motion_distortion") = false,
           py::arg("position") = py::make_tuple(0.0, 0.0, 0.0), py::arg("yaw") = 0.0, py::arg("pitch") = 0.0, py::arg("roll") = 0.0)
      .def("__repr__",
           [](const Lidar& l) {
             return Text("Lidar(%dx%d shots, %g ... %g m)", static_cast<int>(l.spec.channels), static_cast<int>(l.spec.columns),
                         l.spec.min_range, l.spec.max_range);
           })
      .def_property_readonly(
          "channels", [](const Lidar& l) { return l.spec.channels; }, "Beams above each other.")
      .def_property_readonly(
          "columns", [](const Lidar& l) { return l.spec.columns; }, "Shots of each beam in one turn.");

  py::class_<LidarScan, std::shared_ptr<LidarScan>>(
      m, "LidarScan", R"(One turn of a lidar, which ends at t_ns: points in the order of their shots, without those that met nothing.

S: +X forward, +Y left, +Z up. Arrays are views of this object's memory (no copies).)")
      .def_property_readonly("points", Column<float>(&LidarPoint::p_S, 3),
                             "(N, 3) float32, metres in S at the time of the scan, with noise.")
      .def_property_readonly("range", Column<float>(&LidarPoint::range), "(N,) float32, metres along the shot.")
      .def_property_readonly("intensity", Column<float>(&LidarPoint::intensity),
                             "(N,) float32, 0 … 1: reflectance times the cosine of the angle of incidence.")
      .def_property_readonly("time", Column<float>(&LidarPoint::time), "(N,) float32, seconds before the scan's time (<= 0).")
      .def_property_readonly("semantic", Column<CategoryId>(&LidarPoint::category), "(N,) uint16, category id.")
      .def_property_readonly("entity", Column<EntityId>(&LidarPoint::entity), "(N,) uint32, entity id.")
      .def_property_readonly("shot", Column<uint32_t>(&LidarPoint::shot), "(N,) uint32, column * channels + channel.")
      .def_property_readonly(
          "pose", [](const LidarScan& s) { return FromPose(s.X_WS); }, "(4, 4) X_WS: p_W = X_WS p_S.")
      .def_readonly("shots", &LidarScan::shots, "Shots of the turn, those that met nothing too.")
      .def_readonly("t_ns", &LidarScan::t_ns, "Time of the scan, nanoseconds.")
      .def("__repr__",
           [](const LidarScan& s) {
             return Text("LidarScan(%zu points of %lld shots, t = %.3f s)", s.points.size(), static_cast<long long>(s.shots),
                         Seconds(s.t_ns));
           })
      .def("__len__", [](const LidarScan& s) { return s.points.size(); });
}

void BindScanning(py::class_<Simulation>& sim) {
  sim.def(
         "scan",
         [](Simulation& s, const Lidar& lidar, const py::object& drone) {
           const size_t i = s.Find(drone);
           const py::gil_scoped_release release;
           return s.Scan(lidar, i);
         },
         py::arg_v("lidar", Lidar{}, "Lidar()"), py::arg("drone") = 0,
         "LidarScan of one turn now, with other drones and people in it; its own body is hidden. Changes nothing.")
      .def(
          "scan",
          [](Simulation& s, const std::string& lidar, const py::object& drone) {
            const size_t i = s.Find(drone);
            const py::gil_scoped_release release;
            return s.Scan(lidar, i);
          },
          py::arg("lidar"), py::arg("drone") = 0, "The same by the lidar of that name in the drone's sensor file.");
}

}  // namespace airsim360::python
