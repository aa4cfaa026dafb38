// Between latitude, longitude and the world frame.
#include "airsim360/math/geodesy.h"

#include "airsim360/base/error.h"
#include "handles.h"

namespace airsim360::python {
namespace {

GeoFrame MakeFrame(double latitude_deg, double longitude_deg, double altitude) {
  if (!(latitude_deg >= -90 && latitude_deg <= 90)) throw InputError(Text("latitude_deg: %g is not in -90 ... 90", latitude_deg));
  if (!(longitude_deg >= -180 && longitude_deg <= 180)) throw InputError(Text("longitude_deg: %g is not in -180 ... 180", longitude_deg));
  return GeoFrame({latitude_deg, longitude_deg, Finite(altitude, "altitude")});
}

/// One row (3,) or many (N, 3), turned by `convert` and given back in the same shape.
template <class Convert>
py::object Rows(const py::object& value, const char* what, const Convert& convert) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
  if (array && array.ndim() == 1) return FromVec3(convert(ToVec3(value, what)));
  std::vector<Vec3d> rows = ToPoints(value, what);
  for (Vec3d& row : rows) row = convert(row);
  return FromPoints(rows);
}

Vec3d Geodetic(const GeoFrame& frame, Vec3d p_W) {
  const GeoPoint g = frame.ToGeodetic(p_W);
  return {g.latitude_deg, g.longitude_deg, g.altitude};
}

}  // namespace

void BindGeodesy(py::module_& m) {
  py::class_<GeoFrame>(m, "GeoFrame", R"(The world frame W (east, north, up) at a place of the Earth (WGS 84 ellipsoid).

latitude_deg, longitude_deg: degrees, -90 … 90 and -180 … 180; altitude: metres over the ellipsoid. The frame is a tangent plane:
altitude grows with the square of the distance (8 cm at 1 km). Simulation.geo_frame is that of satellite receivers.)")
      .def(py::init(&MakeFrame), py::arg("latitude_deg"), py::arg("longitude_deg"), py::arg("altitude") = 0.0)
      .def_property_readonly(
          "origin",
          [](const GeoFrame& f) {
            return FromVec3({f.origin().latitude_deg, f.origin().longitude_deg, f.origin().altitude});
          },
          "Latitude, longitude (degrees) and altitude of W's origin.")
      .def(
          "to_world",
          [](const GeoFrame& f, const py::object& places) {
            return Rows(places, "places", [&](Vec3d v) { return f.ToWorld({v.x, v.y, v.z}); });
          },
          py::arg("places"), "Latitude, longitude (degrees), altitude (metres), (3,) or (N, 3) -> metres in W, the same shape.")
      .def(
          "to_geodetic",
          [](const GeoFrame& f, const py::object& points) { return Rows(points, "points", [&](Vec3d p) { return Geodetic(f, p); }); },
          py::arg("points"), "Metres in W, (3,) or (N, 3) -> latitude, longitude (degrees), altitude (metres), the same shape.")
      .def("__repr__", [](const GeoFrame& f) {
        const GeoPoint& g = f.origin();
        return Text("GeoFrame(%.7f, %.7f, %.3f)", g.latitude_deg, g.longitude_deg, g.altitude);
      });
}

}  // namespace airsim360::python
