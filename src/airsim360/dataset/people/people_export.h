// people.jsonl in the formats of other tools. Pure functions of its text.
#pragma once

#include <string>
#include <vector>

#include "airsim360/dataset/spec.h"

namespace airsim360 {

struct ExportedFile {
  std::string path;  ///< relative to the dataset
  std::string text;
};

/// keypoint_orders.json (always), then what spec.people_formats asks for. docs/people_labels.md says how
/// panoramas fit into formats made for pinhole cameras.
std::vector<ExportedFile> ExportPeople(const std::string& people_jsonl, const DatasetSpec& spec);

namespace internal {
/// person_keypoints.json: COCO keypoints with our extensions.
ExportedFile CocoKeypoints(const std::string& people_jsonl, const DatasetSpec& spec);
/// kitti/label_2/STEM.txt of every picture.
std::vector<ExportedFile> KittiLabels(const std::string& people_jsonl);
/// nuscenes/v1.0-airsim360/*.json: the thirteen tables.
std::vector<ExportedFile> NuScenesTables(const std::string& people_jsonl, const DatasetSpec& spec);
/// monoloco.json: joints of the crops with their targets, split by frame 8 : 1 : 1.
ExportedFile MonoLocoJoints(const std::string& people_jsonl);
}  // namespace internal

}  // namespace airsim360
