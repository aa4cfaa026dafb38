// Memory of the denoiser's planes, and the way of images into and out of them.
#pragma once

#include <vector>

#include "airsim360/base/table_vector.h"
#include "airsim360/render/filter/denoiser.h"
#include "airsim360/render/filter/filter_planes.h"
#include "airsim360/render/frame/camera_rays.h"

namespace airsim360::internal {

class FilterBuffers {
 public:
  /// Sizes the planes for a camera and fills them from guides and signal.
  void Load(const FilterGuides& guides, const LightSignal& signal, int max_step);
  /// Writes light of set `set` where a surface is; pixels that still have none take the mean of the nearest
  /// that have, of the same entity first.
  void Store(int set, Image<Rgb32f>& light) const;
  /// Repeats the first columns of a row behind its last in the planes that passes write.
  void RepeatLight(int y, int set);
  void RepeatSamples(int y);
  void RepeatStatistics(int y);

  const FilterPlanes& planes() const { return planes_; }
  const CameraRays& rays() const { return rays_; }
  /// Columns from a row's pixels to their neighbours `step` rows away.
  int StepX(int y, int step) const;
  /// How many pixels of the row are as wide as one is high: as many as lie between the first taps, which would
  /// otherwise never mix the columns between them.
  int PixelsAcross(int y) const;

 private:
  void Resize(bool own_planes);
  void LoadRow(const FilterGuides& guides, const LightSignal& signal, int y);
  void LoadPositions(const Image<float>& range, int y);
  Rgb32f FillHole(int set, int x, int y) const;
  int ImageColumn(int canonical) const;

  CameraRays rays_;
  FilterPlanes planes_{};
  TableVector<float> floats_;
  TableVector<uint32_t> ids_;
  std::vector<float> across_;  // 1 / cos(latitude) of rows
};

}  // namespace airsim360::internal
