// Videos of labels: FFV1 in Matroska, which gives back every bit.
#pragma once

#include <filesystem>

#include "airsim360/image/image.h"
#include "airsim360/video/ffmpeg.h"

namespace airsim360::internal {

/// The bytes depend on the pictures alone. InputError naming the Debian package where ffmpeg is missing.
class LosslessVideo {
 public:
  LosslessVideo(std::filesystem::path path, int width, int height, double frame_rate);
  /// RuntimeError with ffmpeg's words if it has ended.
  void Add(const Image<Rgb8>& picture);
  void Finish();

 private:
  std::filesystem::path path_;
  FfmpegRun run_;
};

}  // namespace airsim360::internal
