// Writes LeRobot v2.1 (huggingface/lerobot): states and actions in Parquet, panoramas as videos, episode by episode.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "airsim360/dataset/export/parquet_file.h"
#include "airsim360/image/image.h"
#include "airsim360/video/video_writer.h"

namespace airsim360::internal {

struct LeRobotShape {
  double rate = 10;  ///< frames a second
  int width = 0, height = 0;
  bool spherical = true;
  std::vector<std::string> state_names = {}, action_names = {};
};

/// Calls: Begin, then AddPicture and AddRow of every frame in any order, then End or Drop; at last Finish.
class LeRobotWriter {
 public:
  /// Below `prefix` of the folder: "" or "lerobot/".
  LeRobotWriter(ExportFolder& folder, std::string prefix, LeRobotShape shape);
  ~LeRobotWriter();

  void Begin(const std::string& task);
  void AddPicture(const Image<Rgb8>& picture, int64_t t_ns);
  void AddRow(const std::vector<float>& state, const std::vector<float>& action);
  void End();
  /// As if the episode had never begun.
  void Drop();
  void Finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace airsim360::internal
