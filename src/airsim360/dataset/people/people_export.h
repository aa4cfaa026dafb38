// people.jsonl in the formats of other tools. Pure functions of its text.
#pragma once

#include <string>
#include <vector>

#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

struct ExportedFile {
  std::string path;  ///< relative to the dataset
  std::string text;
};

/// What tells that a format has been written: a file or folder.
struct PeopleFormatPath {
  const char* format;
  const char* path;
  const char* holds;  ///< in words
};
inline constexpr PeopleFormatPath kPeopleFormatPaths[] = {
    {"coco_keypoints", "person_keypoints.json", "COCO keypoints"},
    {"kitti", "kitti/label_2", "KITTI labels of every picture"},
    {"nuscenes", "nuscenes/v1.0-airsim360/sample.json", "nuScenes' thirteen tables, in this folder"},
    {"monoloco", "monoloco.json", "MonoLoco's joints with their targets"}};

/// keypoint_orders.json (always), then what spec.people_formats asks for. docs/guide/people_labels.md says how
/// panoramas fit into formats made for pinhole cameras.
std::vector<ExportedFile> ExportPeople(const std::string& people_jsonl, const DatasetSpec& spec);

namespace internal {
/// person_keypoints.json: COCO keypoints with our extensions.
ExportedFile CocoKeypoints(const std::string& people_jsonl, const DatasetSpec& spec);
/// kitti/label_2/STEM.txt of every picture.
std::vector<ExportedFile> KittiLabels(const std::string& people_jsonl);
/// nuscenes/v1.0-airsim360/*.json: the thirteen tables.
std::vector<ExportedFile> NuScenesOfPeople(const std::string& people_jsonl, const DatasetSpec& spec);
/// monoloco.json: joints of the crops with their targets, split by frame 8 : 1 : 1.
ExportedFile MonoLocoJoints(const std::string& people_jsonl);
}  // namespace internal

}  // namespace airsim360
