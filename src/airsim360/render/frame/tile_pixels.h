// From the rays of a tile in packet order to the pixels of the image.
#pragma once

#include "airsim360/render/frame/tile_kernel.h"

namespace airsim360::internal {

/// Column and row in its tile of ray i in packet order: the inverse of PacketIndex.
struct TilePixel {
  int x, y;
};
inline constexpr TilePixel PixelOfPacketIndex(PacketShape shape, int i) {
  if (shape == PacketShape::kRow) return {i & 15, i >> 4};
  const int p = i >> 4;
  return {(p & 3) * 4 + (i & 3), (p >> 2) * 4 + ((i >> 2) & 3)};
}

/// Index in the image of a pixel of a tile; -1 outside the image.
inline int64_t ImageIndex(const TileTarget& t, TilePixel pixel) {
  const int column = t.column + pixel.x, row = t.row + pixel.y;
  if (column >= t.width || row >= t.height) return -1;
  const int x = column - t.column_shift;
  return static_cast<int64_t>(row) * t.width + (x < 0 ? x + t.width : x);
}

}  // namespace airsim360::internal
