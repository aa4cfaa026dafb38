// Flags of `fly` and `video` that say how a video is encoded.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "airsim360/video/video_writer.h"

namespace airsim360 {

struct VideoArguments {
  std::string encoder = "auto";
  int quality = VideoOptions{}.quality;

  /// Adds --encoder and --quality; this object must outlive the parsing.
  void AddTo(CLI::App& command);
  /// For a video of that rate. InputError naming the flag and the value, or the Debian package of a missing ffmpeg.
  VideoOptions Options(double frame_rate) const;
};

}  // namespace airsim360
