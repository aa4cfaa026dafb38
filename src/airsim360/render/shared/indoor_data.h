// What the kernels read of the light that rooms keep on their surfaces: plain data only, as shading_data.h.
#pragma once

#include <cstdint>

#include "airsim360/render/shared/shading_data.h"

namespace airsim360::internal {

/// A place on a surface whose light is known. Its neighbourhood is a disc in the plane of `normal`.
struct alignas(32) IndoorSurfel {
  float point[3], normal[3], tangent[3];
  float light[3];     ///< irradiance, but for sun and lamps of the grid that shine on it directly
  float bend[4];      ///< for another normal m: times bend[0] + (bend[1], bend[2], bend[3]) . m, within kLeastBend … kMostBend
  float lamps[3];     ///< irradiance of the lamps of the grid
  float share;        ///< how far it stands for the place: less than 1 where most of the sky is open
  uint8_t clear[16];  ///< how far nothing stands in the way along the plane, by ClearSector, in steps of IndoorLevel::clear_step
};
inline constexpr float kLeastBend = 0.2f, kMostBend = 1.6f;

/// Surfels of one cubic cell, one after another; an entry of a hash table with linear probing.
struct IndoorCell {
  uint64_t key;  ///< IndoorKey; kNoCell = free
  uint32_t first, count;
};
inline constexpr uint64_t kNoCell = ~uint64_t{0};
inline constexpr int32_t kFarCell = 1 << 19;  ///< cells of a level are nearer to the origin than this, each way

inline __attribute__((always_inline)) uint64_t IndoorKey(int32_t x, int32_t y, int32_t z) {
  return static_cast<uint64_t>(x + kFarCell) << 40 | static_cast<uint64_t>(y + kFarCell) << 20 | static_cast<uint64_t>(z + kFarCell);
}
inline __attribute__((always_inline)) uint64_t IndoorHash(uint64_t key) {
  key = (key ^ key >> 33) * 0xff51afd7ed558ccdull;
  key = (key ^ key >> 33) * 0xc4ceb9fe1a85ec53ull;
  return key ^ key >> 33;
}

struct IndoorLevel {
  const IndoorSurfel* surfels;
  const IndoorCell* cells;
  uint64_t mask;  ///< size of the table less 1
  float origin[3], cells_per_metre, clear_step;
};

/// A coarse level that covers everything, and a fine one where light changes within a cell.
struct IndoorView {
  IndoorLevel coarse, fine;
};

/// Light of surfaces in the order of a SurfaceSet.
struct alignas(64) IndoorLight {
  float r[kBatch], g[kBatch], b[kBatch];                 ///< irradiance as IndoorSurfel::light
  float lamp_r[kBatch], lamp_g[kBatch], lamp_b[kBatch];  ///< as IndoorSurfel::lamps
  float share[kBatch];                                   ///< 0: no surfel near; see IndoorSurfel::share
};

}  // namespace airsim360::internal
