// The entities seen in one picture, with their areas and boxes: COCO panoptic's segments.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "airsim360/image/image.h"
#include "airsim360/scene/scene.h"
#include "airsim360/sensors/solid_angles.h"

namespace airsim360 {

/// COCO box: left column, top row, width, height in pixels.
struct PixelBox {
  int x = 0, y = 0, w = 0, h = 0;
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// One entity in one picture.
struct Segment {
  EntityId entity = kNoEntity;
  CategoryId category = kVoid;
  int64_t area = 0;        ///< pixels
  PixelBox box;            ///< tight, inside the picture
  PixelBox box_wrap;       ///< tight on the circle of columns: 0 <= x < W, x + w may exceed W; same rows as `box`
  double solid_angle = 0;  ///< steradians
};

/// The shortest run of columns, on a circle of `width`, that holds all columns set in `bits` (64 per word,
/// column c is bit c % 64 of word c / 64; at least one is set): (first column, length). The leftmost of
/// equally short ones.
std::pair<int, int> ShortestColumnRun(const uint64_t* bits, int width);

/// What the columns and pixels of a picture may be.
struct PictureKind {
  bool wraps = false;        ///< the columns close to a circle (equirectangular)
  bool allows_void = false;  ///< some pixels have no ray and so no entity (outside a fisheye's circle)
};

/// All segments of a picture, by entity id; their areas sum to its pixels, but for void ones. The category is
/// the entity's own; RuntimeError if a pixel has no entity or a semantic id that is not its entity's.
std::vector<Segment> FindSegments(const Image<EntityId>& entity, const Image<CategoryId>& semantic, const Scene& scene,
                                  const PixelSolidAngles& solid_angles, PictureKind kind);

}  // namespace airsim360
