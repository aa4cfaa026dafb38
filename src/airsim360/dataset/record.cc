#include "airsim360/dataset/record.h"

#include <nlohmann/json.hpp>

namespace airsim360 {
namespace {

nlohmann::ordered_json Array(Vec3d v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json PoseJson(const RigidTransform& X) {
  const Quaternion q = ToQuaternion(X.R);
  return {{"p", Array(X.p)}, {"q_wxyz", {q.w, q.x, q.y, q.z}}};
}

}  // namespace

std::string FrameJson(const FrameRecord& frame, const DatasetSpec& spec) {
  nlohmann::ordered_json sha256;
  for (const FileRecord& file : frame.files) sha256[file.key] = file.sha256;
  nlohmann::ordered_json json = {{"index", frame.index},
                                 {"stem", Stem(frame.index)},
                                 {"t_ns", frame.t_ns},
                                 {"world", spec.world},
                                 {"X_WC", PoseJson(frame.X_WC)},
                                 {"v_WB", Array(frame.body.v_WB)},
                                 {"w_WB_B", Array(frame.body.w_WB_B)},
                                 {"pano_frame", spec.pano_frame == PanoFrame::kLevel ? "level" : "body"},
                                 {"seed", spec.seed},
                                 {"range_min", frame.range_min},
                                 {"range_median", frame.range_median}};
  if (frame.X_WC_next) json["X_WC_next"] = PoseJson(*frame.X_WC_next);
  json["sha256"] = sha256;
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace airsim360
