#include "airsim360/dataset/export/lossless_video.h"

#include "airsim360/base/error.h"
#include "airsim360/dataset/export/export_job.h"

namespace airsim360::internal {
namespace {

std::vector<std::string> Words(const std::filesystem::path& path, int width, int height, double frame_rate) {
  return {"-f",
          "rawvideo",
          "-pix_fmt",
          "rgb24",
          "-s",
          std::to_string(width) + "x" + std::to_string(height),
          "-r",
          Number(frame_rate),
          "-i",
          "pipe:0",
          "-c:v",
          "ffv1",
          "-level",
          "3",
          "-slices",
          "4",
          "-threads",
          "1",
          "-pix_fmt",
          "bgr0",
          "-fflags",
          "+bitexact",
          "-flags:v",
          "+bitexact",
          "-map_metadata",
          "-1",
          "-f",
          "matroska",
          "-y",
          path.string()};
}

}  // namespace

LosslessVideo::LosslessVideo(std::filesystem::path path, int width, int height, double frame_rate)
    : path_(std::move(path)), run_(Words(path_, width, height, frame_rate), -1) {}

void LosslessVideo::Add(const Image<Rgb8>& picture) {
  if (!run_.Send(std::as_bytes(picture.pixels()))) Finish();
}

void LosslessVideo::Finish() {
  if (!run_.Finish()) throw RuntimeError(path_.string() + ": ffmpeg: " + run_.Complaint());
}

}  // namespace airsim360::internal
