#include "airsim360/dataset/record.h"

#include <nlohmann/json.hpp>

namespace airsim360 {
namespace {

nlohmann::ordered_json Array(Vec3d v) { return {v.x, v.y, v.z}; }

}  // namespace

std::string FrameJson(const FrameRecord& frame, const DatasetSpec& spec) {
  const Quaternion q = ToQuaternion(frame.X_WC.R);
  nlohmann::ordered_json sha256;
  for (const FileRecord& file : frame.files) sha256[file.key] = file.sha256;
  const nlohmann::ordered_json json = {
      {"index", frame.index},
      {"stem", Stem(frame.index)},
      {"t_ns", frame.t_ns},
      {"world", spec.world},
      {"X_WC", {{"p", Array(frame.X_WC.p)}, {"q_wxyz", {q.w, q.x, q.y, q.z}}}},
      {"v_WB", Array(frame.body.v_WB)},
      {"w_WB_B", Array(frame.body.w_WB_B)},
      {"pano_frame", spec.pano_frame == PanoFrame::kLevel ? "level" : "body"},
      {"seed", spec.seed},
      {"range_min", frame.range_min},
      {"range_median", frame.range_median},
      {"sha256", sha256}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace airsim360
