#include "airsim360/dataset/pose_export.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "airsim360/base/text.h"
#include "airsim360/dataset/people/json_lines.h"
#include "airsim360/dataset/record/intrinsics.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

// Of -0 as of 0.
std::string Number(double value) { return ShortestText(value + 0.0); }

// A view with intrinsics; `id` is COLMAP's, from 1.
struct ExportedView {
  View view;
  Json K;
  size_t id;
  // nerfstudio's camera_model, or nothing.
  bool opencv() const { return K["model"] == "PINHOLE" || K["model"] == "OPENCV"; }
  bool fisheye() const { return K["model"] == "OPENCV_FISHEYE"; }
};

std::vector<ExportedView> ExportedViews(const DatasetSpec& spec) {
  std::vector<ExportedView> views;
  if (spec.tier == Tier::kLabels) return views;
  for (const View& view : Views(spec)) {
    const Json K = IntrinsicsJson(view.camera);
    if (!K.is_null() && IsColmapModel(view.camera)) views.push_back({view, K, views.size() + 1});
  }
  return views;
}

RigidTransform PoseOf(const Json& frame, const DatasetSpec& spec, const View& view) {
  const Json& X = spec.cameras.empty() ? frame["X_WC"] : frame["cameras"][view.name]["X_WC"];
  const Json &p = X["p"], &q = X["q_wxyz"];
  return {ToMatrix({q[0], q[1], q[2], q[3]}), {p[0], p[1], p[2]}};
}

std::string PictureName(const Json& frame, const DatasetSpec& spec, const View& view) {
  return frame["stem"].get<std::string>() + view.suffix + (spec.rgb_format == RgbFormat::kJpeg ? ".jpg" : ".png");
}

std::string ColmapCameras(const std::vector<ExportedView>& views) {
  std::string text = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
  for (const auto& [view, K, id] : views) {
    text += std::to_string(id) + " " + K["model"].get<std::string>() + " " + K["width"].dump() + " " + K["height"].dump();
    for (const char* key : {"fx", "fy", "cx", "cy"}) text += " " + Number(K[key]);
    for (const Json& k : K["distortion"]) text += " " + Number(k);
    text += "\n";
  }
  return text;
}

// One picture: its line, and an empty one for the points seen.
std::string ColmapImage(size_t image, size_t camera, const RigidTransform& X_WC, const std::string& name) {
  const RigidTransform X_CW = X_WC.inverse();
  const Quaternion q = ToQuaternion(X_CW.R);
  std::string line = std::to_string(image);
  for (const double value : {q.w, q.x, q.y, q.z, X_CW.p.x, X_CW.p.y, X_CW.p.z}) line += " " + Number(value);
  return line + " " + std::to_string(camera) + " " + name + "\n\n";
}

// nerfstudio: camera to world, the camera's axes being right, up, backward.
Json OpenGlMatrix(const RigidTransform& X_WC) {
  const Vec3d columns[] = {X_WC.R.column(0), -X_WC.R.column(1), -X_WC.R.column(2), X_WC.p};
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({columns[0][i], columns[1][i], columns[2][i], columns[3][i]});
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

Json NerfstudioFrame(const ExportedView& view, const RigidTransform& X_WC, const std::string& name) {
  const Json& K = view.K;
  Json json = {{"file_path", "rgb/" + name},
               {"fl_x", K["fx"]},
               {"fl_y", K["fy"]},
               {"cx", K["cx"]},
               {"cy", K["cy"]},
               {"w", K["width"]},
               {"h", K["height"]}};
  const bool fisheye = view.fisheye();
  const char* const names[] = {"k1", "k2", fisheye ? "k3" : "p1", fisheye ? "k4" : "p2"};
  for (size_t i = 0; i < K["distortion"].size(); ++i) json[names[i]] = K["distortion"][i];
  json["transform_matrix"] = OpenGlMatrix(X_WC);
  return json;
}

std::string Transforms(bool fisheye, const Json& frames) {
  const Json json = {{"camera_model", fisheye ? "OPENCV_FISHEYE" : "OPENCV"}, {"frames", frames}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Names of the files of nerfstudio: of pinholes and of fisheyes.
struct TransformsNames {
  std::string pinhole, fisheye;
};
TransformsNames NamesOf(const std::vector<ExportedView>& views) {
  TransformsNames names;
  if (std::ranges::any_of(views, &ExportedView::opencv)) names.pinhole = "transforms.json";
  if (std::ranges::any_of(views, &ExportedView::fisheye))
    names.fisheye = names.pinhole.empty() ? "transforms.json" : "transforms_fisheye.json";
  return names;
}

}  // namespace

std::vector<std::string> PoseFileNames(const DatasetSpec& spec) {
  const std::vector<ExportedView> views = ExportedViews(spec);
  if (views.empty()) return {};
  std::vector<std::string> names = {"cameras.txt", "images.txt", "points3D.txt"};
  for (const auto& [pinhole, fisheye] = NamesOf(views); const std::string& name : {pinhole, fisheye}) {
    if (!name.empty()) names.push_back(name);
  }
  return names;
}

std::vector<ExportedFile> ExportPoses(const std::string& frames_jsonl, const DatasetSpec& spec) {
  const std::vector<ExportedView> views = ExportedViews(spec);
  if (views.empty()) return {};
  std::string images = "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[] as (X, Y, POINT3D_ID)\n";
  Json pinholes = Json::array(), fisheyes = Json::array();
  ForEachLine(frames_jsonl, [&](const Json& frame) {
    for (const ExportedView& view : views) {
      const RigidTransform X_WC = PoseOf(frame, spec, view.view);
      const std::string name = PictureName(frame, spec, view.view);
      const size_t image = frame["index"].get<size_t>() * views.size() + view.id;
      images += ColmapImage(image, view.id, X_WC, name);
      if (view.opencv() || view.fisheye()) (view.fisheye() ? fisheyes : pinholes).push_back(NerfstudioFrame(view, X_WC, name));
    }
  });
  std::vector<ExportedFile> files = {{"cameras.txt", ColmapCameras(views)},
                                     {"images.txt", images},
                                     {"points3D.txt", "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n"}};
  const TransformsNames names = NamesOf(views);
  if (!names.pinhole.empty()) files.push_back({names.pinhole, Transforms(false, pinholes)});
  if (!names.fisheye.empty()) files.push_back({names.fisheye, Transforms(true, fisheyes)});
  return files;
}

}  // namespace airsim360
