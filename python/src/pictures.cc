// Pictures from files, by the decoders of airsim360/image; airsim360.pictures reads PNG and EXR without them, slower.
#include "airsim360/base/error.h"
#include "airsim360/image/codecs.h"
#include "handles.h"

namespace airsim360::python {
namespace {

constexpr int64_t kMostBytes = int64_t{1} << 31;  // of a file

py::array_t<uint8_t> ReadRgb(const std::string& path) {
  Image<Rgba8> image;
  {
    const py::gil_scoped_release release;
    image = DecodeRgba8(ReadFile(path, kMostBytes), path);
  }
  py::array_t<uint8_t> rgb({static_cast<py::ssize_t>(image.height()), static_cast<py::ssize_t>(image.width()), py::ssize_t{3}});
  uint8_t* out = rgb.mutable_data();
  for (const Rgba8& pixel : image.pixels()) {
    *out++ = pixel.r;
    *out++ = pixel.g;
    *out++ = pixel.b;
  }
  return rgb;
}

}  // namespace

void BindPictures(py::module_& m) {
  m.def("_read_rgb", &ReadRgb, py::arg("path"),
        "A PNG, JPEG or WebP file as (H, W, 3) uint8 sRGB. ValueError names the file where it is none.");
}

}  // namespace airsim360::python
