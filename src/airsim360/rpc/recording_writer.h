// Writes what AirSim's recording writes: airsim_rec.txt and images/ in a folder of its own.
#pragma once

#include <filesystem>

#include "airsim360/rpc/image_service.h"

namespace airsim360 {

class RecordingWriter {
 public:
  /// Becomes the sink of the session's recorder. `images` must outlive the session.
  RecordingWriter(Session& session, ImageService& images);

 private:
  void Write(ImageService& images, const SnapshotPointer& snapshot);
  void Open();
  std::string WriteImage(const airsim::ImageResponse& image, const std::string& vehicle);

  RecordingSettings settings_;
  std::filesystem::path folder_;  // empty until the first record
  bool failed_ = false;
};

}  // namespace airsim360
