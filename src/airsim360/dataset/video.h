// Videos of flights and of datasets.
#pragma once

#include <filesystem>
#include <optional>

#include "airsim360/dataset/collector.h"
#include "airsim360/video/video_writer.h"

namespace airsim360 {

inline constexpr char kVideoName[] = "video.mp4";  ///< in a dataset

struct VideoResult {
  int64_t pictures = 0;
  double seconds = 0;  ///< shown, the last picture as long as the one before
  std::string encoder;
  double render_ms = 0;  ///< of all pictures; 0 where they were there already
};

/// Renders the shots of a flight in colour as `input.spec` says (size, tier, seed, pano_frame) and writes them as a video, at
/// their times; `input.out` is not used. Errors as of VideoWriter.
VideoResult FilmFlight(const CollectInput& input, Renderer& renderer, const std::filesystem::path& file, const VideoOptions& options);

/// The colour pictures of a dataset as a video, at the times of its frames or, with `frame_rate`, evenly at that many a
/// second. InputError for a folder that is no dataset, has no colour or several pictures a frame.
VideoResult FilmDataset(const std::filesystem::path& folder, const std::filesystem::path& file, VideoOptions options,
                        std::optional<double> frame_rate = {});

}  // namespace airsim360
