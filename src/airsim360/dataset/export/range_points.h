// Points of the world taken from the range of panoramas: what COLMAP and nerfstudio begin from.
#pragma once

#include <vector>

#include "airsim360/dataset/export/export_job.h"

namespace airsim360::internal {

struct RangePoint {
  Vec3d p_W;
  Rgb8 color;
  Vec2d pixel;  ///< centre of the pixel of the picture it was taken from
};

/// At most `count` points of one picture, spread evenly over the solid angle of the sphere (or the picture's pixels where it
/// is no panorama) by a low-discrepancy sequence whose beginning depends on the frame. Pixels of the sky give none.
std::vector<RangePoint> PointsOf(const ExportJob& job, const NativeFrame& frame, const View& view, int64_t count);

/// options.points shared among all pictures.
int64_t PointsAPicture(const ExportJob& job);

}  // namespace airsim360::internal
