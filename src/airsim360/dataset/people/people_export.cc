#include "airsim360/dataset/people/people_export.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "airsim360/dataset/people/json_lines.h"
#include "airsim360/people/keypoints/keypoint_orders.h"

namespace airsim360 {
namespace {

using Json = nlohmann::ordered_json;

std::string JsonText(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

// Where the keypoints of other orders are in the lists of people.jsonl.
ExportedFile OrdersFile() {
  Json orders;
  for (const KeypointOrder& order : KeypointOrders()) {
    Json names = Json::array(), indices = Json::array();
    for (size_t i = 0; i < order.sockets.size(); ++i) {
      const int socket = order.sockets[i];
      names.push_back(!order.names.empty() ? std::string(order.names[i]) : socket >= 0 ? std::string(kSocketNames[socket]) : std::string());
      indices.push_back(socket);
    }
    orders[std::string(order.name)] = {{"names", names}, {"index", indices}};
  }
  Json names = Json::array();
  for (const std::string_view name : kSocketNames) names.push_back(std::string(name));
  Json joints = Json::array(), parents = Json::array();
  for (int i = 0; i < kJointCount; ++i) {
    joints.push_back(std::string(JointName(static_cast<Joint>(i))));
    parents.push_back(static_cast<int>(ParentOf(static_cast<Joint>(i))));
  }
  return {"keypoint_orders.json", JsonText({{"keypoints", names}, {"joints", joints}, {"joint_parents", parents}, {"orders", orders}})};
}

// COCO's own skeleton, one-based.
Json CocoSkeleton() {
  return Json::parse(
      "[[16,14],[14,12],[17,15],[15,13],[12,13],[6,12],[7,13],[6,7],[6,8],[7,9],[8,10],[9,11],[2,3],[1,2],[1,3],"
      "[2,4],[3,5],[4,6],[5,7]]");
}

}  // namespace

ExportedFile internal::CocoKeypoints(const std::string& people_jsonl, const DatasetSpec& spec) {
  Json images = Json::array(), annotations = Json::array();
  const std::string extension = spec.rgb_format == RgbFormat::kJpeg ? ".jpg" : ".png";
  ForEachLine(people_jsonl, [&](const Json& line) {
    const auto image_id = static_cast<int64_t>(images.size()) + 1;
    images.push_back({{"id", image_id},
                      {"file_name", line["stem"].get<std::string>() + extension},
                      {"width", line["camera"]["width"]},
                      {"height", line["camera"]["height"]},
                      {"camera", line["camera"]}});
    for (const Json& person : line["persons"]) {
      if (person["area"] == 0) continue;
      Json annotation = {{"id", static_cast<int64_t>(annotations.size()) + 1}, {"image_id", image_id}, {"category_id", 1}};
      for (const char* key : {"area",
                              "iscrowd",
                              "segmentation",
                              "keypoints",
                              "num_keypoints",
                              "track_id",
                              "entity_id",
                              "behaviour",
                              "group_id",
                              "keypoint_state",
                              "keypoint_occluder",
                              "keypoints_world",
                              "keypoints_cam",
                              "keypoints_sph",
                              "box2d_amodal",
                              "box2d_amodal_parts",
                              "visible_fraction",
                              "truncation",
                              "bfov",
                              "rbfov",
                              "box3d_world",
                              "box3d_cam",
                              "alpha",
                              "velocity_world"}) {
        if (person.contains(key)) annotation[key] = person[key];
      }
      // COCO's box is inside the picture: of someone across the seam it spans all columns.
      const Json& box = person["bbox"];
      annotation["bbox"] = person["bbox_wrap"].get<bool>() ? Json{0, box[1], line["camera"]["width"], box[3]} : box;
      annotation["bbox_wrap"] = box;
      annotation["bbox_parts"] = person["bbox_parts"];
      annotations.push_back(std::move(annotation));
    }
  });
  Json names = Json::array();
  for (int i = 0; i < kCocoSocketCount; ++i) names.push_back(std::string(kSocketNames[i]));
  const Json category = {{"id", 1}, {"name", "person"}, {"supercategory", "person"}, {"keypoints", names}, {"skeleton", CocoSkeleton()}};
  return {"person_keypoints.json", JsonText({{"images", images}, {"annotations", annotations}, {"categories", Json::array({category})}})};
}

std::vector<ExportedFile> ExportPeople(const std::string& people_jsonl, const DatasetSpec& spec) {
  std::vector<ExportedFile> files = {OrdersFile()};
  const auto add = [&](std::vector<ExportedFile> more) { std::ranges::move(more, std::back_inserter(files)); };
  for (const std::string& format : spec.people_formats) {
    if (format == "coco_keypoints") add({internal::CocoKeypoints(people_jsonl, spec)});
    if (format == "kitti") add(internal::KittiLabels(people_jsonl));
    if (format == "nuscenes") add(internal::NuScenesOfPeople(people_jsonl, spec));
    if (format == "monoloco") add({internal::MonoLocoJoints(people_jsonl)});
  }
  return files;
}

}  // namespace airsim360
