// What a dataset keeps of one person in one picture: an entry of people.jsonl.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "airsim360/dataset/record/record.h"
#include "airsim360/image/image.h"
#include "airsim360/sim/people/labels.h"

namespace airsim360 {

/// The labels of one picture with what they were made of.
struct LabelledPicture {
  const SimPeople& people;
  const Camera& camera;
  const Image<EntityId>& entity;
  std::span<const Segment> segments;  ///< of the picture, by entity id
};

/// Rows of the persons of a picture, by entity id. Deterministic text: lengths to 0.01 mm, pixels to 1e-3,
/// angles to 1e-6 rad. docs/reference/people_format.md names every field.
std::vector<PersonRow> PersonRows(const LabelledPicture& picture, std::span<const PersonLabel> labels);

/// One line of people.jsonl: frame, camera and all persons of a picture.
std::string PeopleLine(const std::string& frame_line, const DatasetSpec& spec, const View& view, std::span<const std::string> persons);

/// COCO's compressed run lengths of an entity's pixels, column by column: five bits a letter from '0' on,
/// differences to the run before the last. `box` as Segment::box_wrap.
std::string CocoRle(const Image<EntityId>& entity, EntityId id, const PixelBox& box);

/// A pinhole picture of a person: looks at the middle of the field of view, 1.25 times as wide.
struct PersonCrop {
  Pinhole camera;
  Mat3d R_CK;  ///< from the crop's frame K (right, down, forward) to C
};
inline constexpr int kCropSize = 256;
PersonCrop CropOf(const PersonLabel& label);
/// The crop out of a picture, bilinear in linear light with 4 samples a pixel.
Image<Rgb8> RenderCrop(const Image<Rgb8>& rgb, const Camera& camera, const PersonCrop& crop);
/// A copy of the picture with boxes, bones, COCO keypoints (green visible, yellow behind oneself, orange behind
/// a person, red behind the scene) and behaviours of everyone who is seen.
Image<Rgb8> DrawPeople(const Image<Rgb8>& rgb, const Camera& camera, std::span<const PersonLabel> labels);
/// "crops/000012_p003_+x.png" without the extension.
std::string CropStem(int64_t frame, const std::string& view, PersonIndex person);

}  // namespace airsim360
