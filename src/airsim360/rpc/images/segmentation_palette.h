// The colours by which AirSim shows segmentation ids.
#pragma once

#include <array>

#include "airsim360/image/image.h"

namespace airsim360 {

/// Colour of id 0 … 255. Ids beyond that have a colour of their own, see SegmentationColor.
extern const std::array<Rgb8, 256> kSegmentationPalette;

/// Colour of any id: AirSim's palette below 256; above, id = R + 256 G + 65536 B.
inline Rgb8 SegmentationColor(uint32_t id) {
  if (id < kSegmentationPalette.size()) return kSegmentationPalette[id];
  return {static_cast<uint8_t>(id), static_cast<uint8_t>(id >> 8), static_cast<uint8_t>(id >> 16)};
}

}  // namespace airsim360
