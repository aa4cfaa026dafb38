#include "airsim360/dataset/record/record.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "airsim360/dataset/record/intrinsics.h"
#include "airsim360/projection/camera_model_names.h"

namespace airsim360 {
namespace {

nlohmann::ordered_json Array(Vec3d v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json PoseJson(const RigidTransform& X) {
  const Quaternion q = ToQuaternion(X.R);
  return {{"p", Array(X.p)}, {"q_wxyz", {q.w, q.x, q.y, q.z}}};
}

// What the camera chose for a picture.
nlohmann::ordered_json LookJson(const PhotoFigures& photo) {
  return {{"exposure_ev", photo.exposure_ev},
          {"white_cd_m2", photo.white_cd_m2},
          {"gain", photo.gain},
          {"white_balance", {photo.red, photo.green, photo.blue}},
          {"contrast", photo.contrast},
          {"sun_seen", photo.sun_seen}};
}

// Radiance of the world times `factor` is what became colours. It is one scale for all frames, whatever their sky.
nlohmann::ordered_json DevelopedJson(double exposure) { return {{"factor", exposure}, {"stops", std::log2(exposure)}}; }

// Pose, next pose and intrinsics of one camera of a rig.
nlohmann::ordered_json CameraJson(const ViewRecord& record, const View& view) {
  nlohmann::ordered_json json = {{"X_WC", PoseJson(record.X_WC)}};
  if (record.X_WC_next) json["X_WC_next"] = PoseJson(*record.X_WC_next);
  if (const auto K = IntrinsicsJson(view.camera); !K.is_null()) json["K"] = K;
  if (record.exposure) json["developed"] = DevelopedJson(*record.exposure);
  if (record.photo) json["look"] = LookJson(*record.photo);
  return json;
}

}  // namespace

nlohmann::ordered_json IntrinsicsJson(const Camera& camera) {
  const auto json = [](const char* model, const auto& c, const std::vector<double>& distortion) {
    return nlohmann::ordered_json{{"model", model}, {"width", c.width}, {"height", c.height}, {"fx", c.fx},
                                  {"fy", c.fy},     {"cx", c.cx},       {"cy", c.cy},         {"distortion", distortion}};
  };
  if (const auto* pinhole = std::get_if<Pinhole>(&camera)) return json("PINHOLE", *pinhole, {});
  if (const auto* fisheye = std::get_if<Fisheye>(&camera)) return json("OPENCV_FISHEYE", *fisheye, {fisheye->k.begin(), fisheye->k.end()});
  if (const auto* lens = std::get_if<CalibratedLens>(&camera)) {
    const CameraModel model = *ModelOf(camera);
    nlohmann::ordered_json K = json(model.name.c_str(), *lens, {model.parameters.begin() + 4, model.parameters.end()});
    K["max_theta"] = lens->max_theta;
    return K;
  }
  return nullptr;
}

bool HasOwnExposure(const PictureSettings& picture) { return picture.auto_exposure && picture.look != Look::kPhoto; }

Camera CameraOfIntrinsics(const nlohmann::ordered_json& K, double max_theta) {
  std::vector<double> parameters = {K.at("fx"), K.at("fy"), K.at("cx"), K.at("cy")};
  for (const auto& value : K.at("distortion")) parameters.push_back(value);
  const std::string model = K.at("model");
  if (model == "PINHOLE" && !K.contains("max_theta")) return MakeCamera(model, K.at("width"), K.at("height"), parameters);
  return RestoreCamera(model, K.at("width"), K.at("height"), parameters, K.value("max_theta", max_theta));
}

bool IsColmapModel(const Camera& camera) {
  const std::optional<CameraModel> model = ModelOf(camera);
  return model && model->colmap;
}

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
                                 {"pano_frame", kPanoFrameNames[static_cast<int>(spec.pano_frame)]},
                                 {"seed", spec.seed},
                                 {"range_min", frame.range_min},
                                 {"range_median", frame.range_median}};
  if (!spec.row.empty()) {
    json["row"] = spec.row;
    json["environment"] = spec.environment;
    if (spec.tier != Tier::kLabels && !HasOwnExposure(spec)) json["exposure"] = spec.exposure_ev;
  }
  if (!frame.views.empty() && frame.views[0].X_WC_next) json["X_WC_next"] = PoseJson(*frame.views[0].X_WC_next);
  const std::vector<View> views = Views(spec);
  if (spec.cameras.empty()) {
    if (!frame.views.empty() && frame.views[0].exposure) json["developed"] = DevelopedJson(*frame.views[0].exposure);
    if (!frame.views.empty() && frame.views[0].photo) json["look"] = LookJson(*frame.views[0].photo);
    if (const auto K = IntrinsicsJson(views[0].camera); !K.is_null()) json["K"] = K;
  } else {
    json["X_WB"] = PoseJson(frame.body.X_WB);
    for (size_t v = 0; v < frame.views.size(); ++v) {
      if (!json["cameras"].contains(views[v].name)) json["cameras"][views[v].name] = CameraJson(frame.views[v], views[v]);
    }
  }
  json["sha256"] = sha256;
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace airsim360
