// Errors of room layouts told by their corners in a panorama. Pure functions.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "airsim360/math/vector.h"

namespace airsim360 {

/// A room: pairs of a ceiling and a floor corner in pixels (the centre of the first pixel is (0, 0)), around the room.
struct RoomLayout {
  std::vector<Vec2d> ceiling, floor;
};

struct LayoutErrors {
  double iou2d = 0;         ///< of the floor plans
  double iou3d = 0;         ///< of the plans raised to the rooms' mean heights
  double corner_error = 0;  ///< mean distance of corners, in per cent of the picture's diagonal; NaN for different numbers
  double pixel_error = 0;   ///< per cent of pixels whose surface (ceiling, wall, floor) differs
  double rmse = 0;          ///< of the range of the empty rooms, metres for a camera 1.6 m above the floor
  double delta1 = 0;        ///< share of pixels with ranges within a factor of 1.25
};
inline constexpr std::array<std::string_view, 6> kLayoutFigures = {"iou2d", "iou3d", "corner_error_percent", "pixel_error_percent",
                                                                   "rmse",  "d1"};
std::array<double, kLayoutFigures.size()> Figures(const LayoutErrors& errors);

/// As HorizonNet's evaluation (Sun et al., CVPR 2019) has them, but boundaries are exact where that code joins rounded columns. InputError for fewer than three
/// pairs, corners on the wrong side of the horizon or more than half a width beside the picture, pairs whose columns differ by more than a pixel, a camera outside
/// the room, or a truth whose walls cross each other.
LayoutErrors MeasureLayout(const RoomLayout& prediction, const RoomLayout& truth, int width, int height);

/// The corner error where the prediction may begin at any corner and columns go round; NaN for different numbers.
double CornerErrorFromAnyStart(const RoomLayout& prediction, const RoomLayout& truth, int width, int height);

/// Whether walls that are no neighbours cross, seen from above.
bool WallsCross(const RoomLayout& room, int width, int height);

}  // namespace airsim360
