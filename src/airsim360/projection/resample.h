// Resampling a picture from one camera to another with the same centre.
#pragma once

#include <array>
#include <cstdint>

#include "airsim360/image/image.h"
#include "airsim360/projection/camera.h"

namespace airsim360 {

/// For every pixel of a target camera the pixel position (x, y) in a source camera that sees the same direction;
/// (NaN, NaN) where the source sees nothing.
Image<Vec2d> ResamplingMap(const Camera& target, const Camera& source, const Mat3d& R_source_target = {});

/// Nearest source pixel: for labels, ids and range. Pixels without a source get `fill`.
template <class Pixel>
Image<Pixel> ResampleNearest(const Image<Pixel>& source, const Image<Vec2d>& map, Pixel fill = {});

/// Bilinear, wrapping columns at the seam and crossing the poles when the source is equirectangular.
Image<Rgb32f> ResampleBilinear(const Image<Rgb32f>& source, const Camera& source_camera, const Image<Vec2d>& map);

template <class Pixel>
using CubeFaces = std::array<Image<Pixel>, 6>;  // in the order of kCubeFaceNames, all square and equal

/// Six faces to one equirectangular picture. Nearest for labels and range; filtered (area-weighted bilinear that looks
/// across face borders) for colour.
template <class Pixel>
Image<Pixel> StitchNearest(const CubeFaces<Pixel>& faces, const Equirectangular& target);
Image<Rgb32f> StitchFiltered(const CubeFaces<Rgb32f>& faces, const Equirectangular& target);

/// Depth along each face's own +Z axis to range along the ray, in place of a cube face of the given size.
Image<float> RangeFromFaceDepth(const Image<float>& depth_z);

}  // namespace airsim360
