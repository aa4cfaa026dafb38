// simGetDetections: the objects in a picture that a filter names, with their boxes.
#pragma once

#include "airsim360/rpc/images/image_service.h"

namespace airsim360 {

/// Objects seen in the labels of a view whose names match and whose centres are near enough.
std::vector<airsim::DetectionInfo> DetectionsIn(const ImageService::View& view, const Snapshot& now, const ObjectIndex& objects,
                                                const DetectionFilter& filter);

}  // namespace airsim360
