// The size of the squares into which pictures are cut: for threads and for packets of rays.
#pragma once

namespace airsim360::internal {

/// Pixels of a tile's side.
inline constexpr int kTileSize = 16;

}  // namespace airsim360::internal
