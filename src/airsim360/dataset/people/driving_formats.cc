// KITTI, nuScenes and MonoLoco.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "airsim360/base/file.h"
#include "airsim360/base/hash.h"
#include "airsim360/dataset/people/json_lines.h"
#include "airsim360/dataset/people/people_export.h"
#include "airsim360/dataset/people/person_record.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

std::string Text(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }
Vec3d ToVec(const Json& json) { return {json[0], json[1], json[2]}; }
Mat3d ToRotation(const Json& q) { return ToMatrix({q[0], q[1], q[2], q[3]}); }

bool Sits(const Json& person) { return person["locomotion"] == "sit"; }

std::string KittiLine(const Json& person) {
  const double fraction = person["visible_fraction"];
  const Json &box = person["box2d_amodal"], &box3d = person["box3d_cam"], &p = box3d["bottom"], &lwh = box3d["lwh"];
  const int x = box[0], y = box[1], w = box[2], h = box[3];
  char line[320];
  std::snprintf(line, sizeof line, "%s %.2f %d %.4f %d.00 %d.00 %d.00 %d.00 %.4f %.4f %.4f %.4f %.4f %.4f %.4f\n",
                Sits(person) ? "Person_sitting" : "Pedestrian", person["truncation"].get<double>(),
                fraction > 0.8   ? 0
                : fraction > 0.4 ? 1
                                 : 2,
                person["alpha"].get<double>(), x, y, x + w - 1, y + h - 1, lwh[2].get<double>(), lwh[1].get<double>(), lwh[0].get<double>(),
                p[0].get<double>(), p[1].get<double>(), p[2].get<double>(), box3d["rotation_y"].get<double>());
  return line;
}

// 32 hex digits that stand for a thing.
std::string Token(const std::string& of) { return Sha256Hex(AsBytes("airsim360 " + of)).substr(0, 32); }

/// Collects the tables of nuScenes.
class Tables {
 public:
  explicit Tables(const DatasetSpec& spec) : spec_(spec) {
    for (const char* name : {"human.pedestrian.adult", "human.pedestrian.child"})
      Add("category", {{"token", Token(name)}, {"name", name}, {"description", ""}});
    for (const char* name : {"pedestrian.moving", "pedestrian.standing", "pedestrian.sitting_lying_down"})
      Add("attribute", {{"token", Token(name)}, {"name", name}, {"description", ""}});
    const char* levels[] = {"v0-40", "v40-60", "v60-80", "v80-100"};
    for (int i = 0; i < 4; ++i) {
      Add("visibility", {{"token", std::to_string(i + 1)}, {"level", levels[i]}, {"description", ""}});
    }
    Add("sensor", {{"token", Token("sensor")}, {"channel", "CAM_PANORAMA"}, {"modality", "camera"}});
    Add("log", {{"token", Token("log")}, {"logfile", ""}, {"vehicle", "airsim360"}, {"date_captured", ""}, {"location", spec.world}});
    Add("map", {{"token", Token("map")}, {"log_tokens", {Token("log")}}, {"category", "none"}, {"filename", ""}});
  }

  void AddLine(const Json& line) {
    const std::string stem = line["stem"], sample = Token("sample " + stem);
    const int64_t micros = line["t_ns"].get<int64_t>() / 1000;
    Add("sample", {{"token", sample}, {"timestamp", micros}, {"prev", ""}, {"next", ""}, {"scene_token", Token("scene")}});
    const Json& camera = line["camera"];
    Add("ego_pose", {{"token", Token("pose " + stem)},
                     {"timestamp", micros},
                     {"rotation", camera["X_WC"]["q_wxyz"]},
                     {"translation", camera["X_WC"]["p"]}});
    Add("calibrated_sensor", {{"token", Token("calibrated " + stem)},
                              {"sensor_token", Token("sensor")},
                              {"translation", {0, 0, 0}},
                              {"rotation", {1, 0, 0, 0}},
                              {"camera_intrinsic", camera.contains("K") ? camera["K"] : Json::array()}});
    Add("sample_data", {{"token", Token("data " + stem)},
                        {"sample_token", sample},
                        {"ego_pose_token", Token("pose " + stem)},
                        {"calibrated_sensor_token", Token("calibrated " + stem)},
                        {"timestamp", micros},
                        {"fileformat", spec_.rgb_format == RgbFormat::kJpeg ? "jpg" : "png"},
                        {"is_key_frame", true},
                        {"height", spec_.height},
                        {"width", spec_.width},
                        {"filename", "rgb/" + stem + (spec_.rgb_format == RgbFormat::kJpeg ? ".jpg" : ".png")},
                        {"prev", ""},
                        {"next", ""}});
    for (const Json& person : line["persons"]) AddPerson(person, stem, sample);
  }

  std::vector<ExportedFile> Finish() {
    Link("sample");
    Link("sample_data");
    Json& samples = tables_["sample"];
    const bool any = !samples.empty();
    Add("scene", {{"token", Token("scene")},
                  {"log_token", Token("log")},
                  {"nbr_samples", samples.size()},
                  {"first_sample_token", any ? samples.front()["token"] : Json("")},
                  {"last_sample_token", any ? samples.back()["token"] : Json("")},
                  {"name", "scene-0001"},
                  {"description", spec_.world}});
    for (auto& [track, rows] : of_instance_) FinishInstance(track, rows);
    std::vector<ExportedFile> files;
    for (const char* name : {"category", "attribute", "visibility", "instance", "sensor", "calibrated_sensor", "ego_pose", "log", "scene",
                             "sample", "sample_data", "sample_annotation", "map"}) {
      Json& table = tables_[name];
      files.push_back({std::string("nuscenes/v1.0-airsim360/") + name + ".json", Text(table.is_null() ? Json::array() : table)});
    }
    return files;
  }

 private:
  void Add(const std::string& table, Json row) { tables_[table].push_back(std::move(row)); }
  void Link(const std::string& table) {
    Json& rows = tables_[table];
    for (size_t i = 0; i + 1 < rows.size(); ++i) {
      rows[i]["next"] = rows[i + 1]["token"];
      rows[i + 1]["prev"] = rows[i]["token"];
    }
  }
  void AddPerson(const Json& person, const std::string& stem, const std::string& sample) {
    const Json& box = person["box3d_world"];
    const double half = box["yaw"].get<double>() / 2;
    const bool moves = Norm(ToVec(person["velocity_world"])) > 0.2;
    const char* attribute = Sits(person) ? "pedestrian.sitting_lying_down" : moves ? "pedestrian.moving" : "pedestrian.standing";
    const int64_t track = person["track_id"];
    of_instance_[track].push_back(tables_["sample_annotation"].size());
    child_[track] = person["age"].get<double>() < 16;
    Add("sample_annotation", {{"token", Token("annotation " + stem + " " + std::to_string(track))},
                              {"sample_token", sample},
                              {"instance_token", Token("instance " + std::to_string(track))},
                              {"visibility_token", std::to_string(person["visibility_token"].get<int>())},
                              {"attribute_tokens", {Token(attribute)}},
                              {"translation", box["center"]},
                              {"size", {box["lwh"][1], box["lwh"][0], box["lwh"][2]}},
                              {"rotation", {std::cos(half), 0, 0, std::sin(half)}},
                              {"num_lidar_pts", 0},
                              {"num_radar_pts", 0},
                              {"prev", ""},
                              {"next", ""}});
  }
  void FinishInstance(int64_t track, const std::vector<size_t>& rows) {
    Json& annotations = tables_["sample_annotation"];
    for (size_t i = 0; i + 1 < rows.size(); ++i) {
      annotations[rows[i]]["next"] = annotations[rows[i + 1]]["token"];
      annotations[rows[i + 1]]["prev"] = annotations[rows[i]]["token"];
    }
    Add("instance", {{"token", Token("instance " + std::to_string(track))},
                     {"category_token", Token(child_[track] ? "human.pedestrian.child" : "human.pedestrian.adult")},
                     {"nbr_annotations", rows.size()},
                     {"first_annotation_token", annotations[rows.front()]["token"]},
                     {"last_annotation_token", annotations[rows.back()]["token"]}});
  }

  const DatasetSpec& spec_;
  std::map<std::string, Json> tables_;
  std::map<int64_t, std::vector<size_t>> of_instance_;  // rows of sample_annotation
  std::map<int64_t, bool> child_;
};

/// One split of MonoLoco's file.
struct Split {
  Json X = Json::array(), Y = Json::array(), names = Json::array(), kps = Json::array(), K = Json::array(), boxes = Json::array();
  Json ToJson() const {
    return {{"X", X}, {"Y", Y}, {"names", names}, {"kps", kps}, {"K", K}, {"boxes_3d", boxes}, {"clst", Json::object()}};
  }
};

// Input and target of one person seen through their crop.
void AddMonoLoco(const Json& line, const Json& person, Split& split) {
  const Json& crop = person["crop"];
  const double f = crop["f"], c = crop["size"].get<double>() / 2;
  const Mat3d R_KC = ToRotation(crop["q_wxyz_cam"]).transpose();
  const Mat3d R_CW = ToRotation(line["camera"]["X_WC"]["q_wxyz"]).transpose();
  // Keypoints on the plane 10 m ahead.
  constexpr double kPlane = 10;
  Json input = Json::array(), xs = Json::array(), ys = Json::array(), confidence = Json::array();
  for (size_t i = 0; i < 17; ++i) {
    const double x = crop["keypoints"][3 * i], y = crop["keypoints"][3 * i + 1];
    const int v = crop["keypoints"][3 * i + 2];
    input.push_back((x - c) / f * kPlane);
    input.push_back((y - c) / f * kPlane);
    xs.push_back(x), ys.push_back(y), confidence.push_back(v == 2 ? 1.0 : v == 1 ? 0.5 : 0.0);
  }
  const Vec3d p = R_KC * ToVec(person["box3d_cam"]["center"]);
  const double r = Norm(p), heading = person["box3d_world"]["yaw"];
  const Vec3d ahead = R_KC * (R_CW * Vec3d{std::cos(heading), std::sin(heading), 0});
  const double yaw = std::atan2(-ahead.z, ahead.x), a = yaw - std::atan2(p.x, p.z);
  const Json& lwh = person["box3d_cam"]["lwh"];
  const double h = lwh[2], w = lwh[1], l = lwh[0];
  split.X.push_back(std::move(input));
  split.Y.push_back({std::atan2(p.z, p.x), std::acos(p.y / r), p.z, r, (h - 1.72) / 0.1, (w - 0.75) / 0.1, (l - 0.68) / 0.1, std::sin(a),
                     std::cos(a), yaw});
  split.names.push_back(line["stem"].get<std::string>());
  split.kps.push_back({xs, ys, confidence});
  split.K.push_back({{f, 0, c}, {0, f, c}, {0, 0, 1}});
  split.boxes.push_back({p.x, p.y, p.z, w, h, l, yaw});
}

}  // namespace

std::vector<ExportedFile> internal::KittiLabels(const std::string& people_jsonl) {
  std::vector<ExportedFile> files;
  ForEachLine(people_jsonl, [&](const Json& line) {
    std::string text;
    for (const Json& person : line["persons"]) {
      if (!person["box2d_amodal"].is_null()) text += KittiLine(person);
    }
    files.push_back({"kitti/label_2/" + line["stem"].get<std::string>() + ".txt", std::move(text)});
  });
  return files;
}

std::vector<ExportedFile> internal::NuScenesTables(const std::string& people_jsonl, const DatasetSpec& spec) {
  Tables tables(spec);
  ForEachLine(people_jsonl, [&](const Json& line) { tables.AddLine(line); });
  return tables.Finish();
}

ExportedFile internal::MonoLocoJoints(const std::string& people_jsonl) {
  // Every tenth frame is for validation, the one after it for the test.
  Split splits[3];
  ForEachLine(people_jsonl, [&](const Json& line) {
    const int64_t place = line["index"].get<int64_t>() % 10;
    Split& split = splits[place == 8 ? 1 : place == 9 ? 2 : 0];
    for (const Json& person : line["persons"]) {
      if (person["area"] != 0) AddMonoLoco(line, person, split);
    }
  });
  return {"monoloco.json",
          Text({{"train", splits[0].ToJson()}, {"val", splits[1].ToJson()}, {"test", splits[2].ToJson()}, {"version", "airsim360"}})};
}

}  // namespace airsim360
