#include "airsim360/video/video_writer.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "airsim360/base/choice.h"
#include "airsim360/base/error.h"
#include "airsim360/base/file.h"
#include "airsim360/video/ffmpeg.h"
#include "airsim360/video/spherical_mp4.h"

namespace airsim360 {
namespace {

namespace fs = std::filesystem;
using internal::FfmpegRun;
using Words = std::vector<std::string>;

constexpr int kLeastSide = 16, kMostSide = 16384;
constexpr int kWidestH264 = 4096;  // that hardware encodes and most players decode

bool Exists(const char* path) {
  std::error_code error;
  return fs::exists(path, error);
}

std::string RenderNode() {
  std::error_code none;
  std::vector<std::string> nodes;
  for (const auto& entry : fs::directory_iterator("/dev/dri", none)) {
    if (entry.path().filename().string().starts_with("renderD")) nodes.push_back(entry.path().string());
  }
  return nodes.empty() ? "" : *std::ranges::min_element(nodes);
}

std::string SizeText(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

// What follows the input: conversion of colours, encoder, its quality. Threads are fixed: x264's bytes depend on their number.
Words EncodeWords(const std::string& encoder, int width, int height, const VideoOptions& options) {
  const bool vaapi = encoder.ends_with("vaapi"), nvenc = encoder.ends_with("nvenc");
  const std::string scale = "scale=" + std::to_string(width + width % 2) + ":" + std::to_string(height + height % 2) +
                            ":in_range=full:out_range=limited:out_color_matrix=bt709:flags=bicubic+accurate_rnd+full_chroma_int";
  const std::string quality = std::to_string(options.quality);
  const int group = std::clamp(static_cast<int>(std::lround(2 * options.frame_rate)), 1, 250);
  Words words = {
      "-vf", scale + (vaapi ? ",format=nv12,hwupload" : ",format=yuv420p"), "-c:v", encoder, "-bf", "0", "-g", std::to_string(group)};
  const auto add = [&](const Words& more) { words.insert(words.end(), more.begin(), more.end()); };
  if (nvenc) add({"-preset", "p5", "-rc", "vbr", "-cq", quality, "-b:v", "0"});
  if (vaapi) add({"-rc_mode", "CQP", "-qp", quality});
  if (!nvenc && !vaapi) add({"-preset", "medium", "-crf", quality, "-threads", "8"});
  if (encoder == "libx265") add({"-x265-params", "log-level=error:bframes=0:pools=4:frame-threads=1"});
  if (!encoder.starts_with("h264") && encoder != "libx264") add({"-tag:v", "hvc1"});
  add({"-color_primaries", "bt709", "-color_trc", "bt709", "-colorspace", "bt709", "-color_range", "tv"});
  return words;
}

Words DeviceWords(const std::string& encoder) {
  if (!encoder.ends_with("vaapi")) return {};
  return {"-vaapi_device", RenderNode()};
}

// Whether two gray pictures of that size can be encoded.
bool Works(const std::string& encoder, int width, int height, const VideoOptions& options) {
  Words words = DeviceWords(encoder);
  const auto add = [&](const Words& more) { words.insert(words.end(), more.begin(), more.end()); };
  add({"-f", "lavfi", "-i", "color=c=gray:s=" + SizeText(width, height) + ":r=30", "-frames:v", "2"});
  add(EncodeWords(encoder, width, height, options));
  add({"-f", "null", "-"});
  return FfmpegRun(words, -1).Finish();
}

std::string ChooseEncoder(int width, int height, const VideoOptions& options) {
  if (options.encoder != "auto") return options.encoder;
  const std::string codec = width <= kWidestH264 ? "h264" : "hevc";
  // Machines without such devices are not asked.
  const bool nvidia = Exists("/dev/nvidiactl") || Exists("/dev/dxg");
  if (nvidia && Works(codec + "_nvenc", width, height, options)) return codec + "_nvenc";
  if (!RenderNode().empty() && Works(codec + "_vaapi", width, height, options)) return codec + "_vaapi";
  return "libx264";
}

// A file without a name in the folder of the video: nothing is left of it however the program ends.
internal::OwnedFd NamelessFile(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::string name = (folder / "video-XXXXXX.tmp").string();
  internal::OwnedFd file(::mkostemps(name.data(), 4, O_CLOEXEC));
  if (file.get() < 0) throw RuntimeError(path.string() + ": cannot write: " + std::strerror(errno));
  ::unlink(name.c_str());
  return file;
}

}  // namespace

void CheckVideoOptions(const VideoOptions& options) {
  ParseChoice<size_t>("encoder", options.encoder, kVideoEncoders, "encoder");
  if (options.encoder.ends_with("vaapi") && RenderNode().empty())
    throw InputError("encoder: '" + options.encoder + "' needs a GPU (/dev/dri/renderD*), which this machine lacks; use auto");
  if (options.quality < 0 || options.quality > 51)
    throw InputError("quality: " + std::to_string(options.quality) + " is not in 0 (best) … 51");
  if (!(options.frame_rate >= 0.001 && options.frame_rate <= 1000))
    throw InputError("fps: " + std::to_string(options.frame_rate) + " is not in 0.001 … 1000 pictures a second");
  internal::FindFfmpeg();
}

void CheckVideo(VideoSize size, const VideoOptions& options) {
  CheckVideoOptions(options);
  if (std::min(size.width, size.height) < kLeastSide || std::max(size.width, size.height) > kMostSide)
    throw InputError("video: " + SizeText(size.width, size.height) + " is not within 16 … 16384 pixels a side");
}

void CheckVideoPath(const fs::path& path) {
  if (path.filename().empty() || fs::is_directory(path)) throw InputError("video: '" + path.string() + "' is a folder; give a file name");
  const std::string extension = path.extension().string();
  if (extension == ".mp4" || extension == ".m4v" || extension == ".mov") return;
  const std::string nearest = fs::path(path).replace_extension(".mp4").string();
  throw InputError("video: '" + path.string() + "' is not the name of an MP4 file; did you mean '" + nearest + "'?");
}

bool HasFfmpeg() {
  try {
    internal::FindFfmpeg();
    return true;
  } catch (const InputError&) {
    return false;
  }
}

struct VideoWriter::Impl {
  fs::path path;
  int width, height;
  VideoOptions options;
  std::string encoder;
  internal::OwnedFd file;
  std::optional<FfmpegRun> ffmpeg;
  std::vector<int64_t> times_ns;
};

VideoWriter::VideoWriter(fs::path path, int width, int height, const VideoOptions& options)
    : impl_(new Impl{std::move(path), width, height, options, {}, internal::OwnedFd(), {}, {}}) {
  CheckVideo({width, height}, options);
  CheckVideoPath(impl_->path);
  if (impl_->path.has_parent_path()) CreateWritableFolder(impl_->path.parent_path());
  impl_->file = NamelessFile(impl_->path);
  impl_->encoder = ChooseEncoder(width, height, options);

  char rate[32];
  std::snprintf(rate, sizeof rate, "%.6g", std::clamp(options.frame_rate, 1.0, 240.0));
  Words words = DeviceWords(impl_->encoder);
  const auto add = [&](const Words& more) { words.insert(words.end(), more.begin(), more.end()); };
  add({"-f", "rawvideo", "-pixel_format", "rgb24", "-video_size", SizeText(width, height), "-framerate", rate, "-i", "pipe:0"});
  add({"-an", "-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact"});
  add(EncodeWords(impl_->encoder, width, height, options));
  add({"-video_track_timescale", "90000", "-f", "mp4", "/dev/fd/3"});
  impl_->ffmpeg.emplace(words, impl_->file.get());
}

VideoWriter::~VideoWriter() = default;

void VideoWriter::Add(const Image<Rgb8>& picture, int64_t t_ns) {
  if (!impl_->ffmpeg) throw InputError("video: it is finished already");
  if (picture.width() != impl_->width || picture.height() != impl_->height)
    throw InputError("video: a picture of " + SizeText(picture.width(), picture.height()) + " in a video of " +
                     SizeText(impl_->width, impl_->height));
  if (!impl_->times_ns.empty() && t_ns <= impl_->times_ns.back())
    throw InputError("video: a picture at " + std::to_string(t_ns) + " ns after one at " + std::to_string(impl_->times_ns.back()) + " ns");
  impl_->times_ns.push_back(t_ns);
  if (impl_->ffmpeg->Send(std::as_bytes(picture.pixels()))) return;
  impl_->ffmpeg->Finish();
  throw RuntimeError("ffmpeg (" + impl_->encoder + "): " + impl_->ffmpeg->Complaint());
}

void VideoWriter::Finish() {
  if (!impl_->ffmpeg) throw InputError("video: it is finished already");
  if (impl_->times_ns.empty()) throw RuntimeError(impl_->path.string() + ": a video without pictures");
  const bool content = impl_->ffmpeg->Finish();
  const std::string complaint = impl_->ffmpeg->Complaint();
  impl_->ffmpeg.reset();
  if (!content) throw RuntimeError("ffmpeg (" + impl_->encoder + "): " + complaint);
  const auto lone_ns = static_cast<int64_t>(1e9 / impl_->options.frame_rate);
  internal::WriteMovie(impl_->file.get(), impl_->options.spherical, impl_->times_ns, lone_ns, impl_->path);
}

int64_t VideoWriter::pictures() const { return static_cast<int64_t>(impl_->times_ns.size()); }
const std::string& VideoWriter::encoder() const { return impl_->encoder; }

}  // namespace airsim360
