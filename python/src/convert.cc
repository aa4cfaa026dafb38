#include "convert.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "airsim360/base/error.h"
#include "airsim360/math/coordinate_limit.h"

namespace airsim360::python {
namespace {

Doubles ToDoubles(const py::handle& value, const char* what) {
  Doubles array = ToNumbers(value, what);
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    const double number = Finite(array.data()[i], what);
    if (std::abs(number) > kCoordinateLimit) throw InputError(std::string(what) + ": " + BeyondLimitText(number));
  }
  return array;
}

std::string ShapeText(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
  return text + ")";
}

}  // namespace

void RefuseDtype(const py::array& array, const char* what, const char* text) {
  throw InputError(std::string(what) + ": an array of dtype " + py::str(array.dtype()).cast<std::string>() + "; " + text);
}

PlainArray ToPlainArray(const py::handle& value, const char* what, bool may_hide) {
  const py::object ma = py::module_::import("numpy.ma"), masked_type = ma.attr("MaskedArray");
  // NumPy drops the masks of arrays in a list.
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    for (const py::handle one : py::reinterpret_borrow<py::sequence>(value)) {
      if (py::isinstance(one, masked_type)) throw InputError(std::string(what) + ": a list of masked arrays; join them by numpy.ma.stack");
    }
  }
  PlainArray plain;
  py::object data = py::reinterpret_borrow<py::object>(value);
  if (py::isinstance(value, masked_type)) {
    if (ma.attr("is_masked")(value).cast<bool>()) {
      if (!may_hide)
        throw InputError(std::string(what) + ": a masked array that hides elements, and this argument has no notion of what is not valid");
      plain.hidden = ma.attr("getmaskarray")(value);
    }
    data = ma.attr("getdata")(value);
  }
  plain.values = py::array::ensure(data);
  if (!plain.values) {
    PyErr_Clear();
    throw InputError(std::string(what) + ": not an array of numbers");
  }
  return plain;
}

Doubles ToNumbers(const py::handle& value, const char* what, std::optional<double> masked) {
  const PlainArray plain = ToPlainArray(value, what, masked.has_value());
  const char kind = plain.values.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') RefuseDtype(plain.values, what, "not an array of real numbers");
  Doubles array = Doubles::ensure(plain.values);
  if (!plain.hidden) return array;
  // The caller's own array stays as it is.
  Doubles copy(std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()));
  for (py::ssize_t i = 0; i < array.size(); ++i) copy.mutable_data()[i] = plain.hidden->data()[i] ? *masked : array.data()[i];
  return copy;
}

double Finite(double value, const char* what) {
  if (!std::isfinite(value)) throw InputError(std::string(what) + ": " + std::to_string(value) + " is not a finite number");
  return value;
}

Vec3d ToVec3(const py::handle& value, const char* what) {
  const Doubles a = ToDoubles(value, what);
  if (a.ndim() != 1 || a.shape(0) != 3) throw InputError(std::string(what) + ": shape " + ShapeText(a) + " is not (3,)");
  return {a.data()[0], a.data()[1], a.data()[2]};
}

std::vector<Vec3d> ToPoints(const py::handle& value, const char* what) {
  const Doubles a = ToDoubles(value, what);
  if (a.ndim() != 2 || a.shape(1) != 3) throw InputError(std::string(what) + ": shape " + ShapeText(a) + " is not (N, 3)");
  std::vector<Vec3d> points(static_cast<size_t>(a.shape(0)));
  for (size_t i = 0; i < points.size(); ++i) points[i] = {a.data()[3 * i], a.data()[3 * i + 1], a.data()[3 * i + 2]};
  return points;
}

PointOrPoints ToPointOrPoints(const py::handle& value, const char* what) {
  const Doubles a = ToDoubles(value, what);
  if (a.ndim() == 1 && a.shape(0) == 3) return {{{a.data()[0], a.data()[1], a.data()[2]}}, true};
  if (a.ndim() != 2 || a.shape(1) != 3) throw InputError(std::string(what) + ": shape " + ShapeText(a) + " is neither (3,) nor (N, 3)");
  return {ToPoints(a, what), false};
}

namespace {

// What Python calls a whole number, as one; else ValueError.
py::int_ Whole(const py::handle& value, const char* what) {
  if (PyIndex_Check(value.ptr()) && !PyBool_Check(value.ptr())) return py::reinterpret_steal<py::int_>(PyNumber_Index(value.ptr()));
  std::string text = std::string(what) + ": " + py::repr(value).cast<std::string>() + " is not a whole number";
  if (PyFloat_Check(value.ptr()) && std::isfinite(PyFloat_AS_DOUBLE(value.ptr())))
    text += "; did you mean " + std::to_string(std::llround(PyFloat_AS_DOUBLE(value.ptr()))) + "?";
  throw InputError(text);
}

[[noreturn]] void RefuseRange(const py::int_& value, const char* what, const std::string& low, const std::string& high, bool below) {
  throw InputError(std::string(what) + ": " + py::repr(value).cast<std::string>() + " is not in " + low + " … " + high +
                   "; the nearest is " + (below ? low : high));
}

}  // namespace

int64_t ToWhole(const py::handle& value, const char* what, int64_t low, int64_t high) {
  const py::int_ whole = Whole(value, what);
  int beyond = 0;
  const int64_t number = PyLong_AsLongLongAndOverflow(whole.ptr(), &beyond);
  if (beyond == 0 && number >= low && number <= high) return number;
  RefuseRange(whole, what, std::to_string(low), std::to_string(high), beyond < 0 || (beyond == 0 && number < low));
}

uint64_t ToSeed(const py::handle& value) {
  const py::int_ whole = Whole(value, "seed");
  const uint64_t seed = PyLong_AsUnsignedLongLong(whole.ptr());
  if (PyErr_Occurred() == nullptr) return seed;
  PyErr_Clear();
  RefuseRange(whole, "seed", "0", "18446744073709551615", whole < py::int_(0));
}

py::array_t<double> FromVec3(Vec3d v) {
  py::array_t<double> a(3);
  for (int i = 0; i < 3; ++i) a.mutable_data()[i] = v[i];
  return a;
}

py::array_t<double> FromQuaternion(const Quaternion& q) {
  py::array_t<double> a(4);
  const double values[4] = {q.w, q.x, q.y, q.z};
  std::memcpy(a.mutable_data(), values, sizeof(values));
  return a;
}

py::array_t<double> FromPose(const RigidTransform& X) {
  py::array_t<double> a({4, 4});
  double* out = a.mutable_data();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out[4 * i + j] = X.R.m[i][j];
    out[4 * i + 3] = X.p[i];
    out[12 + i] = 0;
  }
  out[15] = 1;
  return a;
}

py::array_t<double> FromPoints(const std::vector<Vec3d>& points) {
  py::array_t<double> a({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  static_assert(sizeof(Vec3d) == 3 * sizeof(double));
  if (!points.empty()) std::memcpy(a.mutable_data(), points.data(), points.size() * sizeof(Vec3d));
  return a;
}

Image<Rgb8> ToRgb(const py::handle& value, const char* what) {
  const auto a = py::array_t<uint8_t, py::array::c_style>::ensure(value);
  if (!a || a.ndim() != 3 || a.shape(2) != 3 || !py::isinstance<py::array_t<uint8_t>>(value)) {
    PyErr_Clear();
    throw InputError(std::string(what) + ": not a picture of shape (H, W, 3) and type uint8");
  }
  Image<Rgb8> image(static_cast<int>(a.shape(1)), static_cast<int>(a.shape(0)));
  if (!image.empty()) std::memcpy(image.pixels().data(), a.data(), image.size() * sizeof(Rgb8));
  return image;
}

std::string Text(const char* format, ...) {
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  std::string text(static_cast<size_t>(std::max(0, std::vsnprintf(nullptr, 0, format, arguments))), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(arguments);
  return text;
}

std::string Text(Vec3d v) { return Text("(%.3f, %.3f, %.3f)", v.x, v.y, v.z); }

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace airsim360::python
