// 360 degree videos from Python.
#include "airsim360/video/video_writer.h"

#include <cmath>
#include <optional>

#include "airsim360/base/error.h"
#include "handles.h"

namespace airsim360::python {
namespace {

class Video {
 public:
  Video(const std::string& path, int width, int height, double fps, bool spherical, const std::string& encoder, int quality)
      : path_(path), fps_(fps), width_(width), height_(height) {
    options_ = {.frame_rate = fps, .encoder = encoder, .quality = quality, .spherical = spherical};
    CheckVideoOptions(options_);
    CheckVideoPath(path_);
    if (width != 0 || height != 0) CheckVideo({width, height}, options_);
  }

  void Add(const py::object& picture, const std::optional<double>& t) {
    std::optional<Image<Rgb8>> copy;
    const Image<Rgb8>* rgb = nullptr;
    std::optional<int64_t> t_ns;
    if (py::isinstance<Capture>(picture)) {
      const auto& capture = picture.cast<const Capture&>();
      rgb = &capture.frame.rgb;
      t_ns = capture.t_ns;
      if (rgb->empty()) throw InputError("add: the capture has no rgb");
    } else {
      rgb = &copy.emplace(ToRgb(picture, "picture"));
    }
    if (t) t_ns = std::llround(Finite(*t, "t") * 1e9);
    const py::gil_scoped_release release;
    const std::lock_guard lock(mutex_);
    // Captures of a world all have time 0, and a simulation may go back.
    const bool given = t.has_value();
    const bool later = t_ns && (count_ == 0 || *t_ns > last_ns_);
    if (!given && !later) t_ns = count_ == 0 ? 0 : last_ns_ + std::llround(1e9 / fps_);
    if (closed_) throw InputError("add: the video is closed");
    if (!writer_) {
      if (width_ == 0) width_ = rgb->width(), height_ = rgb->height();
      writer_ = std::make_unique<VideoWriter>(path_, width_, height_, options_);
    }
    writer_->Add(*rgb, *t_ns);
    last_ns_ = *t_ns;
    ++count_;
  }

  // Puts the file at its path, or drops it.
  void Close(bool keep) {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    closed_ = true;
    const auto writer = std::move(writer_);
    if (!keep) return;
    if (!writer) throw RuntimeError(path_ + ": a video without pictures");
    encoder_ = writer->encoder();
    writer->Finish();
  }

  std::string encoder() {
    const std::lock_guard lock(mutex_);
    return writer_ ? writer_->encoder() : encoder_;
  }
  int64_t count() const { return count_; }

 private:
  std::string path_, encoder_;
  double fps_;
  int width_, height_;
  VideoOptions options_;
  std::mutex mutex_;  // never waited for with the GIL held
  std::unique_ptr<VideoWriter> writer_;
  int64_t count_ = 0, last_ns_ = 0;
  bool closed_ = false;
};

}  // namespace

void BindVideo(py::module_& m) {
  py::class_<Video>(m, "VideoWriter", R"(A 360 degree video (MP4) that players show as a sphere; needs the program ffmpeg.

    with airsim360.VideoWriter("flight.mp4", fps=30) as video:
        for _ in range(90):
            sim.run(1 / 30)
            video.add(sim.capture(rig))

The file appears when the block ends; after an exception there is none. width, height: 0 = of the first picture. spherical: say that
the picture is a whole panorama. encoder: auto, libx264 (the same bytes everywhere), libx265, h264_nvenc, hevc_nvenc, h264_vaapi,
hevc_vaapi. quality: 0 (best) ... 51.)")
      .def(py::init<const std::string&, int, int, double, bool, const std::string&, int>(), py::arg("path"), py::arg("width") = 0,
           py::arg("height") = 0, py::arg("fps") = 30.0, py::arg("spherical") = true, py::arg("encoder") = "auto",
           py::arg("quality") = VideoOptions{}.quality)
      .def(
          "add", &Video::Add, py::arg("picture"), py::arg("t") = py::none(),
          "A Capture (shown from its t_ns on if that is later than the last picture) or (H, W, 3) uint8; else 1 / fps after the last. t: seconds "
          "instead.")
      .def(
          "close",
          [](Video& v) {
            const py::gil_scoped_release release;
            v.Close(true);
          },
          "Waits for ffmpeg and puts the video at its path.")
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__",
           [](Video& v, const py::object& type, const py::object&, const py::object&) {
             const bool keep = type.is_none();
             const py::gil_scoped_release release;
             v.Close(keep);
           })
      .def_property_readonly("encoder", &Video::encoder, py::call_guard<py::gil_scoped_release>(),
                             "The one that was taken, once there is a picture.")
      .def("__len__", &Video::count);
}

}  // namespace airsim360::python
