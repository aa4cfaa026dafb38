// Pictures, their cells of light and the way between them.
#pragma once

#include <optional>
#include <vector>

#include "airsim360/image/image.h"
#include "airsim360/render/look/develop_kernels.h"
#include "airsim360/render/look/photo.h"
#include "airsim360/render/look/scatter.h"

namespace airsim360::internal {

/// A picture as the passes see it. A panorama is worked on in the canonical columns of render/frame/camera_rays.h, which
/// stand still in W while the camera turns: column c is image column (c - shift) mod width.
struct PhotoGeometry {
  int width, height;
  bool sphere;
  int shift;           ///< 0 unless a panorama
  double column, row;  ///< radians of a pixel: at the equator, or in the middle of the picture
  int cells_across, cells_down;

  explicit PhotoGeometry(const PhotoRequest& request);
  int ImageColumn(int canonical) const { return canonical < shift ? canonical - shift + width : canonical - shift; }
  LightCells Cells() const;
};

/// Row of a picture or of cells counted beyond the poles, where it comes back half a turn on, or held at a border.
struct PhotoRow {
  int y;
  bool turned;  ///< by half of the width
};
PhotoRow FindPhotoRow(bool sphere, int y, int height);

/// Means of the light over cells, at most `most` of each pixel and channel.
LightCells Reduce(const PhotoGeometry& geometry, const Image<Rgb32f>& light, float most);

/// A row of `cells` times `share` at the columns of the picture, linearly interpolated. `scratch`: a row of cells, padded.
void SpreadCells(const PhotoGeometry& geometry, const LightCells& cells, float share, int y, float* scratch, ColorRow out);

/// Canonical position of the sun's centre, pixels; nullopt where the picture does not show it.
std::optional<Vec2d> FindSun(const PhotoGeometry& geometry, const PhotoRequest& request);

/// Limits the light of the pixels about the sun's disc to `most`.
void ClipSunDisc(const PhotoGeometry& geometry, const PhotoRequest& request, Vec2d sun, float most, Image<Rgb32f>& light);

/// Adds light of irradiance `sun` from that position to cells.
void AddSun(const PhotoGeometry& geometry, Vec2d at, const Rgb32f& sun, LightCells& cells);

}  // namespace airsim360::internal
