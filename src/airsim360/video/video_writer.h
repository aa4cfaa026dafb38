// 360 degree videos: MP4 files that players show as a sphere to look around in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "airsim360/image/image.h"

namespace airsim360 {

/// What encodes. kAuto takes the first that works here: NVENC, VA-API, x264; H.264 up to 4096 pixels wide, beyond it HEVC in
/// hardware. x264 alone gives the same bytes for the same pictures, whatever the machine and its threads.
inline constexpr const char* kVideoEncoders[] = {"auto", "libx264", "libx265", "h264_nvenc", "hevc_nvenc", "h264_vaapi", "hevc_vaapi"};

struct VideoOptions {
  double frame_rate = 30;           ///< pictures a second: how long a single picture lasts, and how often one is a key frame
  std::string encoder = "libx264";  ///< of kVideoEncoders
  int quality = 18;                 ///< 0 (best) … 51: CRF, CQ or QP of the encoder
  bool spherical = true;            ///< the picture is a whole equirectangular panorama
};

/// Width and height of a video, pixels.
struct VideoSize {
  int width = 0, height = 0;
};

/// InputError naming the option, the value and the nearest choice; or the Debian package where ffmpeg is missing.
void CheckVideoOptions(const VideoOptions& options);
/// The same, and InputError for sizes below 16x16 or above 16384.
void CheckVideo(VideoSize size, const VideoOptions& options);
/// InputError for a folder, or a name that does not end as MP4 files do.
void CheckVideoPath(const std::filesystem::path& path);
/// Whether there is an ffmpeg.
bool HasFfmpeg();

/// Pipes pictures to ffmpeg (a process of its own) and makes its file one of a panorama: H.264 or HEVC, yuv420p, BT.709,
/// limited range, no reordered pictures. Nothing stands at `path` before Finish, whatever happens.
class VideoWriter {
 public:
  /// InputError as CheckVideo and CheckVideoPath; RuntimeError if it cannot write there.
  VideoWriter(std::filesystem::path path, int width, int height, const VideoOptions& options);
  ~VideoWriter();
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// The picture shown from `t_ns` on; waits while ffmpeg is busy. Odd sizes are stretched to the next even one. InputError for
  /// another size or a time that is not later than the last; RuntimeError with ffmpeg's words if it has ended.
  void Add(const Image<Rgb8>& picture, int64_t t_ns);
  /// Waits for ffmpeg and puts the video at its path. RuntimeError if ffmpeg or writing failed, or there was no picture.
  void Finish();

  int64_t pictures() const;
  /// The one that was taken.
  const std::string& encoder() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360
