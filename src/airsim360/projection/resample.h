// Resampling a picture from one camera to another with the same centre, and stitching cube faces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "airsim360/image/image.h"
#include "airsim360/projection/camera.h"

namespace airsim360 {

/// For every pixel of a target camera the pixel position (x, y) in a source camera that sees the same
/// direction; (NaN, NaN) where the target has no ray or the source sees nothing. Cameras must pass
/// CheckCamera (else InputError).
Image<Vec2d> ResamplingMap(const Camera& target, const Camera& source, const Mat3d& R_source_target = {});

/// Nearest source pixel: for labels, ids and range. Pixels without a source get `fill`. A value is taken as
/// it is: after a rotation the range stays right, a normal in C does not.
template <class Pixel>
Image<Pixel> ResampleNearest(const Image<Pixel>& source, const Image<Vec2d>& map, Pixel fill = {}) {
  Image<Pixel> result(map.width(), map.height(), fill);
  for (size_t i = 0; i < map.size(); ++i) {
    const Vec2d at = map.pixels()[i];
    if (std::isnan(at.x)) continue;
    // Positions on the right and lower border belong to the last pixel.
    const int x = std::clamp(static_cast<int>(at.x), 0, source.width() - 1);
    const int y = std::clamp(static_cast<int>(at.y), 0, source.height() - 1);
    result.pixels()[i] = source(x, y);
  }
  return result;
}

/// Bilinear, wrapping columns at the seam and crossing the poles when the source is equirectangular, else
/// held at the border. Pixels without a source are black. InputError unless the picture has the size of its
/// camera.
Image<Rgb32f> ResampleBilinear(const Image<Rgb32f>& source, const Camera& source_camera, const Image<Vec2d>& map);

template <class Pixel>
using CubeFaces = std::array<Image<Pixel>, 6>;  // in the order of kCubeFaceNames, all square and equal

/// InputError naming the face and the sizes unless all faces are square, equal and not empty; else their
/// side. `names` are what the user knows the faces by, such as files.
using FaceSize = std::array<int, 2>;  // width, height
int CheckFaces(const std::array<FaceSize, 6>& sizes, const std::array<std::string, 6>& names);

template <class Pixel>
int CheckFaces(const CubeFaces<Pixel>& faces, const std::array<std::string, 6>& names) {
  std::array<FaceSize, 6> sizes;
  for (size_t f = 0; f < 6; ++f) sizes[f] = {faces[f].width(), faces[f].height()};
  return CheckFaces(sizes, names);
}

/// The same, calling the faces by kCubeFaceNames.
template <class Pixel>
int CheckFaces(const CubeFaces<Pixel>& faces) {
  std::array<std::string, 6> names;
  for (size_t f = 0; f < 6; ++f) names[f] = std::string("cube face ") + kCubeFaceNames[f];
  return CheckFaces(faces, names);
}

/// For every pixel of an equirectangular picture the nearest pixel of six faces of `size` x `size` pixels:
/// (face * size + row) * size + column, faces in the order of kCubeFaceNames.
Image<uint32_t> CubeLookup(int size, const Equirectangular& target);

/// Six faces to one equirectangular picture, nearest pixel: for labels, ids and range.
template <class Pixel>
Image<Pixel> StitchNearest(const CubeFaces<Pixel>& faces, const Equirectangular& target) {
  const uint32_t size = static_cast<uint32_t>(CheckFaces(faces)), face_pixels = size * size;
  const Image<uint32_t> lookup = CubeLookup(static_cast<int>(size), target);
  Image<Pixel> result(target.width, target.height);
  for (size_t i = 0; i < result.size(); ++i) {
    const uint32_t at = lookup.pixels()[i];
    result.pixels()[i] = faces[at / face_pixels].pixels()[at % face_pixels];
  }
  return result;
}

/// Six faces to one equirectangular picture, filtered: the mean over the square of the target pixel of the
/// bilinear interpolation of the faces, which looks across face borders. For colour in linear light, or any
/// numbers.
Image<Rgb32f> StitchFiltered(const CubeFaces<Rgb32f>& faces, const Equirectangular& target);

/// The same for 8-bit sRGB, averaged in linear light, and for 16-bit data, averaged as numbers.
Image<Rgb8> StitchFiltered(const CubeFaces<Rgb8>& faces, const Equirectangular& target);
Image<Rgb16> StitchFiltered(const CubeFaces<Rgb16>& faces, const Equirectangular& target);

/// Six faces of depth along each face's own +Z axis to an equirectangular range: the depth of the nearest
/// face pixel, taken to the target's own ray, so that walls parallel to a face come out exactly. 0 (nothing
/// hit) stays 0.
Image<float> StitchRangeFromDepth(const CubeFaces<float>& depth_z, const Equirectangular& target);

/// Depth along each face's own +Z axis to range along the ray of the same pixel: times sqrt(1 + u^2 + v^2). 0
/// (nothing hit) stays 0. InputError unless the face is square.
Image<float> RangeFromFaceDepth(const Image<float>& depth_z);

}  // namespace airsim360
