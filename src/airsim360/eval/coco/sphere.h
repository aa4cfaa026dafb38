// Objects in panoramas: where they are, other projections of their masks, and predictions of pictures that were moved or turned. Pure
// functions; InputError for pictures that are no panoramas, twice as wide as high.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "airsim360/eval/coco/objects.h"
#include "airsim360/eval/sphere/pixel_view.h"

namespace airsim360 {

/// What an object occupies: [x, y, width, height] in pixels; x + width exceeds the picture's width where it goes round. Of keypoints the box
/// around those with v > 0 (all of them where none has). Not of boxes in space.
std::array<double, 4> PlaceOf(const CocoObject& object, CocoKind kind, const CocoImage& image);

/// Objects as they were before each row of their pictures was moved `columns` to the right, the seam joined.
std::vector<CocoObject> RollBack(std::vector<CocoObject> objects, const CocoTruths& truths, CocoKind kind, int columns);
/// Objects of pictures of a turned camera (TurnedCamera of sphere/panorama_ray.h; radians) as they would have been without the turn. Masks by
/// the nearest pixels; keypoints, and boxes on the sphere, exactly.
std::vector<CocoObject> TurnBack(std::vector<CocoObject> objects, const CocoTruths& truths, CocoKind kind, double yaw, double pitch,
                                 double roll);

/// Masks as the pixels of a view of their picture see them, in one row; areas are counted anew.
std::vector<CocoObject> SeenThrough(std::vector<CocoObject> objects, const CocoTruths& truths,
                                    const std::function<std::shared_ptr<const PixelView>(int width, int height)>& view_of);

}  // namespace airsim360
