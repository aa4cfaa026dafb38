// KITTI, nuScenes and MonoLoco.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "airsim360/dataset/people/json_lines.h"
#include "airsim360/dataset/people/nuscenes_tables.h"
#include "airsim360/dataset/people/people_export.h"
#include "airsim360/dataset/people/person_record.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

std::string Text(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }
Vec3d ToVec(const Json& json) { return {json[0], json[1], json[2]}; }
Mat3d ToRotation(const Json& q) { return ToMatrix({q[0], q[1], q[2], q[3]}); }

bool Sits(const Json& person) { return person["locomotion"] == "sit"; }

std::string LineOf(const Json& person) {
  const double fraction = person["visible_fraction"];
  const Json &box = person["box2d_amodal"], &box3d = person["box3d_cam"], &p = box3d["bottom"], &lwh = box3d["lwh"];
  const int x = box[0], y = box[1], w = box[2], h = box[3];
  // KITTI's alpha is seen from its location, the bottom's middle; that of people.jsonl from the middle of the box. They
  // differ where the camera is tilted.
  const double rotation_y = box3d["rotation_y"];
  const double alpha = std::remainder(rotation_y - std::atan2(p[0].get<double>(), p[2].get<double>()), 2 * std::numbers::pi);
  char line[320];
  std::snprintf(line, sizeof line, "%s %.2f %d %.4f %d.00 %d.00 %d.00 %d.00 %.4f %.4f %.4f %.4f %.4f %.4f %.4f\n",
                Sits(person) ? "Person_sitting" : "Pedestrian", person["truncation"].get<double>(),
                fraction > 0.8   ? 0
                : fraction > 0.4 ? 1
                                 : 2,
                alpha, x, y, x + w - 1, y + h - 1, lwh[2].get<double>(), lwh[1].get<double>(), lwh[0].get<double>(), p[0].get<double>(),
                p[1].get<double>(), p[2].get<double>(), rotation_y);
  return line;
}

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

std::string internal::KittiLine(const Json& person) { return person["box2d_amodal"].is_null() ? std::string() : LineOf(person); }

std::vector<ExportedFile> internal::KittiLabels(const std::string& people_jsonl) {
  std::vector<ExportedFile> files;
  ForEachLine(people_jsonl, [&](const Json& line) {
    std::string text;
    for (const Json& person : line["persons"]) text += KittiLine(person);
    files.push_back({"kitti/label_2/" + line["stem"].get<std::string>() + ".txt", std::move(text)});
  });
  return files;
}

internal::NuScenesBox internal::NuScenesBoxOf(const Json& person) {
  const Json& box = person["box3d_world"];
  const double half = box["yaw"].get<double>() / 2;
  const bool moves = Norm(ToVec(person["velocity_world"])) > 0.2;
  return {.kind = "",
          .track = person["track_id"],
          .category = person["age"].get<double>() < 16 ? "human.pedestrian.child" : "human.pedestrian.adult",
          .attribute = Sits(person) ? "pedestrian.sitting_lying_down"
                       : moves      ? "pedestrian.moving"
                                    : "pedestrian.standing",
          .visibility = std::to_string(person["visibility_token"].get<int>()),
          .translation = box["center"],
          .size = {box["lwh"][1], box["lwh"][0], box["lwh"][2]},
          .rotation = {std::cos(half), 0, 0, std::sin(half)}};
}

std::vector<ExportedFile> internal::NuScenesOfPeople(const std::string& people_jsonl, const DatasetSpec& spec) {
  NuScenesTables tables(spec, PedestrianCategories(), PedestrianAttributes());
  ForEachLine(people_jsonl, [&](const Json& line) {
    const std::string stem = line["stem"];
    tables.AddFrame(stem, line["t_ns"], line["camera"], "rgb/" + stem + (spec.rgb_format == RgbFormat::kJpeg ? ".jpg" : ".png"));
    for (const Json& person : line["persons"]) tables.AddBox(NuScenesBoxOf(person));
  });
  return tables.Finish("nuscenes/v1.0-airsim360");
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
