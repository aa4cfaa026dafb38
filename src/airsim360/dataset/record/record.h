// What the index knows of a frame, and its line in frames.jsonl.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "airsim360/dataset/record/segments.h"
#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

/// One file of a frame.
struct FileRecord {
  std::string key;   ///< in frames.jsonl's "sha256": the product, with the view's suffix
  std::string path;  ///< relative to the dataset, '/' separated
  int64_t bytes = 0;
  std::string sha256;
};

/// A person in one picture.
struct PersonRow {
  EntityId entity = kNoEntity;
  int64_t track = 0;
  std::string behaviour;
  double range = 0;    ///< metres to the middle of the body
  int64_t pixels = 0;  ///< that show the person
  double visible_fraction = 0;
  std::string json;  ///< entry of people.jsonl
};

struct ViewRecord {
  std::string suffix;
  RigidTransform X_WC;
  std::optional<RigidTransform> X_WC_next = {};  ///< where the flow leads to, if the dataset has flow
  std::vector<Segment> segments = {};
  std::vector<PersonRow> persons = {};     ///< by entity id
  std::optional<PhotoFigures> photo = {};  ///< of look photo
  std::optional<double> exposure = {};     ///< of the colour picture: radiance times this is what the tone curve was given
};

/// A finished frame.
struct FrameRecord {
  int64_t index = 0;
  int64_t t_ns = 0;
  RigidTransform X_WC;  ///< of the first view
  Kinematics body;
  double range_min = 0;     ///< metres, over the pixels that hit something; 0 if none did
  double range_median = 0;  ///< lower median
  std::vector<FileRecord> files;
  std::vector<ViewRecord> views;  ///< as Views(spec)
};

/// Whether every picture finds its exposure by itself: `auto`, unless it is a photo, whose stops come on top of its metering.
bool HasOwnExposure(const PictureSettings& picture);

/// One line of frames.jsonl, without the line feed.
std::string FrameJson(const FrameRecord& frame, const DatasetSpec& spec);

}  // namespace airsim360
