// airsim360.metrics: pure functions of pictures.
#include <cstring>

#include "airsim360/eval/image_metrics.h"
#include "airsim360/eval/navigation/path_metrics.h"
#include "convert.h"

namespace airsim360::python {
namespace {

/// Converts both pictures, then works without the GIL.
template <class Metric>
auto OfPictures(Metric metric) {
  return [metric](const py::object& a, const py::object& b) {
    const Image<Rgb8> first = ToRgb(a, "a"), second = ToRgb(b, "b");
    const py::gil_scoped_release release;
    return metric(first, second);
  };
}

py::array_t<float> FlipMap(const py::object& reference, const py::object& test, double ppd, bool wrap) {
  const Image<Rgb8> a = ToRgb(reference, "reference"), b = ToRgb(test, "test");
  Image<float> map;
  {
    const py::gil_scoped_release release;
    map = Flip(a, b, {.pixels_per_degree = ppd, .wrap_columns = wrap});
  }
  py::array_t<float> out({map.height(), map.width()});
  std::memcpy(out.mutable_data(), map.pixels().data(), map.size() * sizeof(float));
  return out;
}

}  // namespace

void BindMetrics(py::module_& m) {
  auto metrics = m.def_submodule("metrics", "Metrics: pure functions. Pictures are (H, W, 3) uint8 sRGB of the same size.");
  metrics.def("psnr", OfPictures(&Psnr), py::arg("a"), py::arg("b"), "Peak signal-to-noise ratio, dB; infinity for equal pictures.");
  metrics.def("ws_psnr", OfPictures(&WsPsnr), py::arg("a"), py::arg("b"), "The same for panoramas, every row weighted by its solid angle.");
  metrics.def("ssim", OfPictures(&Ssim), py::arg("a"), py::arg("b"), "Mean structural similarity of luma, at most 1.");
  metrics.def("flip", &FlipMap, py::arg("reference"), py::arg("test"), py::arg("pixels_per_degree") = FlipOptions{}.pixels_per_degree,
              py::arg("wrap") = false, "FLIP of every pixel, (H, W) float32 in 0 … 1; wrap: the left border goes on at the right one.");
  metrics.def(
      "path_length", [](const py::object& path) { return PathLength(ToPoints(path, "path")); }, py::arg("path"),
      "Metres along points (N, 3).");
  metrics.def("spl", &SuccessByLength, py::arg("success"), py::arg("shortest"), py::arg("flown"),
              "Success weighted by path length: success * shortest / max(flown, shortest).");
  metrics.def(
      "ndtw",
      [](const py::object& path, const py::object& reference, double threshold) {
        return NormalizedTimeWarping(ToPoints(path, "path"), ToPoints(reference, "reference"), threshold);
      },
      py::arg("path"), py::arg("reference"), py::arg("threshold"),
      "Normalised dynamic time warping of paths (N, 3), (M, 3), in (0, 1]; threshold: metres that count as "
      "success.");
  BindTaskMetrics(metrics);
  BindCocoMetrics(metrics);
}

}  // namespace airsim360::python
