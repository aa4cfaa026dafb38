// The sphere's protocols of `eval entity`, `keypoints` and `boxes`: objects by where they are, and back from pictures that were moved.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "airsim360/app/eval/eval_views.h"
#include "airsim360/eval/coco/objects.h"

namespace airsim360 {

/// What cannot go round, or has no columns, is neither moved nor turned: InputError naming the flag.
void CheckSphere(const ViewOptions& view, CocoKind kind, bool wrap);

/// `seam`: AP of objects whose nearest column is within `--seam` columns of the seam, and of the others; `latitude_bands`: AP by the latitude
/// of the middle of what objects occupy. InputError for pictures that are not twice as wide as high.
void AppendPlaces(nlohmann::ordered_json& json, const ViewOptions& view, const CocoTruths& truths, const std::vector<CocoObject>& results,
                  const CocoRun& run);

/// Objects of pictures that were rolled or turned, where they are in the truths' pictures.
std::vector<CocoObject> MovedBack(std::vector<CocoObject> objects, const CocoTruths& truths, CocoKind kind, const Rolled& rolled);

}  // namespace airsim360
