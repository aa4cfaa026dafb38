// What is looked through, in words: one camera, or a rig from a file. Every front takes the same.
#pragma once

#include <string>

#include "airsim360/dataset/record/spec.h"

namespace airsim360 {

struct ImageSize {
  int width = 0, height = 0;
};

/// "WxH" with both in 2…16384; InputError naming `--size` and the value.
ImageSize ParseSize(const std::string& text);
/// The height that makes a full equirectangular panorama; InputError unless width = 2 height.
void CheckPanoramaSize(ImageSize size);

struct CameraChoice {
  std::string projection = "erp";
  std::string size;     ///< "WxH"; empty: the projection's own
  std::string cameras;  ///< file of a rig, instead of the others
  double fov_deg = 0;   ///< 0: not given

  /// Fills projection, size and field of view of the spec, or its rig. InputError naming the flag, or the line of the
  /// file, and the value.
  void Apply(DatasetSpec& spec) const;
};

}  // namespace airsim360
