// COCO's files of instances, keypoints and results, ready for its evaluation (cocodataset.org/#format-data, #format-results).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "airsim360/eval/coco/objects.h"

namespace airsim360 {

/// InputError naming the file, the field and the value for damage, ids that occur twice, objects of unknown pictures or categories and masks
/// whose size is not that of their picture. `wrap`: of boxes, `bbox_wrap` (on the circle of columns, as our exports have it) is taken for `bbox` where there is one.
CocoTruths ReadCocoTruths(const std::filesystem::path& path, CocoKind kind, bool wrap = false);
CocoTruths ParseCocoTruths(std::string_view text, const std::string& name, CocoKind kind);

/// A list of results, or an object whose `annotations` is one. Areas follow pycocotools: of the box where the first result has one, even if
/// masks are compared. InputError as above; unknown pictures are named with the number of them.
std::vector<CocoObject> ReadCocoResults(const std::filesystem::path& path, CocoKind kind, CocoTruths& truths, bool wrap = false);
std::vector<CocoObject> ParseCocoResults(std::string_view text, const std::string& name, CocoKind kind, CocoTruths& truths);

}  // namespace airsim360
