// Between Python values and ours. Vectors, poses and points are arrays of float64; pictures are views.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "airsim360/image/image.h"
#include "airsim360/math/transform.h"

namespace airsim360::python {

namespace py = pybind11;

/// Three numbers within kCoordinateLimit (math/coordinate_limit.h); ValueError naming `what` otherwise.
Vec3d ToVec3(const py::handle& value, const char* what);
/// (N, 3) such numbers; ValueError naming `what` otherwise.
std::vector<Vec3d> ToPoints(const py::handle& value, const char* what);

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
/// An array or nested lists of real numbers (no booleans, complex numbers, texts or objects) as float64. Where a masked array hides an
/// element it is `masked`; without `masked`, hidden elements are refused. ValueError naming `what` and the dtype otherwise.
Doubles ToNumbers(const py::handle& value, const char* what, std::optional<double> masked = {});
/// The array of `value` and, where a masked array hides elements, which (else nothing); refuses them unless `may_hide`.
struct PlainArray {
  py::array values;
  std::optional<py::array_t<bool, py::array::c_style | py::array::forcecast>> hidden;
};
PlainArray ToPlainArray(const py::handle& value, const char* what, bool may_hide);
/// ValueError "what: numbers of the dtype …: text".
[[noreturn]] void RefuseDtype(const py::array& array, const char* what, const char* text);
/// A whole number in low … high; ValueError naming `what` and the nearest one otherwise, also for 256.0 and the like.
int64_t ToWhole(const py::handle& value, const char* what, int64_t low, int64_t high);
/// The same in 0 … 2^64 - 1.
uint64_t ToSeed(const py::handle& value);
/// (3,) or (N, 3) such numbers as ToPoints takes.
struct PointOrPoints {
  std::vector<Vec3d> points;
  bool one = false;  ///< (3,)
};
PointOrPoints ToPointOrPoints(const py::handle& value, const char* what);
/// A finite number; ValueError naming `what` otherwise.
double Finite(double value, const char* what);

py::array_t<double> FromVec3(Vec3d v);                             ///< (3,)
py::array_t<double> FromQuaternion(const Quaternion& q);           ///< (4,): w, x, y, z
py::array_t<double> FromPose(const RigidTransform& X);             ///< (4, 4)
py::array_t<double> FromPoints(const std::vector<Vec3d>& points);  ///< (N, 3)

/// An array that shows `data`, which `owner` keeps alive; nothing is copied.
template <class T>
py::array View(const T* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides, const py::handle& owner) {
  return py::array(py::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
}

/// A picture of scalars as (H, W), or of `channels` scalars T a pixel as (H, W, channels); None if empty.
template <class T, class Pixel>
py::object ImageView(const Image<Pixel>& image, int channels, const py::handle& owner) {
  if (image.empty()) return py::none();
  const auto pixel = static_cast<py::ssize_t>(sizeof(Pixel));
  std::vector<py::ssize_t> shape = {image.height(), image.width()}, strides = {pixel * image.width(), pixel};
  if (channels > 0) {
    shape.push_back(channels);
    strides.push_back(sizeof(T));
  }
  return View(reinterpret_cast<const T*>(image.pixels().data()), shape, strides, owner);
}

/// A picture (an array) as an object that DLPack consumers take.
py::object ToTensor(const py::object& picture);

/// What __repr__ is made of: printf into a string; "(x, y, z)" to the millimetre; words with commas between.
[[gnu::format(printf, 1, 2)]] std::string Text(const char* format, ...);
std::string Text(Vec3d v);
std::string Joined(const std::vector<std::string>& words);
inline double Seconds(int64_t t_ns) { return static_cast<double>(t_ns) * 1e-9; }

/// (H, W, 3) uint8 as a picture (copied); ValueError naming `what` otherwise.
Image<Rgb8> ToRgb(const py::handle& value, const char* what);

// One function for each file of the module.
void BindWorld(py::module_& m);
void BindDrone(py::module_& m);
void BindTensor(py::module_& m);
void BindCapture(py::module_& m);
void BindLidar(py::module_& m);
void BindState(py::module_& m);
void BindSimulation(py::module_& m);
void BindPlanning(py::module_& m);
void BindMetrics(py::module_& m);
void BindTaskMetrics(py::module_& metrics);
void BindCocoMetrics(py::module_& metrics);
void BindVideo(py::module_& m);
void BindGeodesy(py::module_& m);
void BindPictures(py::module_& m);
void BindVectorEnvironment(py::module_& m);
void BindPlanFrames(py::module_& m);

}  // namespace airsim360::python
